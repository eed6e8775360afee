// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/engquist_osher_solver.hpp"

#include "shearfront/fv/solve.hpp"

namespace shearfront {
namespace {

fv::SolverOptions own_options(const EngquistOsherSolver::Options& options, const Progress& progress) {
  fv::SolverOptions own{options, {}, {}, progress};
  own.face_coefficient = options.face_coefficient;
  return own;
}

}  // namespace

std::string EngquistOsherSolver::refusal(const Scene<double>& scene, const Options& options) {
  return fv::refusal(fv::Scheme::engquist_osher, scene, own_options(options, {}));
}

std::unique_ptr<Run> EngquistOsherSolver::start(const Scene<double>& scene, const Options& options, const Watch& watch) {
  return fv::start(fv::Scheme::engquist_osher, scene, own_options(options, watch.progress));
}

}  // namespace shearfront
