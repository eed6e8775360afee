// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/track/pieces.hpp"

namespace shearfront {

/// The earliest times at which grains at rest can fill a bed between walls up to a height: what a polygon does not know,
/// whose last step near a pure state p is faster than f'(p).
///
/// The grains at rest on a wall are pure, and next to them moves the first front of the envelope from p to any state, whose
/// speed is at most rate |f'(p)|. So they grow through layer after layer no faster than that, from where they reach at
/// t = 0. Where f'(p) = 0 they never grow: a fan goes on for ever (Kynch's sediment). Where a fan with the state p at its
/// edge lasts, the bound is the time itself. Precondition: fluxes that are 0 at the ends of their range and nowhere
/// between. Cost of the constructor: O(pieces); of a time: O(layers).
template <Real Scalar>
class SlowestArrival {
 public:
  SlowestArrival(const LayerStack<Scalar>& stack, const std::vector<LayerState<Scalar>>& states,
                 const std::vector<Scalar>& tops)
      : stack_(stack), rounding_(Scalar(64) * unit_roundoff<Scalar>() * (stack.top() - stack.bottom())) {
    reach_ = {stack.bottom(), stack.top()};
    for (std::size_t i = 0; i < states.size() && is_pure(states[i], 0); ++i) reach_[0] = tops[i];
    for (std::size_t i = states.size(); i-- > 0 && is_pure(states[i], 1);)
      reach_[1] = i == 0 ? stack.bottom() : tops[i - 1];
  }

  /// When the bed below z (end 0) or above it (end 1) can be pure; 0 where it always was, +infinity for never.
  [[nodiscard]] Scalar until(std::size_t end, const Scalar& z) const {
    const Scalar& lo = end == 0 ? reach_[0] : z;
    const Scalar& hi = end == 0 ? z : reach_[1];
    Scalar time(0);
    for (std::size_t k = 0; k < stack_.n_layers(); ++k) {
      const Scalar d = std::min(hi, stack_.boundary(k + 1)) - std::max(lo, stack_.boundary(k));
      if (d > rounding_) time += d / speed(end, k);
    }
    return time;
  }
  /// Whether they can ever pass the interface below layer k, in the direction away from their wall.
  [[nodiscard]] bool can_pass(std::size_t end, std::size_t k) const {
    const Scalar& z = stack_.boundary(k);
    const bool has_passed = end == 0 ? reach_[0] > z : reach_[1] < z;
    return has_passed || speed(end, end == 0 ? k : k - 1) > 0;
  }
  /// The earliest time of the last change at the interface below layer k.
  [[nodiscard]] Scalar at_interface(std::size_t k, const Scalar& steady_height) const {
    const Scalar& z = stack_.boundary(k);
    const bool is_below = z<steady_height - rounding_, is_above = z> steady_height + rounding_;
    if (is_below) return can_pass(0, k) ? until(0, z) : infinity<Scalar>();
    if (is_above) return can_pass(1, k) ? until(1, z) : infinity<Scalar>();
    return at(z);
  }
  /// The earliest time at which all is pure, z being where the pure states meet in the end.
  [[nodiscard]] Scalar at(const Scalar& z) const { return std::max(until(0, z), until(1, z)); }

 private:
  /// The state of layer k that rests on the wall of an end.
  [[nodiscard]] Scalar pure_state(std::size_t end, std::size_t k) const {
    const StateRange<Scalar> range = stack_.flux(k).range();
    const auto extrema = stack_.flux(k).extrema();
    const bool sinks = !(stack_.flux(k).value(extrema.front()) > 0);
    return (end == 0) == sinks ? range.highest : range.lowest;
  }
  [[nodiscard]] bool is_pure(const LayerState<Scalar>& state, std::size_t end) const {
    return state.phi == pure_state(end, state.layer);
  }
  [[nodiscard]] Scalar speed(std::size_t end, std::size_t k) const {
    const Scalar slope = stack_.flux(k).derivative(pure_state(end, k));
    return stack_.rate(k) * (slope < 0 ? Scalar(-slope) : slope);
  }

  const LayerStack<Scalar>& stack_;
  Scalar rounding_;
  std::array<Scalar, 2> reach_;  ///< of the pure states that rest on the walls at t = 0
};

}  // namespace shearfront
