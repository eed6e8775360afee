// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shearfront::diffusion {

/// max |x_i|, written so that compilers without -ffast-math use vectors.
/// 0 if n = 0.
inline double largest_magnitude(const double* x, std::size_t n) {
  constexpr std::size_t kLanes = 8;
  double lanes[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double y = std::abs(x[i + k]);
      lanes[k] = lanes[k] > y ? lanes[k] : y;
    }
  double largest = 0;
  for (; i < n; ++i) largest = std::max(largest, std::abs(x[i]));
  for (const double lane : lanes) largest = std::max(largest, lane);
  return largest;
}

}  // namespace shearfront::diffusion
