// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/model/flux/flux.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// A flux f made a polygon through given states, as the grids of front tracking need it: slopes of its edges, vertices and
/// bends. States are counted in the order of their shares, upwards or, in a reversed grid, downwards.
///
/// Guaranteed: the vertices lie on f, to rounding; states inside a straight piece of f are no vertices, and all edges
/// within it have bitwise equal slope. Memory: 24 to 40 bytes per state; cost: a secant per state.
template <Real S>
class FluxPolygon {
 public:
  FluxPolygon() = default;
  /// The shares first ... last are ascending, or descending if `is_reversed`; those beyond belong to no state.
  FluxPolygon(const Flux<S>& flux, std::vector<S> share, State first, State last, bool is_reversed);

  [[nodiscard]] State n_states() const { return static_cast<State>(share_.size()); }
  [[nodiscard]] const S& share(State i) const { return share_[index(i)]; }
  /// Secant of f from a state to the next one.
  [[nodiscard]] const S& slope(State i) const { return slope_[index(i)]; }
  /// Largest |slope|.
  [[nodiscard]] S steepest() const;
  /// Whether both states, lo < hi, lie on one edge of the polygon.
  [[nodiscard]] bool is_on_one_edge(State lo, State hi) const { return hi <= next_[index(lo)]; }
  [[nodiscard]] State next_vertex(State i) const { return next_[index(i)]; }
  [[nodiscard]] State previous_vertex(State i) const { return previous_[index(i)]; }
  /// How it bends between the states lo < hi.
  [[nodiscard]] Bend bend(State lo, State hi) const {
    if (convex_to_.empty() || convex_to_[index(lo)] >= hi) return Bend::convex;
    return concave_to_[index(lo)] >= hi ? Bend::concave : Bend::mixed;
  }
  /// The last state up to which it bends like `kind` from i on.
  [[nodiscard]] State run_end(State i, Bend kind) const {
    if (convex_to_.empty()) return kind == Bend::convex ? n_states() - 1 : next_[index(i)];
    return (kind == Bend::convex ? convex_to_ : concave_to_)[index(i)];
  }
  /// Whether l | r is one step of a fan: neighbouring vertices between which the flux is curved, in the order in
  /// which they move apart. A contact along a straight piece of the flux is none.
  [[nodiscard]] bool is_fan_step(const Flux<S>& flux, State l, State r) const {
    const State lo = l < r ? l : r, hi = l < r ? r : l;
    if (lo == hi || next_[index(lo)] != hi) return false;
    if (!(slope_change(flux, l, r) > 0)) return false;
    return !is_straight(flux, share(lo), share(hi));
  }
  /// d(f')/d(share) inside the step l | r of a fan.
  [[nodiscard]] S fan_rate(const Flux<S>& flux, State l, State r) const {
    return slope_change(flux, l, r) / (share(r) - share(l));
  }

 private:
  [[nodiscard]] static std::size_t index(State i) { return static_cast<std::size_t>(i); }
  /// f' at the second state less f' at the first.
  [[nodiscard]] S slope_change(const Flux<S>& flux, State from, State to) const {
    return flux.derivative(share(to)) - flux.derivative(share(from));
  }
  void straighten(std::size_t first, std::size_t last);
  void find_vertices(std::size_t first, std::size_t last);

  std::vector<S> share_, slope_;
  std::vector<State> next_, previous_;
  std::vector<State> convex_to_, concave_to_;  ///< how far up it bends one way; empty: convex everywhere
};

extern template class FluxPolygon<double>;

}  // namespace shearfront
