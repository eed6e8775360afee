// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Beds with diffusion by diffusion::CrankNicolson: second order in space and time, conservative, with
/// adaptive steps unless SolverOptions::time_step is given.
///
/// Reads cells, time_step, tolerance, cell_tolerance, monotone. Domain: scenes with an empty
/// diffusion::refusal(). Steady state: march until the bed is at rest. Errors: Summary with
/// Status::unsupported, not_converged, budget_reached, interrupted. Cost: O(cells) a step. Small D: with
/// cell_tolerance the cost of a step hardly depends on D, where equal cells take 1 / D of them.
struct CrankNicolsonSolver {
  static constexpr std::string_view kName = "crank-nicolson";
  static constexpr std::string_view kDescription = "beds with diffusion: conservative Crank-Nicolson scheme";
  static Guarantees guarantees() {
    Guarantees g;
    g.conservative = g.has_profiles = true;
    g.order_phi = g.order_M = 2;
    g.scope = Scope::with_diffusion();
    return g;
  }
  static SolverResult solve(const Scene<double>& scene, const SolverRequest& request,
                            const SolverOptions& options);
};
static_assert(Solver<CrankNicolsonSolver>);

namespace diffusion {

/// Why the solver cannot compute a scene with these settings; empty if it can.
[[nodiscard]] std::string refusal(const Scene<double>& scene, const SolverOptions& options);
/// The settings of the engine that follow from those of the solver.
[[nodiscard]] Options options_of(const SolverOptions& options);

}  // namespace diffusion

}  // namespace shearfront
