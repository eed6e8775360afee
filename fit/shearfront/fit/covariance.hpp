// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// Covariance of the coordinates at a minimum, and what keeps some from having one.
struct Covariance {
  Eigen::MatrixXd matrix;        ///< n x n; rows and columns of undetermined coordinates are NaN
  std::vector<bool> determined;  ///< per coordinate
  /// Directions (unit vectors over the coordinates, columns) in which the residuals do not change.
  Eigen::MatrixXd null_directions;
};

/// Linear error propagation for r = W (C X(u) - D y) with independent noise of standard deviation sigma_k
/// (times `noise`) in the observations:
///
///     cov(u) = (J^T A J)^-1 (J^T B W D S D^T W B J) (J^T A J)^-1,   S = diag(sigma_k^2),
///
/// with A = B = 1 for squared residuals (for D the identity this is (J^T J)^-1); a robust loss replaces A and
/// B by the means of psi' and psi^2 over the residuals (Huber 1981, section 7.6) and needs no noise.
/// Coordinates marked `held` are known: left out. The inverse is Ceres Covariance (DENSE_SVD, columns scaled
/// to norm one); directions with singular values below kRankTolerance of the largest are null.
[[nodiscard]] Covariance covariance(const ResidualRows& rows, const Observations& observations,
                                    const Objective::Evaluation& at, const Loss& loss, double noise,
                                    const std::vector<bool>& held);

inline constexpr double kRankTolerance = 1e-7;

}  // namespace shearfront::fit
