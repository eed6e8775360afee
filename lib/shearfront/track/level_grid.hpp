// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/track/pieces.hpp"

namespace shearfront {

template <class Grid>
class StateMotion;
template <class Grid>
class WantedMotion;

/// Grids of states for layers whose fluxes are parabolas, built on flux LEVELS shared by all layers: the
/// quadratic flux r_k phi (phi - 1), r_k = s a_k, and its affine images.
///
/// What follows is said of the quadratic flux. A layer with states from lo to hi (solid fraction included) and
/// extremum F_m has the states phi = lo + (hi - lo) u, u a state of the quadratic flux of capacity
/// c_k = |F_m|. If the extrema are maxima, phi = hi - (hi - lo) u: the state index then counts phi downwards,
/// and everything else, which goes by the index, stays as it is.
///
/// A level is a value h >= 0 of minus the flux. Layer k has the states phi = (1 -+ q)/2 with
/// q = sqrt(1 - h / c_k) for every level h <= c_k = r_k / 4 (its capacity), so the interface Riemann problem
/// maps grid states to grid states. State index i = 0 .. 2 top(k) counts phi upwards: i <= top is level i on
/// the falling branch (phi <= 1/2), i > top is level 2 top - i on the rising one.
///
/// Two ways to choose the levels (both factory functions also place the wanted states and return their
/// indices):
///   exact_levels      capacities, initial states and walls are levels, nothing is rounded; between two
///                     neighbouring capacities the levels are equally spaced in phi in the layer of the upper
///                     one, by at most `resolution`. In every other layer they are closer, so `resolution`
///                     bounds the spacing of fans everywhere, with the fewest levels that do so.
///   singular_mapping  a_k rounded to the nearest k delta, levels s j delta / 4 (Buerger, Martinez & Villada
///                     2023, Section 2.3, with the missing factor restored); initial states are rounded to
///                     the nearest state.
/// If there are more wanted states than kMaxExactStates and more than other levels, making each a vertex of
/// every layer's polygon would cost jumps x states fronts; they then keep their exact phi, and their flux is
/// read off the polygon (an error of second order in `resolution`).
///
/// Guaranteed: phi is strictly increasing in exact arithmetic, exact (not only to rounding) for wanted states
/// of exact_levels; equal levels have bitwise equal flux; speed() has a relative error of a few units in the
/// last place except where speeds of opposite sign cancel, and is exactly 0 between the two states of one
/// level. Memory: one record per level, nothing per layer and level; cost of phi(): one square root and one
/// division.
template <Real S>
class LevelGrid {
 public:
  using Scalar = S;
  static constexpr std::size_t kMaxExactStates = 64;

  struct Built;  // grid + indices of the wanted states
  static Built exact_levels(const LayerStack<S>& stack, const S& resolution,
                            const std::vector<LayerState<S>>& wanted);
  static Built singular_mapping(const LayerStack<S>& stack, const S& delta,
                                const std::vector<LayerState<S>>& wanted);

  /// Why there is no grid for these layers; empty if there is.
  [[nodiscard]] static std::string refusal(const LayerStack<S>& stack);

  /// How many levels exact_levels() would make, wanted states not counted. Cost: O(layers log layers).
  static double exact_level_count(const LayerStack<S>& stack, const S& resolution);

  [[nodiscard]] std::size_t n_layers() const { return layer_capacity_.size(); }
  [[nodiscard]] const S& boundary(std::size_t k) const { return boundaries_[k]; }
  [[nodiscard]] std::size_t n_levels() const { return levels_.size(); }
  [[nodiscard]] State n_states(std::size_t layer) const { return 2 * top(layer) + 1; }
  [[nodiscard]] State bottom_state(std::size_t layer) const { return top(layer); }
  [[nodiscard]] S rate(std::size_t layer) const { return S(4) * capacity(layer); }

