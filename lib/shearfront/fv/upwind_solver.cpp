// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/upwind_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {

SolverResult UpwindSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                 const SolverOptions& options) {
  return fv::solve(fv::FaceRule::upwind, scene, request, options);
}

}  // namespace shearfront
