// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>

#include "shearfront/riemann/state.hpp"

/// The Riemann problem at an interface between two layers and at a wall: which states the resting wave
/// separates.
///
/// Theorem (Gimse & Risebro 1991; Klingenberg & Risebro 1995; Holden & Risebro 2015, Section 8.1): let
///
///     h_L(.; l)   be the non-increasing envelope of f_L through l (what waves of speed <= 0 can reach),
///     h_R(.; r)   the non-decreasing envelope of f_R through r    (what waves of speed >= 0 can reach).
///
/// Their graphs cross at one flux value F*; the solution has on each side the state with flux F* that is
/// nearest to l (resp. r) on its envelope ("minimal jump"). Flux is continuous, the states in general are not.
namespace shearfront {

/// States next to a point between the layers `below` and `above`, given the states l and r beyond the waves:
/// an interface, or an open end of the bed, whose outside is a layer like the outermost one (the sense of
/// Bardos, LeRoux & Nedelec 1979). Supply and demand: F* = max of the two one-sided minima. Guaranteed: equal
/// flux rank on both sides; (l, r) itself if the two are at rest. Cost: O(1).
template <StateGrid Grid>
StatePair solve_between(const Grid& grid, std::size_t below, std::size_t above, State l, State r) {
  const State rank_l = grid.flux_rank(below, l), rank_r = grid.flux_rank(above, r);
  const State b = grid.bottom_state(below), a = grid.bottom_state(above);
  const State rank =
      std::max(l > b ? rank_l : grid.flux_rank(below, b), r < a ? rank_r : grid.flux_rank(above, a));
  return {rank_l == rank ? l : grid.falling_state(below, rank),
          rank_r == rank ? r : grid.rising_state(above, rank)};
}

/// solve_between() for the interface above layer `below`.
template <StateGrid Grid>
StatePair solve_interface(const Grid& grid, std::size_t below, State l, State r) {
  return solve_between(grid, below, below + 1, l, r);
}

/// State next to the bottom wall (flux 0) given the state r above the waves that leave it.
template <StateGrid Grid>
State solve_bottom_wall(const Grid& grid, State r) {
  const State zero = grid.zero_flux_rank();
  return grid.flux_rank(0, r) == zero ? r : grid.rising_state(0, zero);
}

/// State next to the top wall given the state l below the waves that leave it.
template <StateGrid Grid>
State solve_top_wall(const Grid& grid, State l) {
  const std::size_t layer = grid.n_layers() - 1;
  const State zero = grid.zero_flux_rank();
  return grid.flux_rank(layer, l) == zero ? l : grid.falling_state(layer, zero);
}

}  // namespace shearfront