  [[nodiscard]] S phi(std::size_t layer, State i) const {
    const S u = unit_phi(layer, i);
    if (ranges_.empty()) return u;
    const StateRange<S>& range = ranges_[layer];
    const S part = (range.highest - range.lowest) * u;
    return is_reversed_ ? range.highest - part : range.lowest + part;
  }
  [[nodiscard]] S flux(std::size_t layer, State i) const {
    const S& h = levels_[index(level(layer, i))].value;
    return is_reversed_ ? h : S(-h);
  }
  /// Whether fluxes have a maximum: then phi falls with the state index.
  [[nodiscard]] bool is_reversed() const { return is_reversed_; }
  [[nodiscard]] static constexpr Bend bend(std::size_t, State, State) { return Bend::convex; }
  [[nodiscard]] State run_end(std::size_t layer, State i, Bend kind) const {
    return kind == Bend::convex ? n_states(layer) - 1 : next_vertex(layer, i);
  }
  [[nodiscard]] State flux_rank(std::size_t layer, State i) const { return -level(layer, i); }
  [[nodiscard]] static State zero_flux_rank() { return 0; }
  /// The state with the given flux rank on the falling / rising branch.
  [[nodiscard]] State falling_state(std::size_t, State rank) const { return -rank; }
  [[nodiscard]] State rising_state(std::size_t layer, State rank) const { return 2 * top(layer) + rank; }

  [[nodiscard]] State next_vertex(std::size_t layer, State i) const {
    const State t = top(layer);
    return i < t ? levels_[index(i + 1)].vertex_above : 2 * t - levels_[index(2 * t - i - 1)].vertex_below;
  }

  [[nodiscard]] State previous_vertex(std::size_t layer, State i) const {
    const State last = 2 * top(layer);
    return last - next_vertex(layer, last - i);
  }

  [[nodiscard]] S speed(std::size_t layer, State l, State r) const {
    return scaled(layer, unit_speed(layer, l, r));
  }

  /// Of the characteristic of a state; not a number for one inside a chord.
  [[nodiscard]] S edge_speed(std::size_t layer, State i) const { return speed(layer, i, i); }

  /// speed(l, m) - speed(m, r), given its rounded value: between vertices it is rate (phi_l - phi_r), without
  /// the cancellation of nearly equal speeds.
  [[nodiscard]] S speed_drop(std::size_t layer, State l, State m, State r, const S& rounded) const {
    const State t = top(layer);
    const Level& level_l = levels_[index(l <= t ? l : 2 * t - l)];
    const Level& level_r = levels_[index(r <= t ? r : 2 * t - r)];
    if (level_l.home == kOnChord || level_r.home == kOnChord ||
        levels_[index(m <= t ? m : 2 * t - m)].home == kOnChord)
      return rounded;
    const bool falling_l = l <= t, falling_r = r <= t;
    if (falling_l == falling_r) {
      const S difference = p_difference(layer, level_l, level_r);
      return scaled(layer, rate(layer) * (falling_l ? difference : S(-difference)));
    }
    const S sum = root(layer, level_l) + root(layer, level_r);
    return scaled(layer, (falling_l ? S(-2) : S(2)) * capacity(layer) * sum);
  }

  /// Bound for |speed| in all layers.
  [[nodiscard]] S fastest() const {
    S most(0);
    if (ranges_.empty()) return S(4) * classes_.back().capacity;
    for (std::size_t k = 0; k < n_layers(); ++k) most = std::max(most, scaled(k, rate(k)));
    return most;
  }

  /// Whether l | r is one step of a fan (as opposed to a shock).
  [[nodiscard]] static bool is_fan_step(std::size_t, State l, State r) { return l < r; }
  /// |d(speed)/d(phi)| inside the step l | r of a fan.
  [[nodiscard]] S fan_rate(std::size_t layer, State, State) const {
    const S rate = S(8) * capacity(layer);
    if (ranges_.empty()) return rate;
    const S width = ranges_[layer].highest - ranges_[layer].lowest;
    return rate / (width * width);
  }

