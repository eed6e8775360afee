// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string_view>

#include "shearfront/fit/loss/loss.hpp"

namespace shearfront::fit {

/// rho(s) = s for s <= c^2, 2 c sqrt(s) - c^2 beyond: gross errors count by their size, not by its square.
/// c = 1.345 keeps 95 % of the efficiency of least squares under Gaussian noise. Source: Huber (1964).
struct HuberLoss {
  static constexpr std::string_view kName = "huber";
  static constexpr std::string_view kDescription = "squares up to the scale, absolute values beyond";
  static constexpr bool kIsRobust = true;
  static constexpr double kDefaultScale = 1.345;

  static LossValue value(double s, double c) {
    if (s <= c * c) return {s, 1, 0};
    const double r = std::sqrt(s);
    return {2 * c * r - c * c, c / r, -c / (2 * s * r)};
  }
};

}  // namespace shearfront::fit
