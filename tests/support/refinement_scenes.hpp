// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "support/any_flux.hpp"
#include "support/flux_scenes.hpp"
#include "support/random_scene.hpp"
#include "support/solid_scene.hpp"

/// Random scenes of every kind there is: one name and one draw per kind.
namespace shearfront::support {

struct SceneKind {
  std::string_view name;
  SceneSpec<double> (*draw)(SceneMaker&);
};

namespace kinds {

/// Heights at least a tenth apart, so that coarse resolutions see every piece.
inline std::vector<double> wide_heights(SceneMaker& make, int n) {
  std::vector<double> z;
  while (true) {
    z = make.heights(n, 0, 1);
    bool is_wide = true;
    for (std::size_t i = 0; i <= z.size(); ++i)
      is_wide = is_wide && (i == z.size() ? 1 : z[i]) - (i == 0 ? 0 : z[i - 1]) > 0.1;
    if (is_wide) return z;
  }
}
inline double state(SceneMaker& make) {
  return make.integer(0, 3) == 0 ? make.integer(0, 1) : make.uniform(0, 1);
}
inline Piecewise<double> steps(SceneMaker& make, int n, double lo, double hi) {
  Piecewise<double> model;
  model.breaks = wide_heights(make, n - 1);
  for (int i = 0; i < n; ++i) model.values.push_back(make.uniform(lo, hi));
  return model;
}
inline Table<double> table(SceneMaker& make, int n, double lo, double hi) {
  Table<double> model;
  model.z = wide_heights(make, n - 2);
  model.z.insert(model.z.begin(), 0);
  model.z.push_back(1);
  for (int i = 0; i < n; ++i) model.values.push_back(make.uniform(lo, hi));
  return model;
}
inline void set_states(SceneMaker& make, SceneSpec<double>& spec) {
  spec.initial_breaks = wide_heights(make, make.integer(1, 3));
  double highest = 1e300;
  for (const auto& flux : spec.fluxes) highest = std::min(highest, flux.range().highest);
  for (std::size_t i = 0; i <= spec.initial_breaks.size(); ++i)
    spec.initial_values.push_back(highest * state(make));
}

inline SceneSpec<double> layers(SceneMaker& make) {
  SceneSpec<double> spec;
  spec.shear_rate = steps(make, make.integer(1, 4), 0.3, 3);
  set_states(make, spec);
  return spec;
}
inline SceneSpec<double> throat(SceneMaker& make) {
  SceneSpec<double> spec;
  Table<double> rate = table(make, 4, 1, 3);
  rate.values[1] = make.uniform(0.3, 0.6);
  spec.shear_rate = rate;
  set_states(make, spec);
  return spec;
}
inline SceneSpec<double> exponential(SceneMaker& make) {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{make.uniform(0.5, 3), make.uniform(0.3, 2)};
  set_states(make, spec);
  return spec;
}
inline SceneSpec<double> chute(SceneMaker& make) {
  SceneSpec<double> spec;
  spec.shear_rate = Chute<double>{make.uniform(0.3, 1), make.uniform(0.3, 1), make.uniform(0.2, 0.8)};
  set_states(make, spec);
  return spec;
}
/// Every flux that walls can hold, in layers.
inline SceneSpec<double> any_flux(SceneMaker& make) {
  static const auto fluxes = unimodal_fluxes();
  SceneSpec<double> spec;
  spec.fluxes = {fluxes[static_cast<std::size_t>(make.integer(0, static_cast<int>(fluxes.size()) - 1))]};
  spec.shear_rate = steps(make, make.integer(1, 3), 0.5, 2);
  set_states(make, spec);
  return spec;
}
inline SceneSpec<double> any_flux_in_a_table(SceneMaker& make) {
  SceneSpec<double> spec = any_flux(make);
  spec.shear_rate = table(make, 4, 0.5, 2);
  return spec;
}
inline SceneSpec<double> two_fluxes(SceneMaker& make) {
  SceneSpec<double> spec;
  const auto shape = static_cast<FluxShape>(make.integer(0, 3));
  spec.fluxes = {random_flux(make, shape), random_flux(make, shape)};
  spec.flux_breaks = wide_heights(make, 1);
  spec.shear_rate = steps(make, make.integer(1, 3), 0.5, 2);
  set_states(make, spec);
  return spec;
}
inline SceneSpec<double> jumps_of_everything(SceneMaker& make) {
  SceneSpec<double> spec = layers(make);
  spec.solid_fraction = steps(make, make.integer(1, 3), 0.3, 0.7);
  spec.temperature = steps(make, make.integer(1, 3), 0.5, 2);
  return spec;
}
inline SceneSpec<double> tables_of_everything(SceneMaker& make) {
  SceneSpec<double> spec = layers(make);
  spec.shear_rate = table(make, 4, 0.5, 2);
  spec.solid_fraction = table(make, 3, 0.3, 0.7);
  spec.temperature = table(make, 3, 0.5, 2);
  return spec;
}
inline SceneSpec<double> periodic(SceneMaker& make) {
  SceneSpec<double> spec = make.integer(0, 1) == 0 ? layers(make) : any_flux(make);
  spec.is_periodic = true;
  return spec;
}
inline SceneSpec<double> open(SceneMaker& make) {
  SceneSpec<double> spec = make.integer(0, 1) == 0 ? layers(make) : any_flux(make);
  const double highest = spec.fluxes[0].range().highest;
  spec.outside_bottom = OutsideState<double>{{0.3}, {highest * state(make), highest * state(make)}};
  if (make.integer(0, 1) == 0) spec.outside_top = OutsideState<double>{{}, {highest * state(make)}};
  return spec;
}
inline SceneSpec<double> one_way(SceneMaker& make) {
  SceneSpec<double> spec = layers(make);
  spec.fluxes = {BuckleyLeverett<double>{make.uniform(0.2, 4)}};
  spec.outside_bottom = OutsideState<double>{{}, {state(make)}};
  spec.outside_top = OutsideState<double>{{}, {state(make)}};
  return spec;
}
/// Through random points, 0 at both ends.
inline SceneSpec<double> wiggles(SceneMaker& make) {
  SceneSpec<double> spec;
  FluxTable<double> flux;
  for (int i = 0; i <= 6; ++i) {
    flux.phi.push_back(i / 6.0);
    flux.values.push_back(i == 0 || i == 6 ? 0 : -make.uniform(0.02, 0.25));
  }
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{}, {make.uniform(0.5, 2)}};
  set_states(make, spec);
  return spec;
}

inline void diffuse(SceneMaker& make, SceneSpec<double>& spec) {
  spec.diffusion = Diffusion<double>{std::pow(10, make.uniform(-1.6, -0.8)), {}, false};
  const int kind = make.integer(0, 2);
  if (kind == 1) spec.diffusion->follows_shear_rate = true;
  if (kind == 2) spec.diffusion->variation = steps(make, make.integer(1, 3), 0.5, 2);
}
inline SceneSpec<double> diffusion_in_layers(SceneMaker& make) {
  SceneSpec<double> spec = make.integer(0, 1) == 0 ? layers(make) : any_flux(make);
  diffuse(make, spec);
  return spec;
}
inline SceneSpec<double> diffusion_in_a_table(SceneMaker& make) {
  SceneSpec<double> spec = make.integer(0, 1) == 0 ? throat(make) : chute(make);
  diffuse(make, spec);
  return spec;
}
inline SceneSpec<double> diffusion_between_open_ends(SceneMaker& make) {
  SceneSpec<double> spec = layers(make);
  diffuse(make, spec);
  if (make.integer(0, 1) == 0) {
    spec.is_periodic = true;
  } else {
    spec.is_neumann = true;
  }
  return spec;
}
inline SceneSpec<double> diffusion_of_a_measured_start(SceneMaker& make) {
  SceneSpec<double> spec = layers(make);
  diffuse(make, spec);
  spec.initial_breaks.clear(), spec.initial_values.clear();
  const Table<double> start = table(make, 4, 0, 1);
  spec.initial_state = TableInitial<double>{start.z, start.values};
  return spec;
}

}  // namespace kinds

inline const std::vector<SceneKind> kSceneKinds{
    {"layers", kinds::layers},
    {"throat", kinds::throat},
    {"exponential", kinds::exponential},
    {"chute", kinds::chute},
    {"any flux", kinds::any_flux},
    {"any flux in a table", kinds::any_flux_in_a_table},
    {"two fluxes", kinds::two_fluxes},
    {"jumps of everything", kinds::jumps_of_everything},
    {"tables of everything", kinds::tables_of_everything},
    {"periodic", kinds::periodic},
    {"open", kinds::open},
    {"one way", kinds::one_way},
    {"wiggles", kinds::wiggles},
    {"diffusion in layers", kinds::diffusion_in_layers},
    {"diffusion in a table", kinds::diffusion_in_a_table},
    {"diffusion, open ends", kinds::diffusion_between_open_ends},
    {"diffusion of a measured start", kinds::diffusion_of_a_measured_start},
};

}  // namespace shearfront::support
