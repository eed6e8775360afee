// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_field.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/quadrature.hpp"
#include "shearfront/track/level_lines.hpp"

namespace shearfront {

Sample CurvedField::at(double height) const {
  const double z = bed_->scene.heights.y_of(height);
  const auto& heights = snapshot_.z;
  const auto it = std::upper_bound(heights.begin() + 1, heights.end() - 1, z);
  auto i = static_cast<std::size_t>(it - heights.begin()) - 1;
  while (i > 0 && !(heights[i] < heights.back()))
    --i;  // at the top the value below it, also of fronts that begin there
  const LevelCurves& grid = bed_->grid;
  const std::size_t piece = snapshot_.piece[i];
  const double amount = snapshot_.below[i] + grid.amount(piece, snapshot_.state[i], heights[i], z);
  const FlowCoordinate& bed = bed_->scene.heights;
  return {bed.phi_of(piece, height, grid.phi(piece, snapshot_.state[i], z)), bed.amount_of(z, amount)};
}

double CurvedField::integral(const ShareFunction& g) const {
  const LevelCurves& grid = bed_->grid;
  CompensatedSum<double> sum;
  std::vector<double> cuts;
  for (std::size_t i = 0; i < snapshot_.state.size(); ++i) {
    const double lo = snapshot_.z[i], hi = snapshot_.z[i + 1];
    if (!(hi > lo)) continue;
    const std::size_t piece = snapshot_.piece[i], level = grid.level(snapshot_.state[i]);
    const RatePiece& rate = grid.piece(piece);
    const FlowCoordinate& bed = bed_->scene.heights;
    const double solid = bed.solid_per_height(piece);
    const auto value = [&](double z) {
      return g.value(bed.share_of(piece, grid.phi(piece, snapshot_.state[i], z))) * solid;
    };
    if (level == 0 || rate.is_constant()) {
      sum += value(lo) * (hi - lo);
      continue;
    }
    cuts = {lo, hi};
    const auto cut = [&](double z) {
      if (z > lo && z < hi) cuts.push_back(z);
    };
    const double turn = grid.turning_height(piece, level);
    cut(turn);
    for (const double kink : g.kinks) {
      const double u = bed.u_of(piece, kink);
      if (u > 0 && u < 1) cut(rate.height_of(grid.capacity(level) / rate.carried(1, u)));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      constexpr unsigned kMostHalvings = 5;
      constexpr double kTolerance = 1e-10;
      if (turn < lo - (hi - lo) || turn > hi + (hi - lo)) {
        sum += integral_of_smooth<double>([&](double z) { return value(z); }, cuts[k], cuts[k + 1],
                                          kMostHalvings, kTolerance);
        continue;
      }
      // z = turn +- y^2: in y a level is smooth.
      const double from = std::sqrt(std::abs(cuts[k] - turn)), to = std::sqrt(std::abs(cuts[k + 1] - turn));
      const double sign = cuts[k] < turn ? -1 : 1;
      sum += sign * integral_of_smooth<double>([&](double y) { return 2 * y * value(turn + sign * y * y); },
                                               from, to, kMostHalvings, kTolerance);
    }
  }
  return sum.value();
}

std::optional<Profile<double>> CurvedField::profile() const {
  constexpr double kShare = 1e-3;
  Lines lines(snapshot_.z.front());
  for (std::size_t i = 0; i < snapshot_.state.size(); ++i)
    lines.add_level(bed_->grid, snapshot_.piece[i], snapshot_.state[i], snapshot_.z[i + 1],
                    kShare * bed_->resolution);
  lines.close(snapshot_.z.back());
  return bed_->scene.profile_of(lines);
}

}  // namespace shearfront
