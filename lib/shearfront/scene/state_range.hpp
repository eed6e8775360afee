// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <limits>

#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// From the least to the greatest state, phi / c, that any flux of the scene allows; its width is what a change of a
/// state is small or large beside. Precondition: the fluxes are valid.
template <Real Scalar>
[[nodiscard]] StateRange<Scalar> state_range(const SceneSpec<Scalar>& spec) {
  StateRange<Scalar> all = spec.fluxes.front().range();
  for (const Flux<Scalar>& flux : spec.fluxes) {
    const StateRange<Scalar> one = flux.range();
    all = {std::min(all.lowest, one.lowest), std::max(all.highest, one.highest)};
  }
  return all;
}

/// The states that all of its fluxes allow.
template <Real Scalar>
[[nodiscard]] StateRange<Scalar> common_states(const SceneSpec<Scalar>& spec) {
  StateRange<Scalar> common = spec.fluxes.front().range();
  for (const Flux<Scalar>& flux : spec.fluxes) {
    const StateRange<Scalar> one = flux.range();
    common = {std::max(common.lowest, one.lowest), std::min(common.highest, one.highest)};
  }
  return common;
}

/// From the least to the greatest phi at the ends and the knots of the scene and half way between them.
[[nodiscard]] inline StateRange<double> phi_range(const Scene<double>& scene) {
  StateRange<double> all = scene.range_at(scene.bottom());
  const auto take = [&](double z) {
    const StateRange<double> one = scene.range_at(z);
    all = {std::min(all.lowest, one.lowest), std::max(all.highest, one.highest)};
  };
  double below = scene.bottom();
  for (const double z : scene.knots()) {
    take(below + (z - below) / 2);
    take(z);
    below = z;
  }
  take(below + (scene.top() - below) / 2);
  take(scene.top());
  return all;
}

}  // namespace shearfront
