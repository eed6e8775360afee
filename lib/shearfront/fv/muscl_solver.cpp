// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/muscl_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {

SolverResult MusclSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                const SolverOptions& options) {
  return fv::solve(fv::Scheme::muscl, scene, request, options);
}

}  // namespace shearfront
