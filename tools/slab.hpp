// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "shearfront/solver/method.hpp"

/// `solve` of a slab: phi(x, z, t).
namespace shearfront::tools {

struct SlabTask {
  const Scene<double>& scene;
  const Method& method;
  std::vector<double> times, heights;
  std::string positions;  ///< the list of x as it was given; empty: the middles of the cells
  std::string output, map;
  bool json = false;
};

/// Writes phi at all times, positions and heights, and draws its frames if there is a `map`. Returns an exit code.
/// Precondition: the method solves slabs.
[[nodiscard]] int solve_slab(const SlabTask& task);

}  // namespace shearfront::tools
