// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Copy this file to <module>/solver.hpp, rename the struct, and add one line to solver/all.hpp. Program,
/// help and cross tests follow from the list. This copy returns the initial state unchanged and says so.
struct SkeletonSolver {
  static constexpr std::string_view kName = "skeleton";  ///< --method name
  static constexpr std::string_view kDescription = "the initial state, unchanged";
  static Guarantees guarantees() { return {}; }

  static SolverResult solve(const Scene<double>& scene, const SolverRequest& request, const SolverOptions&) {
    SolverResult result;
    for (std::size_t i = 0; i < request.times.size(); ++i)
      for (const double z : request.heights) result.samples.push_back({scene.initial_phi(z), 0.0});
    result.summary.status = Status::unsupported;
    result.summary.message = "the skeleton solves nothing; use front-tracking";
    return result;
  }
};
static_assert(Solver<SkeletonSolver>);

}  // namespace shearfront
