// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/classical_godunov_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {
namespace {

fv::SolverOptions own_options(const ClassicalGodunovSolver::Options& options, const Progress& progress) {
  fv::SolverOptions own{options, {}, {}, progress};
  return own;
}

}  // namespace

std::string ClassicalGodunovSolver::refusal(const Scene<double>& scene, const Options& options) {
  return fv::refusal(fv::FaceRule::classical_godunov, scene, own_options(options, {}));
}

std::unique_ptr<Run> ClassicalGodunovSolver::start(const Scene<double>& scene, const Options& options, const Watch& watch) {
  return fv::start(fv::FaceRule::classical_godunov, scene, own_options(options, watch.progress));
}

}  // namespace shearfront
