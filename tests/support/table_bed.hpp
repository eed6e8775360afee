// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/scene/scene_spec.hpp"

namespace shearfront::support {

/// A shear cell 42 mm high with 12 measured shear rates, in mm and seconds, filled in three layers.
inline SceneSpec<double> bed_of_42_mm() {
  SceneSpec<double> spec;
  spec.shear_rate = Table<double>{
      {0, 1.5, 3, 5, 7.5, 10.5, 14, 18, 23, 28.5, 35, 42},
      {0.2999, 0.2738, 0.2666, 0.218, 0.1598, 0.1382, 0.1023, 0.0782, 0.0486, 0.035, 0.0212, 0.0132}};
  spec.initial_breaks = {12, 30};
  spec.initial_values = {0, 1, 0.35};
  spec.top = 42;
  return spec;
}

}  // namespace shearfront::support
