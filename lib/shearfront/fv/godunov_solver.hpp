// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/run.hpp"

namespace shearfront {

/// Godunov scheme, first order, on options.cells cells with Courant number options.cfl:
///
///   F = max( s a_l f(max(u_l, m)), s a_r f(min(u_r, m)) ),   f(m) the minimum of f,
///
/// the exact flux of the Riemann problem between the two cells, also where a jumps, up or down. a_l, a_r are
/// the harmonic means of a over the cells. With solid fraction or granular temperature the states are phi / c and a
/// stands for a sqrt(T) c (fv/grid.hpp): the modified Godunov method, without overshoot, phi <= c(z) exactly.
/// Guaranteed under the Courant condition: the mass changes only by what enters or leaves at open ends, phi stays in
/// the range of the flux, L1 contraction, u <= v stays u <= v. A steady shock takes one mixed cell. L1 error of phi:
/// O(sqrt(dz)) by theory, near O(dz) in practice. Fluxes: fv/face_flux.hpp; ends: fv/march.hpp; time steps, outcomes,
/// cost: fv/run.hpp. Source: Adimurthi, Jaffre & Veerappa Gowda (2004), SIAM J. Numer. Anal. 42, 179-208.
struct GodunovSolver : fv::GridSolver<fv::RuleOptions<fv::Rule::godunov>> {
  static constexpr std::string_view kName = "godunov";
  static constexpr std::string_view kDescription = "Godunov scheme, first order, one rate per cell";
  static constexpr std::string_view kScenes =
      "any flux in a uniform bed, else with one extremum or none, open ends";
};
static_assert(Solver<GodunovSolver>);

}  // namespace shearfront
