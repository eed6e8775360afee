// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>
#include <vector>

#include "shearfront/scene/scene_spec.hpp"
#include "support/random_scene.hpp"

/// Beds whose rate is a table, in 0 .. 1.
namespace shearfront::support {

inline SceneSpec<double> table_scene(Table<double> table, std::vector<double> breaks,
                                     std::vector<double> values, double scale = 1) {
  SceneSpec<double> spec;
  spec.shear_rate = std::move(table);
  spec.scale = scale;
  spec.initial_breaks = std::move(breaks);
  spec.initial_values = std::move(values);
  return spec;
}
/// A table in 0 .. 1 with knots at these heights, of rates that rate() makes: humps, throats, flats, jumps.
template <class Rate>
Table<double> table_with_knots(SceneMaker& make, const std::vector<double>& knots, const Rate& rate) {
  Table<double> table{{0}, {rate()}};
  for (const double z : knots) {
    table.z.push_back(z);
    table.values.push_back(make.integer(0, 4) == 0 ? table.values.back() : rate());
    if (make.integer(0, 4) > 0) continue;
    table.z.push_back(z);
    table.values.push_back(rate());
  }
  table.z.push_back(1);
  table.values.push_back(rate());
  return table;
}
/// One piece: a = 2 - 1.5 z.
inline SceneSpec<double> one_piece() { return table_scene({{0, 1}, {2, 0.5}}, {0.5}, {0, 1}, 1.3); }
/// A hump, a throat, a hump.
inline SceneSpec<double> four_pieces() {
  return table_scene({{0, 0.3, 0.55, 0.8, 1}, {0.5, 1.6, 0.4, 0.9, 0.6}}, {0.25, 0.6}, {0.35, 0.9, 0.2});
}

}  // namespace shearfront::support
