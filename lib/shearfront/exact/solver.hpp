// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Exact solution by the Lax-Hopf formula in a layered medium (see exact/exact_solution.hpp).
struct ExactSolver {
  static constexpr std::string_view kName = "exact";
  static constexpr std::string_view kDescription = "Lax-Hopf formula, exact to rounding";
  static Guarantees guarantees() {
    Guarantees g;
    g.exact = g.conservative = g.bounded = g.has_timeline = true;
    g.scope = {FluxScope::convex_or_concave, true, false};
    return g;
  }
  static SolverResult solve(const Scene<double>& scene, const SolverRequest& request,
                            const SolverOptions& options);
};
static_assert(Solver<ExactSolver>);

}  // namespace shearfront
