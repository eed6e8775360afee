// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// Noise estimated from what a fit leaves.
struct Noise {
  double sigma = 0;    ///< standard deviation of one observation; NaN without degrees of freedom
  double freedom = 0;  ///< of sigma: residuals minus unknowns; <= 0 if the data are too few
};

/// The noise of observations without sigma, from the residuals of a fit of n_free unknowns.
///
/// Least squares: sigma^2 = sum r^2 / freedom. Robust losses: Huber's proposal 2, in which
/// gross errors count as 1.345 sigma (Huber 1981, section 7.7). Rows made of several observations have
/// correlated residuals; there the observations' own differences (predicted - value) are taken, for points
/// robustly, for they are gross where a shock is a little off. Only rows that depend on an unknown count,
/// which leaves sigma unbiased: the others (beds at rest, all of one kind) may have been measured, or made,
/// without noise. Whitened residuals all count. Cost: O(rows n).
[[nodiscard]] Noise noise_of(const Objective& objective, const Observations& observations,
                             const Objective::Evaluation& at, const std::vector<double>& predicted,
                             std::size_t n_free);

/// Standard deviation of a Gaussian with the median absolute value of these; 0 for none.
[[nodiscard]] double median_deviation(std::vector<double> residuals);

/// Whether a row of a Jacobian depends on some coordinate.
[[nodiscard]] std::vector<bool> dependent_rows(const Eigen::MatrixXd& jacobian);

}  // namespace shearfront::fit
