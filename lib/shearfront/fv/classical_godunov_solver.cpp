// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/classical_godunov_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {

SolverResult ClassicalGodunovSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                           const SolverOptions& options) {
  return fv::solve(fv::FaceRule::classical_godunov, scene, request, options);
}

}  // namespace shearfront