 private:
  /// u of a state.
  [[nodiscard]] S unit_phi(std::size_t layer, State i) const {
    const State t = top(layer);
    return i <= t ? falling_phi(layer, i) : S(1) - falling_phi(layer, 2 * t - i);
  }
  /// A speed of the quadratic flux of the layer as one of its own.
  [[nodiscard]] S scaled(std::size_t layer, const S& speed) const {
    return ranges_.empty() ? speed : speed / (ranges_[layer].highest - ranges_[layer].lowest);
  }
  [[nodiscard]] S unit_speed(std::size_t layer, State l, State r) const {
    const State t = top(layer);
    const Level& level_l = levels_[index(l <= t ? l : 2 * t - l)];
    const Level& level_r = levels_[index(r <= t ? r : 2 * t - r)];
    if (level_l.home == kOnChord || level_r.home == kOnChord) return chord_speed(layer, l, r);
    const S q_l = root(layer, level_l), q_r = root(layer, level_r);
    const bool falling_l = l <= t, falling_r = r <= t;
    if (falling_l == falling_r) return (falling_l ? S(-2) : S(2)) * capacity(layer) * (q_l + q_r);
    // A shock across the minimum: phi_l + phi_r - 1 is a difference of q, or of the distances p to the pure
    // states; the smaller of the two pairs loses nothing.
    const S difference = S(2) * q_l > S(1) && S(2) * q_r > S(1)
                             ? S(2) * (falling_p(layer, level_r, q_r) - falling_p(layer, level_l, q_l))
                             : q_l - q_r;
    return (falling_l ? S(-2) : S(2)) * capacity(layer) * difference;
  }

  // A level from a square root taken in another layer carries its rounding; "home" is the class of layers
  // where the concentration itself is known, so that no square root is taken there.
  static constexpr std::int32_t kOnChord = -1;  // p is the position between two vertices
  static constexpr std::int32_t kByValue = -2;  // only the value is known
  struct Level {
    S value;            // h
    S p;                // falling-branch phi in the home class, or the position on the chord in [0, 1]
    std::int32_t home;  // class of equal capacities, or kOnChord, kByValue
    State vertex_below, vertex_above;  // nearest vertices, itself if it is one
    State ordinal = 0;                 // number of vertices below it
  };
  using Levels = std::vector<Level>;
  struct Class {
    S capacity;
    State top;
  };

  [[nodiscard]] static std::size_t index(State i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] State top(std::size_t layer) const { return classes_[layer_capacity_[layer]].top; }
  [[nodiscard]] const S& capacity(std::size_t layer) const {
    return classes_[layer_capacity_[layer]].capacity;
  }
  [[nodiscard]] State level(std::size_t layer, State i) const {
    return i <= top(layer) ? i : 2 * top(layer) - i;
  }

