// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/run.hpp"

namespace shearfront {

/// Godunov scheme as it is without thought for jumps of a, c or T, first order, kept for comparison:
/// Godunov's formula, the least flux between the states of two cells where phi rises across the face and the
/// largest where it falls, with the cells' own fluxes, whether or not the other cell can carry as much
/// (fv::Rule::classical_godunov). What cannot be carried on piles up: phi exceeds c(z), by O(dz) where the
/// coefficients are continuous, by an amount that does not fall with dz at a jump; at large jumps the scheme
/// diverges. It is `godunov` where the coefficients are constant. Guaranteed: the mass is kept, nothing else.
/// Half the time step of godunov, since shares beyond [0, 1] are faster. Parabolas only. Tables:
/// docs/evidence/packing.md, also for the source.
struct ClassicalGodunovSolver : fv::GridSolver<fv::RuleOptions<fv::Rule::classical_godunov>> {
  static constexpr std::string_view kName = "classical-godunov";
  static constexpr std::string_view kDescription =
      "Godunov scheme that does not match fluxes at jumps; overshoots";
  static constexpr std::string_view kScenes = "parabolas, open ends";
};
static_assert(Solver<ClassicalGodunovSolver>);

}  // namespace shearfront
