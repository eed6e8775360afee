// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront {

/// Whether c varies inside the layers that stand for it.
template <Real Scalar>
[[nodiscard]] bool has_smooth_solid_fraction(const Scene<Scalar>& scene) {
  return !is_constant_in_pieces<Scalar>(scene.spec().solid_fraction);
}

/// Height in [lo, hi], where c is smooth, below which the bed holds as much as `share` of [lo, hi] holds.
/// Newton's method, quadratic: c varies little within a layer. To rounding after three steps.
template <Real Scalar>
[[nodiscard]] Scalar height_holding(const Scene<Scalar>& scene, const Scalar& lo, const Scalar& hi,
                                    const Scalar& share) {
  constexpr int kMostSteps = 8;
  const Scalar height = hi - lo, wanted = share * (scene.mean_solid_fraction(lo, hi) * height);
  Scalar z = std::clamp(Scalar(lo + share * height), lo, hi);
  for (int i = 0; i < kMostSteps && z > lo && z < hi; ++i) {
    const Scalar excess = scene.mean_solid_fraction(lo, z) * (z - lo) - wanted;
    const Scalar next = std::clamp(Scalar(z - excess / scene.solid_fraction_at(z)), lo, hi);
    if (next == z) break;
    z = next;
  }
  return z;
}

/// The piecewise constant solution of a tracker whose layers, each with the mean of c, stand for a smooth
/// c(z): phi = x c(z), where x = phi / c is what fronts carry from layer to layer.
///
/// A front moves to the height inside its layer below which the smooth c holds what the layer held, a shift
/// of second order in the height of the layer. Guaranteed: M at all fronts and interfaces is the tracker's,
/// to rounding; pure states are 0 or c(z), to rounding where c is linear between its knots, else to the
/// distance of c from its chords. Cost: O(fronts).
template <class AnyTracker>
[[nodiscard]] Profile<typename AnyTracker::Scalar> solid_profile(
    const AnyTracker& tracker, const Scene<typename AnyTracker::Scalar>& scene,
    const LayerStack<typename AnyTracker::Scalar>& stack) {
  using Scalar = typename AnyTracker::Scalar;
  auto snapshot = tracker.snapshot();
  const std::size_t n_cells = snapshot.state.size();
  std::vector<Scalar> below(n_cells), above(n_cells);
  for (std::size_t i = 1; i < n_cells; ++i) {
    const std::size_t k = snapshot.layer[i];
    const Scalar &lo = stack.boundary(k), &hi = stack.boundary(k + 1);
    if (snapshot.z[i] > lo && snapshot.z[i] < hi)
      snapshot.z[i] = height_holding(scene, lo, hi, Scalar((snapshot.z[i] - lo) / (hi - lo)));
  }
  for (std::size_t i = 0; i < n_cells; ++i) {
    const std::size_t k = snapshot.layer[i];
    const Scalar share = tracker.grid().phi(k, snapshot.state[i]) / stack.solid_fraction(k);
    const Scalar& lo = snapshot.z[i];
    const Scalar& hi = snapshot.z[i + 1] = std::max(snapshot.z[i + 1], lo);
    const Scalar at_lo = scene.solid_fraction_at(lo), at_hi = scene.solid_fraction_at(hi);
    // A chord of c has the mean of c only where c is linear.
    const Scalar mean = hi > lo ? scene.mean_solid_fraction(lo, hi) : at_lo,
                 half = (at_hi - at_lo) / Scalar(2);
    below[i] = share * std::min(at_lo, Scalar(mean - half));
    above[i] = share * std::min(at_hi, Scalar(mean + half));
  }
  return {std::move(snapshot.z), std::move(below), std::move(above)};
}

}  // namespace shearfront
