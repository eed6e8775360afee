// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "shearfront/scene/entries.hpp"

/// Scenes in other units: heights times L, times times T. Shear rates keep their numbers, their scale s takes the unit.
namespace shearfront::support {

/// Of the number of a scene with this name: what it is multiplied by.
inline double unit_factor(const Entry& entry, double L, double T) {
  const std::string_view name = entry.field;
  // Positive lengths are found by their logarithm in fits and do not say that they are heights.
  if (entry.measure == Measure::height || name.ends_with(".decay") || name.ends_with(".length") ||
      name.ends_with(".load") || name.ends_with(".width") || name.ends_with(".wavelength") ||
      name.ends_with(".small_diameter"))
    return L;
  // Density and gravity keep their numbers; so does the shear rate of a law that makes of it a speed, by a length.
  if (name.ends_with(".pressure") || name == "shear_rate.velocity") return L;
  if (name == "shear_rate.B") return 1 / L;
  if (name == "shear_rate.scale") return L / T;
  if (name == "diffusion.D") return L * L / T;
  if (name.starts_with("boundary.") && name.ends_with(".breaks")) return T;
  return 1;
}

inline SceneSpec<> in_units(SceneSpec<> spec, double L, double T) {
  const std::vector<Entry> all = entries(spec);
  const std::vector<double*> places = entry_places(spec);
  for (std::size_t i = 0; i < all.size(); ++i) *places[i] *= unit_factor(all[i], L, T);
  return spec;
}

}  // namespace shearfront::support
