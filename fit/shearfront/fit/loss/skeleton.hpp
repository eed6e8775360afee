// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "shearfront/fit/loss/loss.hpp"

namespace shearfront::fit {

/// Copy this file to loss/<name>.hpp, rename the struct, and add one line to loss/all.hpp. rho must rise with
/// s from rho(0) = 0 with slope 1; scale is the residual, in units of its standard deviation, where it bends.
struct SkeletonLoss {
  static constexpr std::string_view kName = "skeleton";  ///< misfit.loss in fit files
  static constexpr std::string_view kDescription = "least squares";
  static constexpr bool kIsRobust = false;
  static constexpr double kDefaultScale = 1;

  static LossValue value(double s, double /*scale*/) { return {s, 1, 0}; }
};

}  // namespace shearfront::fit
