// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
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

/// Grids of states for layers of any fluxes with one extremum each, of one kind (all minima or all maxima),
/// convex or not, built on flux LEVELS shared by all layers; or of fluxes that all rise, or all fall: each has
/// its minimum at an end of its range, and one of the two branches is empty.
///
/// A level is a value h of the flux, counted down from 0 (up, where extrema are maxima: the state index then
/// runs from the highest state to the lowest). Layer k has a state on the falling and one on the rising
/// branch of its flux for every level between its end values and its extremum, so the interface Riemann
/// problem maps grid states to grid states. State index i = 0 ... 2 top(k): i <= top is level i on the
/// falling branch, i > top is level 2 top - i on the rising one; where the flux does not vanish at the ends
/// of its range, the first and last indices belong to no state. Precondition for monotone fluxes in unequal layers: overload(scene) is empty.
///
/// Levels: extrema, ends, initial states, and between them as few as keep the spacing of neighbouring states
/// in every layer within `resolution` of its range. The polygon through the states lies on the true flux: its
/// vertices are exact to rounding, those of initial states and extrema to the bit.
/// Guaranteed: equal levels have bitwise equal flux; speed() has the accuracy of Flux::secant, over more
/// than 1/8 of the range that of a difference of fluxes (128 roundings of the largest chord); states inside a
/// straight piece of a flux are no vertices, and all chords within it have bitwise equal speed. Memory: 48
/// to 64 bytes per level and class of layers (same flux, same rate times solid_fraction); cost of building: two root
/// searches of some four evaluations per level and class.
template <Real S>
class UnimodalGrid {
 public:
  using Scalar = S;

  struct Built;  // grid + indices of the wanted states
  static Built exact_levels(const LayerStack<S>& stack, const S& resolution,
                            const std::vector<LayerState<S>>& wanted);

  /// Why there is no grid for these layers; empty if there is.
  [[nodiscard]] static std::string refusal(const LayerStack<S>& stack, const S& resolution);

  [[nodiscard]] std::size_t n_layers() const { return layers_.size(); }
  [[nodiscard]] const S& boundary(std::size_t k) const { return boundaries_[k]; }
  [[nodiscard]] std::size_t n_levels() const { return levels_.size(); }
  [[nodiscard]] State n_states(std::size_t layer) const { return 2 * top(layer) + 1; }
  [[nodiscard]] State bottom_state(std::size_t layer) const { return top(layer); }

  [[nodiscard]] S phi(std::size_t layer, State i) const {
    return layers_[layer].solid_fraction * class_of(layer).polygon.share(i);
  }
  [[nodiscard]] S flux(std::size_t layer, State i) const {
    const S& h = levels_[index(level(layer, i))];
    return is_reversed_ ? h : S(-h);
  }
  [[nodiscard]] State flux_rank(std::size_t layer, State i) const { return -level(layer, i); }
  [[nodiscard]] State zero_flux_rank() const { return zero_rank_; }
  [[nodiscard]] State falling_state(std::size_t, State rank) const { return -rank; }
  [[nodiscard]] State rising_state(std::size_t layer, State rank) const { return 2 * top(layer) + rank; }
  [[nodiscard]] bool is_reversed() const { return is_reversed_; }

  [[nodiscard]] State next_vertex(std::size_t layer, State i) const {
    return class_of(layer).polygon.next_vertex(i);
  }
  [[nodiscard]] State previous_vertex(std::size_t layer, State i) const {
    return class_of(layer).polygon.previous_vertex(i);
  }
  [[nodiscard]] Bend bend(std::size_t layer, State lo, State hi) const {
    return class_of(layer).polygon.bend(lo, hi);
  }
  [[nodiscard]] State run_end(std::size_t layer, State i, Bend kind) const {
    return class_of(layer).polygon.run_end(i, kind);
  }

