// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace shearfront::fit {

/// The (n + 1) p-th of n sorted numbers, interpolated linearly; infinite ones are not averaged with others.
/// Precondition: there is one at least.
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double p) {
  const double place = p * static_cast<double>(sorted.size() + 1) - 1;
  const double last = static_cast<double>(sorted.size() - 1);
  const double below = std::clamp(std::floor(place), 0.0, last);
  const auto i = static_cast<std::size_t>(below);
  const double above = sorted[std::min(i + 1, sorted.size() - 1)],
               weight = std::clamp(place - below, 0.0, 1.0);
  return weight == 0 || above == sorted[i] ? sorted[i] : sorted[i] + weight * (above - sorted[i]);
}

}  // namespace shearfront::fit
