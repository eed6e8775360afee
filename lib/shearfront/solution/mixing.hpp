// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/field.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront {

/// How well mixed a bed is. With x = phi / c the share of the grains at a height,
///
///   E = int e(x) c dz,   e(x) = -x ln x - (1 - x) ln(1 - x),   Psi = (E - E_seg) / (E_mix - E_seg);
///
/// E_mix = e(mean x) int c dz belongs to the uniform mixture of the same grains, E_seg = 0 to grains apart.
struct Mixing {
  double entropy = 0;  ///< E, in units of height
  double mixed = 0;    ///< E_mix; ln 2 int c dz for equal amounts
  double parameter =
      0;  ///< Psi in [0, 1]: 0 segregated, 1 uniform (0 too if there is one kind of grains only)
};

/// e(x), 0 at both ends; shares beyond [0, 1] (schemes that overshoot) count as pure.
[[nodiscard]] double entropy_of_share(double x);
/// e as a function to be integrated.
[[nodiscard]] ShareFunction entropy_function();

/// Mixing of a bed with the entropy E that holds `amount` of the grains phi counts, of `solid` = int c dz.
/// Psi <= 1 by Jensen's inequality, to rounding.
[[nodiscard]] Mixing mixing(double entropy, double amount, double solid);

/// Mixing of a profile of phi in the scene's bed, with the accuracy of share_integral(). Source: the thesis
/// named in docs/evidence/packing.md, eqs. (5.4) to (5.9).
[[nodiscard]] Mixing mixing(const Scene<double>& scene, const Profile<double>& profile);

}  // namespace shearfront
