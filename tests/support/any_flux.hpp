// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"
#include "support/random_scene.hpp"

/// Random scenes of any flux of the list.
namespace shearfront::support {

/// Every sample of every flux that walls can hold and that has one extremum.
inline std::vector<Flux<double>> unimodal_fluxes() {
  std::vector<Flux<double>> all;
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples()) {
      const auto [lowest, highest] = flux.range();
      if (flux.extrema().size() == 1 && flux.value(lowest) == 0 && flux.value(highest) == 0)
        all.push_back(flux);
    }
  });
  return all;
}

inline std::string name_of(const Flux<double>& flux) { return std::string(flux.name()); }

/// A few layers, a few jumps, states in the range of the flux.
inline SceneSpec<double> draw(SceneMaker& maker, const Flux<double>& flux, int n_layers, int n_jumps) {
  SceneSpec<double> spec;
  spec.fluxes = {flux};
  spec.shear_rate = maker.layers(n_layers, maker.order());
  spec.initial_breaks = maker.heights(n_jumps, 0, 1);
  const auto [lowest, highest] = flux.range();
  for (int i = 0; i <= n_jumps; ++i) {
    const double u = maker.integer(0, 2) == 0 ? maker.integer(0, 1) : maker.uniform(0, 1);
    spec.initial_values.push_back(u == 1 ? highest : lowest + (highest - lowest) * u);
  }
  return spec;
}

}  // namespace shearfront::support
