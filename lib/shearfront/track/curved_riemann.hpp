// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/track/level_curves.hpp"

/// The Riemann problem of two states l below, r above a height, on levels: the flux is the least of what l can send and r can take, each
/// at most what its side can carry (round up: LevelCurves::cap). On either side the state nearest to its own with that flux stays at the
/// height, and a fan between neighbouring levels or one shock leaves.
namespace shearfront::curved_riemann {

/// The level of the flux. Capacities are those below and above the height: at a wall 0, inside a piece both the same.
[[nodiscard]] inline std::size_t flux_level(const LevelCurves& grid, State l, State r, std::size_t cap_below,
                                            std::size_t cap_above) {
  const std::size_t demand = grid.is_high(l) ? std::min(grid.level(l), cap_below) : cap_below;
  const std::size_t supply = grid.is_high(r) ? cap_above : std::min(grid.level(r), cap_above);
  return std::min(demand, supply);
}

/// Calls wave(below, above, is_edge) for every wave that goes down, bottom to top, and returns the state left at the height; an edge is
/// next to l in a fan.
template <class Wave>
State waves_down(const LevelCurves& grid, State l, std::size_t level, Wave&& wave) {
  const State at = l == grid.high(level) ? l : grid.low(level);
  if (l == at) return at;
  if (grid.is_high(l) || !(grid.level(l) < level)) {
    wave(l, at, false);
    return at;
  }
  for (std::size_t k = grid.level(l); k < level; ++k) wave(grid.low(k), grid.low(k + 1), k == grid.level(l));
  return at;
}
/// The same for the waves that go up to r.
template <class Wave>
State waves_up(const LevelCurves& grid, State r, std::size_t level, Wave&& wave) {
  const State at = r == grid.low(level) ? r : grid.high(level);
  if (r == at) return at;
  if (!grid.is_high(r) || !(grid.level(r) < level)) {
    wave(at, r, false);
    return at;
  }
  for (std::size_t k = level; k > grid.level(r); --k)
    wave(grid.high(k), grid.high(k - 1), k - 1 == grid.level(r));
  return at;
}

/// The label of a level beyond its turning height, where both of its states are one: that of the side on which it lives, so
/// that the region may go on there.
[[nodiscard]] inline State dead_label(const LevelCurves& grid, std::size_t piece, State l, State r,
                                      std::size_t level) {
  if (grid.piece(piece).bend > 0) return grid.level(r) == level ? r : grid.high(level);
  return grid.level(l) == level ? l : grid.low(level);
}

}  // namespace shearfront::curved_riemann
