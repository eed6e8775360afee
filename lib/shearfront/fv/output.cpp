// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/output.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "shearfront/numeric/sum.hpp"

namespace shearfront::fv {

std::vector<Sample> sample_cells(const Grid& grid, const CellStates& cells,
                                 const std::vector<double>& depths) {
  std::vector<std::size_t> order(depths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return depths[a] < depths[b]; });
  std::vector<Sample> samples(depths.size());
  CompensatedSum<double> below;
  std::size_t cell = 0;
  // In the order of operations of Profile: the same to the bit.
  for (const std::size_t i : order) {
    for (; cell + 1 < grid.n_cells && grid.edge(cell + 1) <= depths[i]; ++cell)
      below += (grid.edge(cell + 1) - grid.edge(cell)) * ((cells.at_bottom(cell) + cells.at_top(cell)) / 2);
    const double d = depths[i] - grid.edge(cell), width = grid.edge(cell + 1) - grid.edge(cell);
    const double bottom = cells.at_bottom(cell), top = cells.at_top(cell);
    const double phi = bottom == top ? top : bottom + (top - bottom) * (d / width);
    samples[i] = {phi, below.value() + d * (bottom == top ? top : (bottom + phi) / 2)};
  }
  return samples;
}

Profile<double> profile_of_cells(const Grid& grid, const CellStates& cells) {
  std::vector<double> edges(grid.n_cells + 1), below(grid.n_cells), above(grid.n_cells);
  for (std::size_t j = 0; j <= grid.n_cells; ++j) edges[j] = grid.edge(j);
  for (std::size_t j = 0; j < grid.n_cells; ++j) {
    below[j] = cells.at_bottom(j);
    above[j] = cells.at_top(j);
  }
  return {std::move(edges), std::move(below), std::move(above)};
}

CellOutput::CellOutput(const Scene<double>& scene, const Grid& grid)
    : grid_(grid), has_packing_(scene.spec().solid_fraction.has_value()), is_layered_(false) {
  if (!has_packing_) return;
  const auto& solid_fraction = *scene.spec().solid_fraction;
  is_layered_ = std::visit([](const auto& model) { return model.kIsLayered; }, solid_fraction);
  const std::vector<double> knots = std::visit([](const auto& model) { return model.knots(); }, solid_fraction);
  std::size_t next = 0;
  for (std::size_t j = 0; j < grid.n_cells; ++j) {
    double lo = grid.edge(j);
    const auto add = [&](double hi) {
      // A chord of c has the mean of c only where c is linear.
      const double below = scene.solid_fraction_at(lo), above = is_layered_ ? below : scene.solid_fraction_at(hi);
      const double mean = scene.mean_packing(lo, hi), half = (above - below) / 2;
      pieces_.push_back({lo, std::min(below, mean - half), std::min(above, mean + half), j});
      lo = hi;
    };
    while (next < knots.size() && knots[next] <= lo) ++next;
    for (; next < knots.size() && knots[next] < grid.edge(j + 1); ++next) add(knots[next]);
    add(grid.edge(j + 1));
  }
}

std::vector<Sample> CellOutput::samples(const CellStates& cells, const std::vector<double>& depths) const {
  if (!has_packing_) return sample_cells(grid_, cells, depths);
  std::vector<Sample> samples;
  for (const auto& value : profile(cells).at(depths)) samples.push_back({value.phi, value.M});
  return samples;
}

Profile<double> CellOutput::profile(const CellStates& cells) const {
  if (!has_packing_) return profile_of_cells(grid_, cells);
  std::vector<double> edges, below, above;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    const std::size_t j = piece.cell;
    const double hi = i + 1 < pieces_.size() ? pieces_[i + 1].lo : grid_.top;
    // A slope times another one, or over unequal pieces, would not have the mean of the cell.
    const bool has_slope = is_layered_ && piece.lo == grid_.edge(j) && hi == grid_.edge(j + 1);
    edges.push_back(piece.lo);
    below.push_back(piece.packing_below * (has_slope ? cells.at_bottom(j) : cells.phi[j]));
    above.push_back(piece.packing_above * (has_slope ? cells.at_top(j) : cells.phi[j]));
  }
  edges.push_back(grid_.top);
  return {std::move(edges), std::move(below), std::move(above)};
}

}  // namespace shearfront::fv
