// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/fv/cell_profile.hpp"
#include "shearfront/fv/run.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solver/solve.hpp"

/// The cells of a finite-volume solution, through the interface of all solvers.
namespace shearfront::support {

using fv::grid_of;

inline std::vector<double> middles(const fv::Grid& grid) {
  std::vector<double> z;
  for (std::size_t j = 0; j < grid.n_cells(); ++j) z.push_back(grid.middle(j));
  return z;
}

/// phi of all cells, one vector per time. Fails loudly, by an empty result, if there is none.
template <class Solver>
std::vector<std::vector<double>> cell_states(const Scene<double>& scene, const std::vector<double>& times,
                                             const typename Solver::Options& options) {
  const fv::Grid grid = grid_of(scene, options);
  const SolverResult result = solve<Solver>(scene, {times, middles(grid)}, options);
  std::vector<std::vector<double>> states;
  if (!result.summary.usable()) return states;
  for (std::size_t i = 0; i < times.size(); ++i) {
    states.emplace_back();
    for (std::size_t j = 0; j < grid.n_cells(); ++j) states.back().push_back(result.at(i, j).phi);
  }
  return states;
}

inline Profile<double> profile_of(const Scene<double>& scene, const std::vector<double>& phi) {
  return fv::cell_profile(scene, fv::equal_cells(scene, phi.size()), {phi, {}});
}

}  // namespace shearfront::support
