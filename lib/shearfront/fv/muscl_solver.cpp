// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/muscl_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {
namespace {

fv::SolverOptions own_options(const MusclSolver::Options& options, const Progress& progress) {
  fv::SolverOptions own{options, {}, {}, progress};
  own.limiter = options.limiter;
  return own;
}

}  // namespace

std::string MusclSolver::refusal(const Scene<double>& scene, const Options& options) {
  return fv::refusal(fv::Scheme::muscl, scene, own_options(options, {}));
}

std::unique_ptr<Run> MusclSolver::start(const Scene<double>& scene, const Options& options, const Watch& watch) {
  return fv::start(fv::Scheme::muscl, scene, own_options(options, watch.progress));
}

}  // namespace shearfront
