// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/interface.hpp"
#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// A continuous piecewise linear flux: through the points (phi[i], flux[i]), phi ascending.
template <Real Scalar>
struct Polygon {
  std::vector<Scalar> phi, flux;
};

/// A stack of layers with an arbitrary polygon as flux in each: the general StateGrid, no convexity assumed, and
/// interfaces solved by walking along both envelopes. A second road to everything that the grids of fluxes with one
/// extremum find by supply and demand.
///
/// The constructor closes the grid under interface Riemann problems: every flux value of a vertex of any
/// layer, and flux 0, becomes a level, and every edge of every polygon gets a state at each level it passes.
/// These added states lie on the edge, so the problem solved is still exactly that of the given polygons.
/// Domain: at least two points per polygon; the same kind of flux in all layers (scaled copies of one flux,
/// or unimodal fluxes of one kind), so that the envelopes of an interface cross on a level.
/// Cost: O(levels x edges) states at worst.
template <Real S>
class PolygonStack {
 public:
  using Scalar = S;

  PolygonStack(std::vector<S> boundaries, const std::vector<Polygon<S>>& polygons)
      : boundaries_(std::move(boundaries)) {
    SHEARFRONT_EXPECTS(boundaries_.size() == polygons.size() + 1, "one polygon per layer");
    levels_.push_back(S(0));
    for (const Polygon<S>& p : polygons) levels_.insert(levels_.end(), p.flux.begin(), p.flux.end());
    std::sort(levels_.begin(), levels_.end());
    // Values that differ by the rounding of their own evaluation are one level: f(phi) and f(1 - phi), say.
    // Kept apart they would ask for states closer together than numbers are.
    slack_ = std::max(levels_.back(), Scalar(-levels_.front())) * (Scalar(kRoundings) * unit_roundoff<S>());
    levels_.erase(
        std::unique(levels_.begin(), levels_.end(), [&](const S& a, const S& b) { return b - a <= slack_; }),
        levels_.end());
    for (const Polygon<S>& p : polygons) layers_.push_back(closed(p));
    zero_ = rank_of(S(0));
  }

  [[nodiscard]] std::size_t n_layers() const { return layers_.size(); }
  [[nodiscard]] const S& boundary(std::size_t k) const { return boundaries_[k]; }
  [[nodiscard]] State n_states(std::size_t layer) const {
    return static_cast<State>(layers_[layer].points.size());
  }
  [[nodiscard]] const S& phi(std::size_t layer, State i) const { return point(layer, i).phi; }
  [[nodiscard]] const S& flux(std::size_t layer, State i) const {
    return levels_[static_cast<std::size_t>(point(layer, i).rank)];
  }
  [[nodiscard]] State flux_rank(std::size_t layer, State i) const { return point(layer, i).rank; }
  [[nodiscard]] State zero_flux_rank() const { return zero_; }
  [[nodiscard]] State next_vertex(std::size_t, State i) const { return i + 1; }
  [[nodiscard]] State previous_vertex(std::size_t, State i) const { return i - 1; }
  [[nodiscard]] static bool is_reversed() { return false; }
  [[nodiscard]] static Bend bend(std::size_t, State, State) { return Bend::mixed; }
  [[nodiscard]] static State run_end(std::size_t, State i, Bend) { return i + 1; }
  /// Fronts inside one edge all have bitwise the speed of the edge.
  [[nodiscard]] S speed(std::size_t layer, State l, State r) const {
    const State lo = std::min(l, r), hi = std::max(l, r);
    if (lo == hi || point(layer, lo).edge_above == point(layer, hi).edge_below)
      return layers_[layer].edge_speed[static_cast<std::size_t>(point(layer, lo).edge_above)];
    return (flux(layer, r) - flux(layer, l)) / (phi(layer, r) - phi(layer, l));
  }
  /// Bound for |speed| in all layers: the steepest edge.
  [[nodiscard]] S fastest() const {
    S fastest(0);
    for (const Layer& layer : layers_)
      for (const S& v : layer.edge_speed) fastest = std::max(fastest, v < 0 ? S(-v) : v);
    return fastest;
  }
  /// No fans, no edges of fans.
  [[nodiscard]] S edge_speed(std::size_t layer, State i) const { return speed(layer, i, i); }
  [[nodiscard]] static bool is_fan_step(std::size_t, State, State) { return false; }
  [[nodiscard]] static S fan_rate(std::size_t, State, State) { return S(0); }

  /// The state nearest to phi; exact if phi is one.
  [[nodiscard]] State nearest(std::size_t layer, const S& phi) const {
    const auto& points = layers_[layer].points;
    auto it = std::lower_bound(points.begin(), points.end(), phi,
                               [](const Point& p, const S& x) { return p.phi < x; });
    if (it == points.end() || (it != points.begin() && phi - (it - 1)->phi < it->phi - phi)) --it;
    return static_cast<State>(it - points.begin());
  }

 private:
  struct Point {
    S phi;
    State rank;
    std::int32_t edge_below, edge_above;  // edges of the given polygon it belongs to
  };
  struct Layer {
    std::vector<Point> points;
    std::vector<S> edge_speed;
  };