  [[nodiscard]] S speed(std::size_t layer, State l, State r) const {
    const Class& c = class_of(layer);
    const State lo = l < r ? l : r, hi = l < r ? r : l;
    if (c.polygon.is_on_one_edge(lo, hi)) return layers_[layer].rate * c.polygon.slope(lo);
    const S rise = flux(layer, hi) - flux(layer, lo), run = phi(layer, hi) - phi(layer, lo);
    const S width = phi(layer, 2 * c.top) - phi(layer, 0);
    if (S(kLongChord) * (run < 0 ? S(-run) : run) > (width < 0 ? S(-width) : width)) return rise / run;
    return layers_[layer].rate * fluxes_[c.flux].secant(c.polygon.share(lo), c.polygon.share(hi));
  }
  /// Of the characteristic of a state.
  [[nodiscard]] S edge_speed(std::size_t layer, State i) const {
    const Class& c = class_of(layer);
    return layers_[layer].rate * fluxes_[c.flux].derivative(c.polygon.share(i));
  }
  /// Bound for |speed| in all layers.
  [[nodiscard]] const S& fastest() const { return fastest_; }
  /// Whether l | r is one step of a fan: neighbouring vertices between which the flux is curved, in the order in
  /// which they move apart. A contact along a straight piece of the flux is none.
  [[nodiscard]] bool is_fan_step(std::size_t layer, State l, State r) const {
    const Class& c = class_of(layer);
    return c.polygon.is_fan_step(fluxes_[c.flux], l, r);
  }
  /// |d(speed)/d(phi)| inside the step l | r of a fan.
  [[nodiscard]] S fan_rate(std::size_t layer, State l, State r) const {
    const Class& c = class_of(layer);
    const S rate = layers_[layer].rate * c.polygon.fan_rate(fluxes_[c.flux], l, r);
    return (rate < 0 ? S(-rate) : rate) / layers_[layer].solid_fraction;
  }

 private:
  /// Layers with the same levels at the same shares phi / c.
  struct Class {
    std::size_t flux;
    S strength;  ///< rate times solid fraction: the flux of a layer is strength f(share)
    State top = 0;
    FluxPolygon<S> polygon;  ///< through the shares of all states
  };
  struct Layer {
    S rate, solid_fraction;
    std::uint32_t id;  ///< of its class
  };
  /// A level that a state of a class must have: the ends of its range, its extremum, a state wanted.
  struct Special {
    enum class Role : std::uint8_t { first_end, last_end, extremum, wanted };
    State level;
    std::uint32_t id;  ///< class
    bool is_falling;
    Role role;
    std::uint32_t number;  ///< of the wanted state
  };
  /// The class and branch whose state of this level is one step of the resolution from that of the level below; none: special.
  struct Maker {
    static constexpr std::uint32_t kNone = UINT32_MAX;
    std::uint32_t id = kNone;
    bool is_falling = false;
  };
  class Draft;  // levels under construction
  template <class>
  friend class StateMotion;
  template <class>
  friend class WantedMotion;
  static constexpr int kLongChord = 8;  // part of the range over which fluxes can be subtracted

  [[nodiscard]] static std::size_t index(State i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] const Class& class_of(std::size_t layer) const { return classes_[layers_[layer].id]; }
  [[nodiscard]] State top(std::size_t layer) const { return class_of(layer).top; }
  [[nodiscard]] State level(std::size_t layer, State i) const {
    return i <= top(layer) ? i : 2 * top(layer) - i;
  }

  std::vector<S> boundaries_;
  std::vector<Flux<S>> fluxes_;
  std::vector<Layer> layers_;
  std::vector<Class> classes_;
  std::vector<S> levels_;          // ascending
  std::vector<Maker> makers_;      // per level
  std::vector<Special> specials_;  // by level
  S resolution_{1};
  bool is_reversed_ = false;
  State zero_rank_ = 1;  // 1: no level without flux
  S fastest_{0};
};

template <Real S>
struct UnimodalGrid<S>::Built {
  UnimodalGrid grid;
  std::vector<State> states;  ///< states[i] is the index of wanted[i]
};

extern template class UnimodalGrid<double>;

}  // namespace shearfront
