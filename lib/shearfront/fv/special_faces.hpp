// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/fv/kernel.hpp"

namespace shearfront::fv {

/// Coefficient of a face on its upper side in the units of the cell below.
inline double coefficient_above(const Faces& faces, std::ptrdiff_t face) {
  const bool is_of_cell = faces.below != faces.above;
  return faces.ratio != nullptr && is_of_cell ? faces.above[face] / faces.ratio[face] : faces.above[face];
}

/// Turns the fluxes h of n faces into the units of the cells above. With `keeps_remainder` what the rounding
/// leaves is kept.
inline void to_units_above(const Faces& faces, std::ptrdiff_t face, double* h, int n, double rest,
                           bool keeps_remainder) {
  for (int lane = 0; lane < n; ++lane, ++face) {
    if (faces.ratio[face] == 1) continue;
    const double amount =
        faces.ratio[face] * (h[lane] - rest) + (keeps_remainder ? faces.remainder[face] : 0);
    h[lane] = rest + amount;
    if (keeps_remainder) faces.remainder[face] = amount - (h[lane] - rest);
  }
}

/// A remainder can push a cell that is all but pure beyond its bounds: the excess waits, too. `v`: states of
/// the cells above n faces.
inline void hold_back_excess(const Faces& faces, std::ptrdiff_t face, double* v, int n) {
  for (int lane = 0; lane < n; ++lane, ++face) {
    if (faces.ratio[face] == 1) continue;
    const double bounded = std::clamp(v[lane], -1.0, 1.0);
    faces.remainder[face] += v[lane] - bounded;
    v[lane] = bounded;
  }
}

}  // namespace shearfront::fv
