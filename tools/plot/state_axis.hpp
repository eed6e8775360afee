// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <vector>

#include "shearfront/scene/scene.hpp"

namespace shearfront::tools {

/// All states allowed anywhere in the bed: what an axis or a colour bar of phi has to show.
[[nodiscard]] inline StateRange<double> states_of(const Scene<double>& scene) {
  std::vector<double> heights = scene.knots();
  heights.push_back(scene.top());
  StateRange<double> all = scene.range_at(scene.bottom());
  double below = scene.bottom();
  const auto take = [&](double z) {
    const StateRange<double> range = scene.range_at(z);
    all = {std::min(all.lowest, range.lowest), std::max(all.highest, range.highest)};
  };
  for (const double z : heights) {
    take(below + (z - below) / 2);  // layers, whose value at a knot is that above it
    take(z);
    below = z;
  }
  return all;
}

}  // namespace shearfront::tools
