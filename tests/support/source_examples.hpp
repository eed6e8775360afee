// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/scene/scene.hpp"

/// The examples of the source paper, as the data sets may-2010-piecewise and may-2010-exponential give them.
namespace shearfront::support {

/// Small grains over large ones, the shear rate 2.4 below z = 0.29 and 0.31 above.
inline Scene<double> example_1() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

/// The same bed, the shear rate falls off exponentially.
inline Scene<double> example_2() {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{0.87 / 0.205, 0.205};
  spec.scale = 13.60;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

}  // namespace shearfront::support
