// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/run.hpp"

namespace shearfront {

/// Upwind scheme, first order, kept for comparison: the flux of the cell from which the jump between two
/// cells comes, by the sign of its speed (k_r f(x_r) - k_l f(x_l)) / (phi_r - phi_l) (fv::Rule::upwind).
/// Without balance at jumps, like classical-godunov, so phi exceeds c(z); and fans through the extremum of f
/// stay jumps, which are no solutions. Guaranteed: the mass is kept, nothing else. Half the time step of
/// godunov. Parabolas only. Tables: docs/evidence/packing.md, also for the source.
struct UpwindSolver : fv::GridSolver<fv::RuleOptions<fv::Rule::upwind>> {
  static constexpr std::string_view kName = "upwind";
  static constexpr std::string_view kDescription = "upwind scheme by the speed of jumps; overshoots";
  static constexpr std::string_view kScenes = "parabolas, open ends";
};
static_assert(Solver<UpwindSolver>);

}  // namespace shearfront
