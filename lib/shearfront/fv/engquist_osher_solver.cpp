// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/engquist_osher_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {

SolverResult EngquistOsherSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                        const SolverOptions& options) {
  return fv::solve(fv::Scheme::engquist_osher, scene, request, options);
}

}  // namespace shearfront