  /// q = sqrt(1 - h / c) of a vertex level.
  [[nodiscard]] S root(std::size_t layer, const Level& h) const {
    using std::sqrt;
    const std::uint32_t id = layer_capacity_[layer];
    if (h.home == static_cast<std::int32_t>(id)) return S(1) - S(2) * h.p;
    const S& c = classes_[id].capacity;
    S rest = c - h.value;
    if (h.home >= 0) {
      const S& home = classes_[static_cast<std::size_t>(h.home)].capacity;
      // The difference of the capacities is exact below 2 c (Sterbenz), so next to 1/2, where h is close to
      // c, only q itself is rounded.
      if (home <= S(2) * c) {
        const S q = S(1) - S(2) * h.p;
        rest = (c - home) + home * (q * q);
      }
    }
    if (!(rest > 0)) return S(0);
    if (!(rest < c)) return S(1);
    return sqrt(rest / c);
  }
  /// (1 - q) / 2 of a vertex level without cancellation.
  [[nodiscard]] S falling_p(std::size_t layer, const Level& h, const S& q) const {
    if (h.home == static_cast<std::int32_t>(layer_capacity_[layer])) return h.p;
    return h.value / (S(2) * capacity(layer) * (S(1) + q));
  }
  /// falling_p(a) - falling_p(b) of two vertex levels, from the difference of the levels.
  [[nodiscard]] S p_difference(std::size_t layer, const Level& a, const Level& b) const {
    const auto own = static_cast<std::int32_t>(layer_capacity_[layer]);
    if (a.home == own && b.home == own) return a.p - b.p;
    const S sum = root(layer, a) + root(layer, b);
    if (!(sum > 0)) return S(0);
    return rise(a, b) / (S(2) * capacity(layer) * sum);
  }
  /// a.value - b.value of two vertex levels, from the concentrations they were made of where those lose less.
  [[nodiscard]] S rise(const Level& a, const Level& b) const {
    if (a.home < 0 || b.home < 0) return a.value - b.value;
    const S& c_a = classes_[static_cast<std::size_t>(a.home)].capacity;
    const S q_a = S(1) - S(2) * a.p, q_b = S(1) - S(2) * b.p;
    if (a.home == b.home) return S(2) * c_a * (a.p - b.p) * (q_a + q_b);
    // Next to 1/2 the values are all but the capacities, whose difference is exact (Sterbenz) if there is
    // anything to lose.
    if (!(q_a + q_b < S(1))) return a.value - b.value;
    const S& c_b = classes_[static_cast<std::size_t>(b.home)].capacity;
    return (c_a - c_b) + (c_b * (q_b * q_b) - c_a * (q_a * q_a));
  }
  [[nodiscard]] S falling_phi(std::size_t layer, State i) const {
    const Level& h = levels_[index(i)];
    if (h.home == static_cast<std::int32_t>(layer_capacity_[layer])) return h.p;
    if (h.home == kOnChord) {
      const S lo = falling_phi(layer, h.vertex_below), hi = falling_phi(layer, h.vertex_above);
      return lo + h.p * (hi - lo);
    }
    if (!vertex_phi_.empty()) return vertex_phi_[layer_capacity_[layer] * n_vertices_ + index(h.ordinal)];
    return falling_p(layer, h, root(layer, h));
  }
  /// Speed when at least one state lies inside a chord. All fronts inside one chord have bitwise the same
  /// speed.
  [[nodiscard]] S chord_speed(std::size_t layer, State l, State r) const {
    const State t = top(layer);
    const auto [l_lo, l_hi] = chord(layer, l);
    const auto [r_lo, r_hi] = chord(layer, r);
    const State lo = std::min(l_lo, r_lo), hi = std::max(l_hi, r_hi);
    if (hi == next_vertex(layer, lo)) return unit_speed(layer, lo, hi);
    const S h_l = levels_[index(l <= t ? l : 2 * t - l)].value,
            h_r = levels_[index(r <= t ? r : 2 * t - r)].value;
    return (h_l - h_r) / (unit_phi(layer, r) - unit_phi(layer, l));
  }
  /// The two vertices around a state; the state itself twice if it is one.
  [[nodiscard]] std::pair<State, State> chord(std::size_t layer, State i) const {
    const State t = top(layer);
    const Level& h = levels_[index(i <= t ? i : 2 * t - i)];
    return i <= t ? std::pair(h.vertex_below, h.vertex_above)
                  : std::pair(2 * t - h.vertex_above, 2 * t - h.vertex_below);
  }

  struct Draft;  // levels under construction
  template <class>
  friend class StateMotion;
  template <class>
  friend class WantedMotion;

  void set_classes(const LayerStack<S>& stack);

  std::vector<S> boundaries_;
  std::vector<StateRange<S>> ranges_;  // states of every layer; empty: from 0 to 1 in all
  bool is_reversed_ = false;
  std::vector<std::uint32_t> layer_capacity_;  // layer -> class
  std::vector<Class> classes_;                 // distinct capacities, ascending
  // falling_phi of every vertex in every class, kept where states lie on chords: those ask for two square
  // roots each.
  std::vector<S> vertex_phi_;
  std::size_t n_vertices_ = 0;
  Levels levels_;  // ascending
};

template <Real S>
struct LevelGrid<S>::Built {
  LevelGrid grid;
  std::vector<State> states;  ///< states[i] is the index of wanted[i]
};

extern template class LevelGrid<double>;

}  // namespace shearfront
