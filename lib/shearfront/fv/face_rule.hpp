// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/flux_branches.hpp"

namespace shearfront::fv {

/// Numerical fluxes of the plain march, between x_l in the cell below and x_r above, x = phi / c. k is the
/// coefficient s a sqrt(T) c of a cell, f its flux with the extremum m, here a minimum (for a maximum
/// exchange min and max, and the orders of states):
///
///   godunov             max( k_l f_l(max(x_l, m_l)), k_r f_r(min(x_r, m_r)) )
///   engquist_osher      k_face ( f(max(x_l, m)) + f(min(x_r, m)) - f(m) ); between unequal f as godunov
///   upwind              the smaller one of k_l f_l(x_l) and k_r f_r(x_r) where phi rises across the
///                       face, the larger one where it falls: the flux of the side the jump comes from
///   classical_godunov   the same, and the extremum of f, with the larger k, in a fan that has it between
///
/// godunov and engquist_osher are monotone: x stays in the range of f. For a flux with no extremum, or
/// several, they take the extremum of f between the states and f(lo) + rise(x_l) + fall(x_r), with equal k.
/// The other two lack the balance k_l f_l = k_r f_r at jumps.
/// Sources: fv/kernel.hpp; classical_godunov and upwind: the thesis named in docs/packing.md,
/// Sections 4.2, 4.3.
enum class FaceRule { godunov, engquist_osher, classical_godunov, upwind };

/// One side of a face.
struct FaceSide {
  const FluxBranches* flux;
  double coefficient;  ///< k
  double solid_fraction;      ///< c
  double x;
  double upward, downward;  ///< f(max(x, m)) and f(min(x, m)), or rise and fall
};

/// Fills in the branches of f.
[[nodiscard]] FaceSide face_side(const FluxBranches& flux, double coefficient, double solid_fraction, double x);

[[nodiscard]] double face_flux(FaceRule rule, const FaceSide& below, const FaceSide& above,
                               double face_coefficient);

}  // namespace shearfront::fv
