// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/fv/kernel.hpp"

namespace shearfront::fv {

/// Coefficient of a face on its upper side in the units of the cell below.
inline double coefficient_above(const Faces& faces, std::ptrdiff_t face) {
  const bool is_of_cell = faces.below != faces.above;
  return faces.ratio != nullptr && is_of_cell ? faces.above[face] / faces.ratio[face] : faces.above[face];
}

/// A flux in the units of the cell below the face and of the one above, as h.
struct FaceFlux {
  double below, above;
};

/// Flux g of a face, in the units of the cell below, for one of the stages of a step.
inline FaceFlux stage_flux(const Faces& faces, std::ptrdiff_t face, double g, double rest) {
  return {rest + g, rest + faces.ratio[face] * g};
}

/// Flux g of a face for a whole step, rounded; what the rounding leaves is kept. `v_below`, `v_above`: the
/// cells at the face before the step. Between sections: Section says what is guaranteed and why.
inline FaceFlux step_flux(const Faces& faces, std::ptrdiff_t face, double g, double v_below, double v_above,
                          double rest, double quantum) {
  const double ratio = faces.ratio[face];
  if (ratio == 1) return {rest + g, rest + g};
  double& remainder = faces.remainder[face];
  // In quanta of the faster cell; of the one below where both take the same steps. A rounding to nearest
  // would stop a small flux for good, and what goes on arriving at a thin cell beyond the face had to wait
  // there.
  const bool is_below = faces.faster_side[face] != FasterSide::above, is_down = g < 0;
  const double room =
      (is_below ? (is_down ? 1 - v_below : v_below + 1) : (is_down ? v_above + 1 : 1 - v_above)) / quantum;
  double& carry = faces.carry[face];
  const double wanted = std::min((is_below ? 1 : ratio) * std::abs(g) / quantum, room);
  const double size = std::min(std::floor(wanted + carry), room);
  carry += wanted - size;
  const double amount = is_down ? -size * quantum : size * quantum;
  const double slow_amount = (is_below ? amount * ratio : amount / ratio) + remainder;
  const double fast = rest + amount, slow = rest + slow_amount;
  remainder = slow_amount - (slow - rest);
  return is_below ? FaceFlux{fast, slow} : FaceFlux{slow, fast};
}

/// A remainder can push a cell that is all but pure beyond its bounds: the excess waits, too. `v`: states of
/// the cells above n faces.
inline void hold_back_excess(const Faces& faces, std::ptrdiff_t face, double* v, int n) {
  for (int lane = 0; lane < n; ++lane, ++face) {
    if (faces.ratio[face] == 1 || faces.faster_side[face] != FasterSide::none) continue;
    const double bounded = std::clamp(v[lane], -1.0, 1.0);
    faces.remainder[face] += v[lane] - bounded;
    v[lane] = bounded;
  }
}

}  // namespace shearfront::fv
