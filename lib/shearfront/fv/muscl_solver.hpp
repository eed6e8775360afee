// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/run.hpp"

namespace shearfront {
namespace fv {

struct MusclOptions : GridOptions {
  Limiter limiter = Limiter::mc;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    GridOptions::fields(self, visit);
    visit(OptionInfo{"limiter", "what bounds the slopes", {}, kLimiterNames}, self.limiter);
  }
  [[nodiscard]] Scheme scheme() const { return {Rule::godunov, {}, limiter}; }
};

}  // namespace fv

/// MUSCL scheme, second order, on options.cells cells: phi is linear in every cell, with a slope bounded by
/// options.limiter; Godunov's flux between the states at both sides of a face; two stages of Runge-Kutta.
///
///   v_j^+- = v_j +- r_j,  F = max( s a_l f(max(v_l^+, m)), s a_r f(min(v_r^-, m)) ),  SSP-RK2
///
/// r_j is half the rise (Limiter). Next to a jump of a: the one-sided difference of the own layer, bounded by the state
/// of the own layer that has the flux of the neighbour beyond (fv/muscl.hpp). What comes out is the reconstruction: phi
/// linear, M quadratic in every cell. Guaranteed up to a Courant number of 1/2 (options.cfl = 1): the mass is kept, phi
/// stays in the range of the flux, at jumps of a too. A steady shock takes one mixed cell, and steady states are kept
/// forever. One flux with one extremum, between walls; with solid fraction see GodunovSolver; where c varies inside
/// cells what comes out has no slopes but those of c. Error: O(dz^2) in fans, O(dz) in L1 past shocks. Source: van Leer
/// (1979), J. Comput. Phys. 32, 101-136; Shu & Osher (1988), J. Comput. Phys. 77, 439-471.
struct MusclSolver : fv::GridSolver<fv::MusclOptions> {
  static constexpr std::string_view kName = "muscl";
  static constexpr std::string_view kDescription = "MUSCL scheme of second order with a choice of limiters";
  static constexpr std::string_view kScenes = "fluxes with one extremum, the same everywhere, walls";
};
static_assert(Solver<MusclSolver>);

}  // namespace shearfront
