// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/godunov_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {

SolverResult GodunovSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                  const SolverOptions& options) {
  return fv::solve(fv::Scheme::godunov, scene, request, options);
}

}  // namespace shearfront
