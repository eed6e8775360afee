// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>

#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// What bounds the slope in a cell, from the differences to the cells below and above: minmod, half the smaller one;
/// mc (monotonised central), the mean of both halves, at most the smaller difference; van_leer, half the harmonic
/// mean of both; 0 at an extremum.
enum class Limiter { minmod, mc, van_leer };
/// Coefficient of a face: harmonic mean of a between the middles of the cells, or a(z) there.
enum class FaceCoefficient { harmonic, value };
/// Their names in files and on the command line, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> kLimiterNames{"minmod", "mc", "van-leer"};
inline constexpr std::array<std::string_view, 2> kFaceCoefficientNames{"harmonic", "value"};

namespace fv {

/// What all finite-volume solvers have in common.
struct GridOptions {
  std::uint64_t cells = 400;
  double cfl = 1;  ///< time step over the largest one (March::largest_step)
  bool align_cells = false;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(OptionInfo{"cells", "number of cells", {1, 1e8}}, self.cells);
    visit(
        OptionInfo{
            "cfl",
            "time step over the largest for which the bounds of phi are proved (Courant number 1, muscl 1/2)",
            {0, 1, true}},
        self.cfl);
    visit(OptionInfo{"align-cells", "edges of cells on the interfaces, equal cells within each layer"},
          self.align_cells);
  }
};

}  // namespace fv
}  // namespace shearfront
