// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "shearfront/solver/solver.hpp"

namespace shearfront {

enum class Limiter { minmod, mc, van_leer };
enum class FaceCoefficient { harmonic, value };
/// Their names in files and on the command line, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kLimiterNames{"minmod", "mc", "van-leer"};
inline constexpr std::array<std::string_view, 2> kFaceCoefficientNames{"harmonic", "value"};

namespace fv {

/// What all finite-volume solvers have in common.
struct GridOptions {
  std::uint64_t cells = 400;
  /// Time step in terms of the largest for which phi is proved to stay in its range. That step has the Courant number
  /// s max a max |f'| dt / dz = 1 in first order and 1/2 in second.
  double cfl = 1.0;
  bool align_cells = false;
  bool local_steps = false;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(OptionInfo{"cells", "number of cells", {1, 1e8}}, self.cells);
    visit(OptionInfo{"cfl",
                     "time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2)",
                     {0, 1, true}},
          self.cfl);
    visit(OptionInfo{"align-cells", "edges of cells on the interfaces, equal cells within each layer"},
          self.align_cells);
    visit(OptionInfo{"local-steps", "parts of the bed that move slowly take longer time steps"}, self.local_steps);
  }
};

struct SolverOptions : GridOptions {
  Limiter limiter = Limiter::mc;
  FaceCoefficient face_coefficient = FaceCoefficient::harmonic;
  Progress progress;
};

}  // namespace fv
}  // namespace shearfront
