// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/cell_profile.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace shearfront::fv {

Profile<double> cell_profile(const Scene<double>& scene, const Grid& grid, const CellShares& cells) {
  const auto& solid_fraction = scene.spec().solid_fraction;
  const bool is_layered = is_constant_in_pieces<double>(solid_fraction);
  const auto knots = solid_fraction
                         ? std::visit([](const auto& model) { return model.knots(); }, *solid_fraction)
                         : std::vector<double>{};
  std::vector<double> z, below, above;
  for (std::size_t j = 0; j < grid.n_cells(); ++j)
    for_pieces(knots, grid.edges[j], grid.edges[j + 1], [&](double lo, double hi) {
      // A chord of c has the mean of c only where c is linear.
      const double c_lo = scene.solid_fraction_at(lo), c_hi = is_layered ? c_lo : scene.solid_fraction_at(hi);
      const double mean = scene.mean_solid_fraction(lo, hi), half = (c_hi - c_lo) / 2;
      // A slope times another one, or over unequal pieces, would not have the mean of the cell.
      const bool has_slope =
          !cells.half_rise.empty() && is_layered && lo == grid.edges[j] && hi == grid.edges[j + 1];
      const double rise = has_slope ? cells.half_rise[j] : 0;
      z.push_back(lo);
      below.push_back(std::min(c_lo, mean - half) * (cells.x[j] - rise));
      above.push_back(std::min(c_hi, mean + half) * (cells.x[j] + rise));
    });
  z.push_back(scene.top());
  return {std::move(z), std::move(below), std::move(above)};
}

}  // namespace shearfront::fv
