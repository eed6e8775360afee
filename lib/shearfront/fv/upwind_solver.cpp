// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/upwind_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {
namespace {

fv::SolverOptions own_options(const UpwindSolver::Options& options, const Progress& progress) {
  fv::SolverOptions own{options, {}, {}, progress};
  return own;
}

}  // namespace

std::string UpwindSolver::refusal(const Scene<double>& scene, const Options& options) {
  return fv::refusal(fv::FaceRule::upwind, scene, own_options(options, {}));
}

std::unique_ptr<Run> UpwindSolver::start(const Scene<double>& scene, const Options& options, const Watch& watch) {
  return fv::start(fv::FaceRule::upwind, scene, own_options(options, watch.progress));
}

}  // namespace shearfront
