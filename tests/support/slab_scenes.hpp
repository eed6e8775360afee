// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <vector>

#include "shearfront/scene/scene.hpp"

/// The slab of the source: Bagnold's flow down a slope of 0.43, S_r = 0.5, D = 0.01, a block of large grains.
namespace shearfront::support {

inline BagnoldVelocity<double> source_velocity() {
  BagnoldVelocity<double> u;
  u.angle = 0.43, u.grain = 0.04, u.gravity = 1;
  return u;
}

/// Its shear rate U0 sqrt(1 - z), U0 = 3.0994652327.
inline Bagnold<double> source_shear_rate() {
  Bagnold<double> a;
  a.angle = 0.43, a.grain = 0.04, a.gravity = 1;
  return a;
}

inline SceneSpec<double> source_slab() {
  SceneSpec<double> spec;
  spec.shear_rate = source_shear_rate();
  spec.scale = 0.5;
  spec.velocity = source_velocity();
  spec.diffusion = Diffusion<double>{};
  spec.diffusion->D = 0.01;
  spec.slab = Slab<double>{1};
  spec.initial_block = Block<double>{{0, 2.0 / 3}, {0, 0.75}, 0, 1};
  return spec;
}

/// Concentration of large grains at rest: logistic in the velocity, about u0 = 1.33545831 for equal amounts.
inline double source_rest(double z) {
  return 1 / (1 + std::exp(-0.5 / 0.01 * (source_velocity().value(z) - 1.33545831)));
}

}  // namespace shearfront::support
