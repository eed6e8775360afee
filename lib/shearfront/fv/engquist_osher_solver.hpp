// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/run.hpp"

namespace shearfront {
namespace fv {

struct EngquistOsherOptions : GridOptions {
  FaceCoefficient face_coefficient = FaceCoefficient::harmonic;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    GridOptions::fields(self, visit);
    visit(OptionInfo{"face-coefficient",
                     "harmonic mean of a(z) between the middles of two cells, or its value at their face",
                     {},
                     kFaceCoefficientNames},
          self.face_coefficient);
  }
  [[nodiscard]] Scheme scheme() const { return {Rule::engquist_osher, face_coefficient}; }
};

}  // namespace fv

/// Engquist-Osher scheme, first order, on options.cells cells with Courant number options.cfl:
///
///   F = s a_face ( f(max(u_l, m)) + f(min(u_r, m)) - f(m) ),   f(m) the minimum of f,
///
/// a_face the harmonic mean of a between the middles of the two cells. Without f(m) (which cancels where a
/// is constant) the scheme would not converge for any other a. Solid fraction, several fluxes, ends and guarantees: as
/// GodunovSolver; between different fluxes and at open ends it takes Godunov's flux. A steady shock takes two mixed
/// cells. Source: Engquist & Osher (1981), Math. Comp. 36, 321-351; Towers (2000), SIAM J. Numer. Anal. 38, 681-698.
struct EngquistOsherSolver : fv::GridSolver<fv::EngquistOsherOptions> {
  static constexpr std::string_view kName = "engquist-osher";
  static constexpr std::string_view kDescription = "Engquist-Osher scheme, first order, one rate per face";
  static constexpr std::string_view kScenes =
      "any flux in a uniform bed, else with one extremum or none, open ends";
};
static_assert(Solver<EngquistOsherSolver>);

}  // namespace shearfront
