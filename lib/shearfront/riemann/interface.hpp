// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <vector>

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

namespace interface_detail {

/// The state nearest to `from` with the given flux rank, walking up if `up`. Precondition: it exists.
template <StateGrid Grid>
State nearest_with_rank(const Grid& grid, std::size_t layer, State from, State rank, bool up) {
  State i = from;
  while (grid.flux_rank(layer, i) != rank) i += up ? 1 : -1;
  return i;
}

/// Ranks of h_L(.; l): running minimum above l, running maximum below l.
template <StateGrid Grid>
std::vector<State> falling_envelope(const Grid& grid, std::size_t layer, State l) {
  std::vector<State> h(static_cast<std::size_t>(grid.n_states(layer)));
  const auto at = [&](State i) -> State& { return h[static_cast<std::size_t>(i)]; };
  at(l) = grid.flux_rank(layer, l);
  for (State i = l + 1; i < grid.n_states(layer); ++i)
    at(i) = std::min(at(i - 1), State(grid.flux_rank(layer, i)));
  for (State i = l - 1; i >= 0; --i) at(i) = std::max(at(i + 1), State(grid.flux_rank(layer, i)));
  return h;
}

/// Ranks of h_R(.; r): running maximum above r, running minimum below r.
template <StateGrid Grid>
std::vector<State> rising_envelope(const Grid& grid, std::size_t layer, State r) {
  std::vector<State> h(static_cast<std::size_t>(grid.n_states(layer)));
  const auto at = [&](State i) -> State& { return h[static_cast<std::size_t>(i)]; };
  at(r) = grid.flux_rank(layer, r);
  for (State i = r + 1; i < grid.n_states(layer); ++i)
    at(i) = std::max(at(i - 1), State(grid.flux_rank(layer, i)));
  for (State i = r - 1; i >= 0; --i) at(i) = std::min(at(i + 1), State(grid.flux_rank(layer, i)));
  return h;
}

/// Rank of the flux where the two envelopes cross, walking both up the common axis of phi.
template <StateGrid Grid>
State crossing_rank(const Grid& grid, std::size_t below, std::size_t above, State l, State r) {
  const std::vector<State> h_l = falling_envelope(grid, below, l);
  const std::vector<State> h_r = rising_envelope(grid, above, r);
  // First phi at which h_R has reached h_L. There one of the two is flat (a state flux or an extremum, hence
  // a level of the grid), because two scaled copies of one flux never move in opposite directions at the same
  // phi.
  std::size_t i = 0, j = 0;
  while (h_r[j] < h_l[i]) {
    const bool left_ends = i + 1 == h_l.size(), right_ends = j + 1 == h_r.size();
    if (left_ends && right_ends) break;
    const bool step_left = right_ends || (!left_ends && grid.phi(below, static_cast<State>(i) + 1) <=
                                                            grid.phi(above, static_cast<State>(j) + 1));
    const State h_l_old = h_l[i], h_r_old = h_r[j];
    if (step_left) {
      ++i;
      if (h_l[i] <= h_r_old && h_l_old > h_r_old) return h_r_old;
    } else {
      ++j;
      if (h_r[j] >= h_l_old && h_r_old < h_l_old) return h_l_old;
    }
  }
  return std::max(h_l[i], std::min(h_r[j], h_l[i]));
}

}  // namespace interface_detail

/// States next to a point between the layers `below` and `above`, given the states l and r beyond the waves:
/// an interface, or an open end of the bed, whose outside is a layer like the outermost one (the sense of
/// Bardos, LeRoux & Nedelec 1979). Guaranteed: equal flux rank on both sides; (l, r) itself if the two are at
/// rest. Cost: O(1) for unimodal fluxes (supply and demand: F* = max of the two one-sided minima), O(states)
/// otherwise.
template <StateGrid Grid>
StatePair solve_between(const Grid& grid, std::size_t below, std::size_t above, State l, State r) {
  const State rank_l = grid.flux_rank(below, l), rank_r = grid.flux_rank(above, r);
  if constexpr (Grid::kUnimodal) {
    const State b = grid.bottom_state(below), a = grid.bottom_state(above);
    const State rank =
        std::max(l > b ? rank_l : grid.flux_rank(below, b), r < a ? rank_r : grid.flux_rank(above, a));
    return {rank_l == rank ? l : grid.falling_state(below, rank),
            rank_r == rank ? r : grid.rising_state(above, rank)};
  } else {
    using namespace interface_detail;
    const State rank = crossing_rank(grid, below, above, l, r);
    // h_L falls, so a smaller flux lies above l; h_R rises, so a greater flux lies above r.
    return {nearest_with_rank(grid, below, l, rank, rank < rank_l),
            nearest_with_rank(grid, above, r, rank, rank > rank_r)};
  }
}

/// solve_between() for the interface above layer `below`.
template <StateGrid Grid>
StatePair solve_interface(const Grid& grid, std::size_t below, State l, State r) {
  return solve_between(grid, below, below + 1, l, r);
}

/// State next to the bottom wall (flux 0) given the state r above the waves that leave it.
template <StateGrid Grid>
State solve_bottom_wall(const Grid& grid, State r) {
  const State zero = grid.zero_flux_rank(), rank_r = grid.flux_rank(0, r);
  if (rank_r == zero) return r;
  if constexpr (Grid::kUnimodal) {
    return grid.rising_state(0, zero);
  } else {
    return interface_detail::nearest_with_rank(grid, 0, r, zero, zero > rank_r);
  }
}

/// State next to the top wall given the state l below the waves that leave it.
template <StateGrid Grid>
State solve_top_wall(const Grid& grid, State l) {
  const std::size_t layer = grid.n_layers() - 1;
  const State zero = grid.zero_flux_rank(), rank_l = grid.flux_rank(layer, l);
  if (rank_l == zero) return l;
  if constexpr (Grid::kUnimodal) {
    return grid.falling_state(layer, zero);
  } else {
    return interface_detail::nearest_with_rank(grid, layer, l, zero, zero < rank_l);
  }
}

}  // namespace shearfront
