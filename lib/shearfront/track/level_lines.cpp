// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/level_lines.hpp"

#include <algorithm>
#include <cmath>

namespace shearfront {

void Lines::add_level(const LevelCurves& grid, std::size_t piece, State state, double top, double tolerance) {
  const double bottom = end();
  if (!(top > bottom)) return;
  const std::size_t k = grid.level(state);
  const RatePiece& rate = grid.piece(piece);
  if (k == 0 || rate.is_constant()) return add(top, grid.phi(piece, state, top), grid.phi(piece, state, top));
  struct Point {
    double z, u;
  };
  const auto at = [&](double z) { return Point{z, grid.phi(piece, state, z)}; };
  // From the turning height on it is a square root: cut there, the rest by halving.
  std::vector<Point> ends{at(top)};
  const double turn = grid.turning_height(piece, k);
  if (turn > bottom && turn < top) ends.push_back({turn, grid.top(piece)});
  Point low = at(bottom);
  constexpr double kThinnest = 8 * 0x1p-53;  // of the heights
  while (!ends.empty()) {
    const Point high = ends.back();
    const double width = high.z - low.z;
    const Point middle = at(low.z + width / 2);
    const auto is_near = [&](const Point& p) {
      return std::abs(p.u - (low.u + (high.u - low.u) * ((p.z - low.z) / width))) <= tolerance;
    };
    const bool is_thin = !(width > kThinnest * std::max(std::abs(low.z), std::abs(high.z)));
    if (!is_thin && !(is_near(middle) && is_near(at(low.z + width / 4)))) {
      ends.push_back(middle);
      continue;
    }
    ends.pop_back();
    if (!(width > 0)) continue;
    const double mean = std::clamp(grid.amount(piece, state, low.z, high.z) / width, 0.0, 1.0);
    double shift = mean - (low.u + high.u) / 2;
    const double least = std::min(low.u, high.u) + shift, most = std::max(low.u, high.u) + shift;
    if (least >= 0 && most <= 1)
      add(high.z, low.u + shift, high.u + shift);
    else
      add(high.z, mean, mean);
    low = high;
  }
}

}  // namespace shearfront
