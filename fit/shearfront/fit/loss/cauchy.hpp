// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string_view>

#include "shearfront/fit/loss/loss.hpp"

namespace shearfront::fit {

/// rho(s) = c^2 log(1 + s / c^2): gross errors hardly count at all; needs a start near the minimum, for the
/// misfit is not convex. c = 2.385 keeps 95 % of the efficiency of least squares under Gaussian noise.
/// Source: Holland & Welsch (1977).
struct CauchyLoss {
  static constexpr std::string_view kName = "cauchy";
  static constexpr std::string_view kDescription = "logarithm of squares: gross errors hardly count";
  static constexpr bool kIsRobust = true;
  static constexpr double kDefaultScale = 2.385;

  static LossValue value(double s, double c) {
    const double c2 = c * c, x = 1 + s / c2;
    return {c2 * std::log1p(s / c2), 1 / x, -1 / (c2 * x * x)};
  }
};

}  // namespace shearfront::fit
