// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// The same method with half the resolution, or twice the cells.
struct FinerMethod {
  Method method;
  std::string option;          ///< "resolution"
  double before = 0, now = 0;  ///< its value
};
/// Nothing for methods without such an option, or at the end of its range.
[[nodiscard]] std::optional<FinerMethod> finer(const Method& method);

/// How far the resolution of the forward model shifts a fit.
struct ResolutionShift {
  /// Per parameter: estimate less what an infinitely fine model would give, in standard errors; 0 for those without.
  Eigen::VectorXd shift;
  double share = 0;  ///< what a finer model changes in the residuals, relative to them
};

/// From one run of `fine` at the minimum u: with d = r_fine - r and q the order of the method the residuals are off by
/// e = d / (1 - 2^-q), and the minimum by (J^T W J)^-1 J^T W e, W the slopes of the loss. Nothing where the finer model
/// has no solution. Cost: one run of it, and the Jacobian.
[[nodiscard]] std::optional<ResolutionShift> resolution_shift(const Objective& objective, const Method& fine,
                                                              const Eigen::VectorXd& u,
                                                              const Estimate& estimate);

/// A shift beyond this many standard errors is worth a finer model, or a word.
inline constexpr double kMostShift = 1.0 / 3;

}  // namespace shearfront::fit
