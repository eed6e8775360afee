// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// Riemann problem l | r inside one layer: calls emit(below, above) for every outgoing front, from bottom to
/// top, speeds nondecreasing.
///
/// The entropy solution for a piecewise linear flux follows its lower convex envelope between l and r if l <
/// r and its upper concave envelope if l > r (Dafermos 1972; Holden & Risebro 2015, Section 2.1); every edge
/// of the envelope is one front. For a convex flux this is one front per polygon edge (a fan) or a single
/// shock. Guaranteed: the fronts join l to r without gap; each satisfies Rankine-Hugoniot and the Oleinik
/// condition for the polygon. Cost: O(|l - r|).
template <StateGrid Grid, class Emit>
void solve_in_layer(const Grid& grid, std::size_t layer, State l, State r, Emit&& emit) {
  if (l == r) return;
  if constexpr (Grid::kUnimodalConvex) {
    if (l > r) {
      emit(l, r);
    } else {
      for (State i = l; i < r;) {
        const State next = grid.next_vertex(layer, i);
        const State end = next < r ? next : r;
        emit(i, end);
        i = end;
      }
    }
  } else {
    // Monotone chain: a vertex stays on the envelope while speeds increase along the path from l to r.
    const State step = l < r ? 1 : -1;
    std::vector<State> hull{l};
    for (State i = l + step;; i += step) {
      while (hull.size() > 1 &&
             !(grid.speed(layer, hull[hull.size() - 2], hull.back()) < grid.speed(layer, hull.back(), i)))
        hull.pop_back();
      hull.push_back(i);
      if (i == r) break;
    }
    for (std::size_t i = 0; i + 1 < hull.size(); ++i) emit(hull[i], hull[i + 1]);
  }
}

}  // namespace shearfront
