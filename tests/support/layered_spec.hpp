// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>
#include <vector>

#include "shearfront/scene/scene_spec.hpp"

namespace shearfront::support {

/// A bed on [0, 1] with a(z) and phi(z, 0) constant between heights.
inline SceneSpec<double> layered(std::vector<double> breaks, std::vector<double> a, std::vector<double> jumps,
                                 std::vector<double> values) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{std::move(breaks), std::move(a)};
  spec.initial_breaks = std::move(jumps);
  spec.initial_values = std::move(values);
  return spec;
}

}  // namespace shearfront::support
