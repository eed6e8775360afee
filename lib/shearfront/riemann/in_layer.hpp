// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/riemann/envelope.hpp"
#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// Whether the Riemann problem l | r is known without a search to be a single shock.
template <StateGrid Grid>
[[nodiscard]] bool is_one_shock(const Grid& grid, std::size_t layer, State l, State r) {
  return l > r ? grid.bend(layer, r, l) == Bend::convex : l < r && grid.bend(layer, l, r) == Bend::concave;
}

/// Riemann problem l | r inside one layer: calls emit(below, above) for every outgoing front, from bottom to
/// top, speeds nondecreasing.
///
/// The entropy solution for a piecewise linear flux follows its lower convex envelope between l and r if
/// l < r and its upper concave envelope if l > r (Dafermos 1972; Holden & Risebro 2015, Section 2.1); every
/// edge of the envelope is one front. For a convex flux this is one front per polygon edge (a fan) or a single
/// shock. Guaranteed: the fronts join l to r without gap; each satisfies Rankine-Hugoniot and the Oleinik
/// condition for the polygon. Cost: O(1) per front, and what Envelope says where the polygon bends both ways.
template <StateGrid Grid, class Emit>
void solve_in_layer(const Grid& grid, std::size_t layer, State l, State r, Emit&& emit) {
  if (l == r) return;
  const Bend bend = l < r ? grid.bend(layer, l, r) : grid.bend(layer, r, l);
  if (bend == Bend::mixed) return Envelope<Grid>(grid, layer, l, r).for_each(emit);
  if ((bend == Bend::convex) == (l > r)) {
    emit(l, r);
  } else if (l < r) {
    for (State i = l; i < r;) {
      const State next = grid.next_vertex(layer, i);
      const State end = next < r ? next : r;
      emit(i, end);
      i = end;
    }
  } else {
    for (State i = l; i > r;) {
      const State next = grid.previous_vertex(layer, i);
      const State end = next > r ? next : r;
      emit(i, end);
      i = end;
    }
  }
}

}  // namespace shearfront
