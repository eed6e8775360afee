// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/track/flux_polygon.hpp"
#include "shearfront/track/pieces.hpp"

namespace shearfront {

template <class Grid>
class StateMotion;
template <class Grid>
class WantedMotion;

/// Grids of states for a bed of one layer, whose flux may have any number of extrema and straight pieces.
///
/// With no interface there are no levels to share: the states are the ends of the range, the extrema, the states without
/// flux (walls ask for them), the initial and outside states, and between them equal steps within `resolution` of the
/// range. The polygon through them lies on the flux. Guaranteed: equal fluxes have equal rank, zero is met to the bit;
/// speed() as that of UnimodalGrid. Memory: 64 bytes per state; cost of building: O(states log states).
template <Real S>
class OneLayerGrid {
 public:
  using Scalar = S;

  struct Built;  // grid + indices of the wanted states
  static Built exact_levels(const LayerStack<S>& stack, const S& resolution,
                            const std::vector<LayerState<S>>& wanted);

  /// Why there is no grid for these layers; empty if there is.
  [[nodiscard]] static std::string refusal(const LayerStack<S>& stack, const S& resolution);

  [[nodiscard]] static std::size_t n_layers() { return 1; }
  [[nodiscard]] const S& boundary(std::size_t k) const { return boundaries_[k]; }
  [[nodiscard]] std::size_t n_levels() const { return fluxes_.size(); }
  [[nodiscard]] State n_states(std::size_t) const { return polygon_.n_states(); }
  [[nodiscard]] S phi(std::size_t, State i) const { return solid_fraction_ * polygon_.share(i); }
  [[nodiscard]] const S& flux(std::size_t, State i) const { return fluxes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] State flux_rank(std::size_t, State i) const { return ranks_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] State zero_flux_rank() const { return zero_rank_; }
  [[nodiscard]] static bool is_reversed() { return false; }
  /// States at which f has an extremum or no value but 0, ascending.
  [[nodiscard]] const std::vector<State>& extrema() const { return extrema_; }
  [[nodiscard]] const std::vector<State>& zeros() const { return zeros_; }

  [[nodiscard]] State next_vertex(std::size_t, State i) const { return polygon_.next_vertex(i); }
  [[nodiscard]] State previous_vertex(std::size_t, State i) const { return polygon_.previous_vertex(i); }
  [[nodiscard]] Bend bend(std::size_t, State lo, State hi) const { return polygon_.bend(lo, hi); }
  [[nodiscard]] State run_end(std::size_t, State i, Bend kind) const { return polygon_.run_end(i, kind); }
  [[nodiscard]] S speed(std::size_t, State l, State r) const {
    const State lo = std::min(l, r), hi = std::max(l, r);
    if (polygon_.is_on_one_edge(lo, hi)) return rate_ * polygon_.slope(lo);
    const S run = phi(0, hi) - phi(0, lo), width = phi(0, n_states(0) - 1) - phi(0, 0);
    if (S(kLongChord) * run > width) return (flux(0, hi) - flux(0, lo)) / run;
    return rate_ * flux_.secant(polygon_.share(lo), polygon_.share(hi));
  }
  [[nodiscard]] S edge_speed(std::size_t, State i) const {
    return rate_ * flux_.derivative(polygon_.share(i));
  }
  [[nodiscard]] const S& fastest() const { return fastest_; }
  [[nodiscard]] bool is_fan_step(std::size_t, State l, State r) const {
    return polygon_.is_fan_step(flux_, l, r);
  }
  /// |d(speed)/d(phi)| inside the step l | r of a fan.
  [[nodiscard]] S fan_rate(std::size_t, State l, State r) const {
    const S rate = rate_ * polygon_.fan_rate(flux_, l, r);
    return (rate < 0 ? S(-rate) : rate) / solid_fraction_;
  }

 private:
  static constexpr int kLongChord = 8;  // part of the range over which fluxes can be subtracted
  template <class>
  friend class StateMotion;
  template <class>
  friend class WantedMotion;

  std::vector<S> boundaries_;
  Flux<S> flux_;
  S rate_{1}, solid_fraction_{1}, fastest_{0};
  FluxPolygon<S> polygon_;
  std::vector<S> fluxes_;
  std::vector<State> ranks_, extrema_, zeros_;
  State zero_rank_ = -1;  ///< -1: no state without flux
};

template <Real S>
struct OneLayerGrid<S>::Built {
  OneLayerGrid grid;
  std::vector<State> states;  ///< states[i] is the index of wanted[i]
};

/// The states at rest between l and r, the same flux on both sides: those with the least flux between them if l < r, with
/// the largest if l > r, each the nearest to its side (the theorem of riemann/interface.hpp). Cost: O(extrema).
template <Real S>
[[nodiscard]] StatePair solve_between(const OneLayerGrid<S>& grid, std::size_t, std::size_t, State l,
                                      State r) {
  StatePair at_rest{l, l};
  State best = grid.flux_rank(0, l);
  const auto meet = [&](State i) {
    const State rank = grid.flux_rank(0, i);
    if (rank == best) at_rest.above = i;
    if (l < r ? rank < best : rank > best) {
      best = rank;
      at_rest = {i, i};
    }
  };
  const auto& all = grid.extrema();
  if (l < r)
    for (auto i = std::upper_bound(all.begin(), all.end(), l); i != all.end() && *i < r; ++i) meet(*i);
  else
    for (auto i = std::lower_bound(all.begin(), all.end(), l); i != all.begin() && *(i - 1) > r; --i)
      meet(*(i - 1));
  meet(r);
  return at_rest;
}

/// State next to the bottom wall given the state r above the waves that leave it: without flux, and the first on the side
/// to which the flux goes to 0 by waves that rise. Cost: O(log zeros).
template <Real S>
[[nodiscard]] State solve_bottom_wall(const OneLayerGrid<S>& grid, State r) {
  const auto above = std::lower_bound(grid.zeros().begin(), grid.zeros().end(), r);
  if (above != grid.zeros().end() && *above == r) return r;
  return grid.flux_rank(0, r) < grid.zero_flux_rank() ? *above : *(above - 1);
}

/// The same below the top wall, by waves that sink from it into l.
template <Real S>
[[nodiscard]] State solve_top_wall(const OneLayerGrid<S>& grid, State l) {
  const auto above = std::lower_bound(grid.zeros().begin(), grid.zeros().end(), l);
  if (above != grid.zeros().end() && *above == l) return l;
  return grid.flux_rank(0, l) < grid.zero_flux_rank() ? *(above - 1) : *above;
}

extern template class OneLayerGrid<double>;

}  // namespace shearfront
