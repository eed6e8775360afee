// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/godunov_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {
namespace {

fv::SolverOptions own_options(const GodunovSolver::Options& options, const Progress& progress) {
  fv::SolverOptions own{options, {}, {}, progress};
  return own;
}

}  // namespace

std::string GodunovSolver::refusal(const Scene<double>& scene, const Options& options) {
  return fv::refusal(fv::Scheme::godunov, scene, own_options(options, {}));
}

std::unique_ptr<Run> GodunovSolver::start(const Scene<double>& scene, const Options& options, const Watch& watch) {
  return fv::start(fv::Scheme::godunov, scene, own_options(options, watch.progress));
}

}  // namespace shearfront
