// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "shearfront/fit/loss/loss.hpp"

namespace shearfront::fit {

/// rho(s) = s: least squares, the best there is for Gaussian noise, led astray by a single gross error.
struct SquaredLoss {
  static constexpr std::string_view kName = "squared";
  static constexpr std::string_view kDescription = "least squares";
  static constexpr bool kIsRobust = false;
  static constexpr double kDefaultScale = 1;

  static LossValue value(double s, double /*scale*/) { return {s, 1, 0}; }
};

}  // namespace shearfront::fit
