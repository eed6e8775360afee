// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "shearfront/fv/options.hpp"
#include "support/random_scene.hpp"

/// Random scenes and grids for the laws of finite volumes.
namespace shearfront::support {

inline SceneMaker maker_of(int number) { return SceneMaker(seed_of(7000 + std::uint64_t(number))); }
inline Scene<double> draw(SceneMaker& maker) {
  return Scene<double>(maker.data(maker.integer(1, 6), maker.order(), 12));
}
inline fv::GridOptions options_of(SceneMaker& maker) {
  fv::GridOptions options;
  options.cells = static_cast<std::uint64_t>(maker.integer(1, 150));
  options.cfl = maker.integer(0, 1) == 0 ? 1.0 : maker.uniform(0.1, 1);
  options.align_cells = maker.integer(0, 1) == 1;
  return options;
}
/// The options of a solver with these for its grid.
template <class Solver>
typename Solver::Options with_grid(const fv::GridOptions& grid) {
  typename Solver::Options options;
  static_cast<fv::GridOptions&>(options) = grid;
  return options;
}

}  // namespace shearfront::support
