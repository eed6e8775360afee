// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"
#include "support/random_scene.hpp"

/// Beds with random solid fraction and temperature.
namespace shearfront::support {

/// Layers or a table of values in [least, most].
inline DepthFunction<double> random_profile(SceneMaker& maker, double least, double most) {
  const int n = maker.integer(1, 6);
  std::vector<double> values;
  for (int i = 0; i < n + 1; ++i) values.push_back(maker.uniform(least, most));
  std::vector<double> heights = maker.heights(n - 1, 0, 1);
  if (maker.integer(0, 1) == 0) {
    values.pop_back();
    return Piecewise<double>{std::move(heights), std::move(values)};
  }
  heights.insert(heights.begin(), 0.0);
  heights.push_back(1.0);
  return Table<double>{std::move(heights), std::move(values)};
}

/// Which grains phi counts: small ones sink, large ones rise.
enum class Grains { small, large };
inline Flux<double> flux_of(Grains grains) {
  return grains == Grains::small ? Flux<double>(Quadratic<double>{}) : Flux<double>(Lwr<double>{});
}

inline SceneSpec<double> solid_data(SceneMaker& maker, Grains grains) {
  SceneSpec<double> spec = maker.data(maker.integer(1, 4), maker.order(), 6);
  spec.fluxes = {flux_of(grains)};
  spec.solid_fraction = random_profile(maker, 0.05, 0.75);
  spec.temperature = random_profile(maker, 0.1, 4);
  return spec;
}

/// Largest phi - c(z) at the ends of the pieces of a profile, where phi - c is largest (both are linear
/// between); 0 if nowhere positive.
inline double overshoot(const Scene<double>& scene, const Profile<double>& profile) {
  double most = 0;
  for (std::size_t i = 0; i < profile.n_cells(); ++i) {
    const double lo = profile.z()[i], hi = profile.z()[i + 1];
    const bool is_layered = !scene.spec().solid_fraction ||
                            std::holds_alternative<Piecewise<double>>(*scene.spec().solid_fraction);
    most = std::max(most, profile.below()[i] - scene.solid_fraction_at(lo));
    most = std::max(most, profile.above()[i] - scene.solid_fraction_at(is_layered ? lo : hi));
  }
  return most;
}

}  // namespace shearfront::support
