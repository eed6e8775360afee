// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

#include "shearfront/solver/solver.hpp"
#include "support/random_scene.hpp"

/// Random scenes and grids for the laws of finite volumes.
namespace shearfront::support {

inline SceneMaker maker_of(int number) { return SceneMaker(seed_of(7000 + std::uint64_t(number))); }
inline Scene<double> draw(SceneMaker& maker) {
  return Scene<double>(maker.data(maker.integer(1, 6), maker.order(), 12));
}
inline SolverOptions options_of(SceneMaker& maker) {
  SolverOptions options;
  options.cells = static_cast<std::size_t>(maker.integer(1, 150));
  options.cfl = maker.integer(0, 1) == 0 ? 1.0 : maker.uniform(0.1, 1);
  options.align_cells = maker.integer(0, 1) == 1;
  options.local_steps = maker.integer(0, 1) == 1;
  return options;
}

}  // namespace shearfront::support