  [[nodiscard]] const Point& point(std::size_t layer, State i) const {
    return layers_[layer].points[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] State rank_of(const S& flux) const {
    return static_cast<State>(std::lower_bound(levels_.begin(), levels_.end(), flux - slack_) -
                              levels_.begin());
  }
  [[nodiscard]] Layer closed(const Polygon<S>& p) const {
    SHEARFRONT_EXPECTS(p.phi.size() >= 2 && p.phi.size() == p.flux.size(), "points of a polygon");
    Layer layer;
    const auto n_edges = static_cast<std::int32_t>(p.phi.size()) - 1;
    for (std::int32_t e = 0; e < n_edges; ++e) {
      const auto i = static_cast<std::size_t>(e);
      const S rise = p.flux[i + 1] - p.flux[i], run = p.phi[i + 1] - p.phi[i];
      layer.edge_speed.push_back(rise / run);
      const State from = rank_of(p.flux[i]), to = rank_of(p.flux[i + 1]);
      layer.points.push_back({p.phi[i], from, std::max(e - 1, 0), e});
      const State step = from < to ? 1 : -1;
      for (State r = from + step; from != to && r != to; r += step) {
        const S x = p.phi[i] + run * ((levels_[static_cast<std::size_t>(r)] - p.flux[i]) / rise);
        if (x > layer.points.back().phi && x < p.phi[i + 1]) layer.points.push_back({x, r, e, e});
      }
    }
    layer.points.push_back({p.phi.back(), rank_of(p.flux.back()), n_edges - 1, n_edges - 1});
    return layer;
  }

  static constexpr int kRoundings = 16;

  std::vector<S> boundaries_, levels_;
  S slack_{0};
  std::vector<Layer> layers_;
  State zero_ = 0;
};

/// The state nearest to `from` with the given flux rank, walking up if `up`. Precondition: it exists.
template <Real S>
State nearest_with_rank(const PolygonStack<S>& grid, std::size_t layer, State from, State rank, bool up) {
  State i = from;
  while (grid.flux_rank(layer, i) != rank) i += up ? 1 : -1;
  return i;
}

/// Ranks of h_L(.; l): running minimum above l, running maximum below l.
template <Real S>
std::vector<State> falling_envelope(const PolygonStack<S>& grid, std::size_t layer, State l) {
  std::vector<State> h(static_cast<std::size_t>(grid.n_states(layer)));
  const auto at = [&](State i) -> State& { return h[static_cast<std::size_t>(i)]; };
  at(l) = grid.flux_rank(layer, l);
  for (State i = l + 1; i < grid.n_states(layer); ++i)
    at(i) = std::min(at(i - 1), State(grid.flux_rank(layer, i)));
  for (State i = l - 1; i >= 0; --i) at(i) = std::max(at(i + 1), State(grid.flux_rank(layer, i)));
  return h;
}

/// Ranks of h_R(.; r): running maximum above r, running minimum below r.
template <Real S>
std::vector<State> rising_envelope(const PolygonStack<S>& grid, std::size_t layer, State r) {
  std::vector<State> h(static_cast<std::size_t>(grid.n_states(layer)));
  const auto at = [&](State i) -> State& { return h[static_cast<std::size_t>(i)]; };
  at(r) = grid.flux_rank(layer, r);
  for (State i = r + 1; i < grid.n_states(layer); ++i)
    at(i) = std::max(at(i - 1), State(grid.flux_rank(layer, i)));
  for (State i = r - 1; i >= 0; --i) at(i) = std::min(at(i + 1), State(grid.flux_rank(layer, i)));
  return h;
}

/// Rank of the flux where the two envelopes cross, walking both up the common axis of phi.
template <Real S>
State crossing_rank(const PolygonStack<S>& grid, std::size_t below, std::size_t above, State l, State r) {
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

template <Real S>
StatePair solve_between(const PolygonStack<S>& grid, std::size_t below, std::size_t above, State l, State r) {
  const State rank_l = grid.flux_rank(below, l), rank_r = grid.flux_rank(above, r);
  const State rank = crossing_rank(grid, below, above, l, r);
  // h_L falls, so a smaller flux lies above l; h_R rises, so a greater flux lies above r.
  return {nearest_with_rank(grid, below, l, rank, rank < rank_l),
          nearest_with_rank(grid, above, r, rank, rank > rank_r)};
}
template <Real S>
State solve_bottom_wall(const PolygonStack<S>& grid, State r) {
  const State zero = grid.zero_flux_rank(), rank_r = grid.flux_rank(0, r);
  return rank_r == zero ? r : nearest_with_rank(grid, 0, r, zero, zero > rank_r);
}
template <Real S>
State solve_top_wall(const PolygonStack<S>& grid, State l) {
  const std::size_t layer = grid.n_layers() - 1;
  const State zero = grid.zero_flux_rank(), rank_l = grid.flux_rank(layer, l);
  return rank_l == zero ? l : nearest_with_rank(grid, layer, l, zero, zero < rank_l);
}

}  // namespace shearfront
