// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/riemann/flux_course.hpp"
#include "shearfront/riemann/overload.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/solver.hpp"
#include "support/random_scene.hpp"

/// Random scenes for front tracking: every flux, in layers where it allows them, between walls, open ends or without ends.
namespace shearfront::support {

/// Names of all fluxes of the list.
inline std::vector<std::string> flux_names() {
  std::vector<std::string> all;
  FluxList<double>::for_each([&]<class F>() { all.emplace_back(F::kName); });
  return all;
}

/// One of the samples of a flux.
inline Flux<double> random_sample_of(SceneMaker& make, const std::string& name) {
  std::vector<Flux<double>> samples;
  FluxList<double>::for_each([&]<class F>() {
    if (name != F::kName) return;
    for (const F& f : F::samples()) samples.push_back(f);
  });
  return samples[static_cast<std::size_t>(make.integer(0, static_cast<int>(samples.size()) - 1))];
}

namespace random_tracked_detail {

inline Piecewise<double> random_layers(SceneMaker& make, double lo, double hi, double bottom, double top) {
  Piecewise<double> model;
  const int n = make.integer(1, 3);
  model.breaks = make.heights(n - 1, bottom, top);
  for (int i = 0; i < n; ++i) model.values.push_back(make.uniform(lo, hi));
  return model;
}

inline SceneSpec<double> draw_tracked(SceneMaker& make, const std::string& name) {
  SceneSpec<double> spec;
  const Flux<double> flux = random_sample_of(make, name);
  const double lowest = flux.range().lowest, highest = flux.range().highest;
  const bool has_walls = flux.value(lowest) == 0 && flux.value(highest) == 0;
  const bool has_layers = flux.extrema().size() <= 1 && (has_walls || flux.extrema().empty());
  spec.fluxes = {flux};
  if (make.integer(0, 2) == 0) spec.bottom = 100, spec.top = 400;  // a road in metres
  const double height = spec.top - spec.bottom;
  const int n_layers = has_layers ? make.integer(1, 3) : 1;
  spec.shear_rate = make.layers(n_layers, make.order(), spec.bottom, spec.top);
  spec.scale = height * make.uniform(0.5, 2);
  if (has_layers && make.integer(0, 2) == 0)
    spec.solid_fraction = random_layers(make, 0.5, 1, spec.bottom, spec.top);
  if (has_layers && make.integer(0, 2) == 0)
    spec.temperature = random_layers(make, 0.5, 2, spec.bottom, spec.top);
  const auto share = [&] {
    if (has_walls && make.integer(0, 5) == 0) return make.integer(0, 1) == 0 ? lowest : highest;
    return lowest + (highest - lowest) * make.uniform(0.05, 0.95);
  };
  const int n_jumps = make.integer(1, 3);
  spec.initial_breaks = make.heights(n_jumps, spec.bottom, spec.top);
  for (int i = 0; i <= n_jumps; ++i) spec.initial_values.push_back(share());
  const int ends = make.integer(has_walls ? 0 : 1, 3);  // walls, open, open, periodic
  const auto outside = [&] {
    OutsideState<double> state;
    const int n = make.integer(0, 2);
    for (int i = 0; i < n; ++i) state.breaks.push_back((i + make.uniform(0.1, 1)) * 0.4);
    for (int i = 0; i <= n; ++i) state.values.push_back(share());
    return state;
  };
  if (ends == 1 || ends == 2) spec.outside_bottom = outside();
  if (ends == 1 || (ends == 2 && !has_walls)) spec.outside_top = outside();
  spec.is_periodic = ends == 3;
  return spec;
}

}  // namespace random_tracked_detail

/// A scene that layers can pass on; times of it are about 1.
inline SceneSpec<double> random_tracked_scene(SceneMaker& make, const std::string& flux) {
  for (;;) {
    const SceneSpec<double> spec = random_tracked_detail::draw_tracked(make, flux);
    if (!find_complaints(spec).empty()) continue;
    const Scene<double> scene(spec);
    if (!is_monotone(course_of(scene.fluxes().front())) || overload(scene).empty()) return spec;
  }
}

/// Places by time.
inline std::vector<Place> random_places(SceneMaker& make, const Scene<double>& scene, int n) {
  std::vector<Place> places;
  for (int i = 0; i < n; ++i) {
    const double z = scene.bottom() + (scene.top() - scene.bottom()) * make.uniform(0, 1);
    places.push_back({std::exp(make.uniform(std::log(0.05), std::log(2.0))), z});
  }
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace shearfront::support
