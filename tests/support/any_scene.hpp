// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

#include "support/solid_scene.hpp"

namespace shearfront::support {

/// A sample of any flux, alone or below another one, in up to so many layers, with or without solid fraction and
/// temperature, between walls, open ends or joined ones. Not all of them are valid: see find_complaints.
inline SceneSpec<double> any_scene(SceneMaker& maker, int n_layers) {
  std::vector<Flux<double>> fluxes;
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples()) fluxes.push_back(flux);
  });
  const auto draw = [&] {
    return fluxes[static_cast<std::size_t>(maker.integer(0, static_cast<int>(fluxes.size()) - 1))];
  };
  SceneSpec<double> spec;
  spec.fluxes = {draw()};
  spec.shear_rate = maker.layers(maker.integer(1, n_layers), maker.order());
  if (maker.integer(0, 3) == 0) {
    spec.fluxes.push_back(draw());
    spec.flux_breaks = {0.4};
  }
  if (maker.integer(0, 2) == 0) spec.solid_fraction = random_profile(maker, 0.3, 0.7);
  if (maker.integer(0, 2) == 0) spec.temperature = random_profile(maker, 0.5, 2);
  double lowest = -1e300, highest = 1e300;
  for (const auto& flux : spec.fluxes) {
    lowest = std::max(lowest, flux.range().lowest);
    highest = std::min(highest, flux.range().highest);
  }
  const auto state = [&] {
    const double u = maker.integer(0, 3) == 0 ? maker.integer(0, 1) : maker.uniform(0, 1);
    return u == 1 ? highest : lowest + (highest - lowest) * u;
  };
  spec.initial_breaks = maker.heights(2, 0, 1);
  for (int i = 0; i < 3; ++i) spec.initial_values.push_back(state());
  const int ends = maker.integer(0, 3);
  spec.is_periodic = ends == 1;
  if (ends >= 2) spec.outside_bottom = OutsideState<double>{{0.2}, {state(), state()}};
  if (ends == 3) spec.outside_top = OutsideState<double>{{}, {state()}};
  return spec;
}

}  // namespace shearfront::support
