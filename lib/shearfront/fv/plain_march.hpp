// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/fv/face_rule.hpp"
#include "shearfront/fv/grid.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// The march for scenes that March does not know: different fluxes, open and periodic ends, fluxes with
/// several extrema or none; one plain loop, 20 times slower. States are shares x = phi / c.
///
///   x_j -= dt / (int_cell c dz) (F_{j+1} - F_j),   F by a FaceRule
///
/// Ends: at a wall F = 0; at an open end the flux of a face between the state outside, taken for one of the
/// flux and coefficient of the end cell, and that cell: what enters and what leaves is decided as at any
/// other face, in the sense of Bardos, LeRoux & Nedelec (1979), Comm. PDE 4, 1017-1034; a periodic bed has
/// one more inner face.
///
/// Guaranteed for godunov and engquist_osher and steps <= largest_step(): x stays in the range of the flux
/// exactly; L1 contraction and x <= y stays x <= y, both to rounding. For all rules the amount int phi dz
/// changes by inflow() only, to rounding: what a sum rounds away is kept for the next step.
class PlainMarch {
 public:
  PlainMarch(FaceRule rule, const Scene<double>& scene, const Grid& grid, FaceCoefficient face_coefficient);

  [[nodiscard]] std::size_t n_cells() const { return x_.size(); }
  [[nodiscard]] const std::vector<double>& states() const { return x_; }
  /// int phi dz; and what has come in through both ends since the beginning.
  [[nodiscard]] double amount() const;
  [[nodiscard]] double inflow() const { return inflow_.value(); }

  /// Up to which the rule is monotone; for the other rules half of it. Infinite if nothing moves.
  [[nodiscard]] double largest_step() const { return largest_step_; }
  /// States beyond the open ends from now on; NaN: none (a wall).
  void set_outside(std::array<double, 2> shares) { outside_ = shares; }
  /// Between walls: the last state of godunov, all that leads pure on the side where it collects, with one
  /// mixed cell. (That of engquist_osher differs in the two cells next to it.)
  void settle();
  /// Returns the largest |change| of a state.
  double step(double dt);

 private:
  void set_end_coefficients(const Scene<double>& scene);
  [[nodiscard]] FaceSide side(std::size_t j) const { return beside(j, x_[j]); }
  [[nodiscard]] FaceSide beside(std::size_t j, double x) const {
    return face_side(branches_[flux_of_[j]], coefficients_[j], packings_[j], x);
  }

  FaceRule rule_;
  bool is_bounded_, is_periodic_;
  std::vector<FluxBranches> branches_;
  std::vector<std::size_t> flux_of_;
  std::vector<double> coefficients_, packings_, capacities_, face_coefficients_;
  std::vector<double> x_, rest_, fluxes_;
  std::array<double, 2> outside_;
  CompensatedSum<double> inflow_;
  double largest_step_;
};

}  // namespace shearfront::fv
