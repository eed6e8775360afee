// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Event-driven front tracking (see track/tracker.hpp).
struct FrontTrackingSolver {
  static constexpr std::string_view kName = "front-tracking";
  static constexpr std::string_view kDescription = "event-driven front tracking, exact for a polygonal flux";
  static Guarantees guarantees() {
    Guarantees g;
    g.conservative = g.bounded = g.has_fronts = g.has_timeline = g.has_profiles = true;
    g.scope = {FluxScope::one_extremum};
    g.order_phi = 1;
    g.order_M = 2;
    return g;
  }
  static SolverResult solve(const Scene<double>& scene, const SolverRequest& request,
                            const SolverOptions& options);
};
static_assert(Solver<FrontTrackingSolver>);

}  // namespace shearfront
