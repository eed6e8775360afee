// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <vector>

#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// Covariance of the coordinates at a minimum, and what keeps some combinations from having one.
struct Covariance {
  /// n x n. Coordinates that are held have none (0); of the others only combinations that are orthogonal to
  /// null_directions mean anything: ask parameter_covariance().
  Eigen::MatrixXd matrix;
  /// Directions over the coordinates (columns, largest entry 1) in which the residuals do not change, chosen
  /// with as few entries as possible. A single entry: a coordinate the data do not see.
  Eigen::MatrixXd null_directions;
  std::vector<bool> held;        ///< at a bound: taken as known
  std::vector<bool> determined;  ///< per coordinate: neither held nor part of a null direction
  /// By which twice a difference in misfit is divided to be chi^2_1 when one coordinate is fixed and the
  /// others are refitted; NaN if not determined. noise^2 for least squares of independent rows.
  Eigen::VectorXd misfit_scale;
};

/// Linear error propagation for r = W (C X(u) - D y) with independent noise of standard deviation sigma_k
/// (times `noise`) in the observations:
///
///     cov(u) = v K B B^T K^T,   K = (J^T J)^-1 J^T,   B = W D S,   S = diag(sigma_k),
///
/// v = noise^2 for squared residuals (for D the identity this is noise^2 (J^T J)^-1; rows that share
/// observations are propagated as the correlated numbers they are; correlated noise is whitened in r and J already). A robust loss takes
/// v = mean psi^2 / (mean psi')^2 from the residuals, times n / (n - |J K B|^2), and needs no noise (Huber 1981,
/// section 7.6). Coordinates marked `held` are known: left out. The pseudo-inverse is by singular values of J with
/// columns scaled to norm one; those below kRankTolerance of the largest (or below the error of a numeric J) are
/// null, columns below kUnseen of the largest, or
/// below kSeen times what rounding makes of the residuals, unseen. Guarantees: scaling of a coordinate scales its entries;
/// held or undetermined coordinates do not change the others' entries. Cost: O(rows n^2).
[[nodiscard]] Covariance covariance(const ResidualRows& rows, const Observations& observations,
                                    const Objective::Evaluation& at, const Loss& loss, double noise,
                                    const std::vector<bool>& held);

/// Covariance D cov D^T of quantities whose derivatives in the coordinates are the rows of D; NaN for a
/// quantity that changes in a null direction, and for one that depends on held coordinates only.
[[nodiscard]] Eigen::MatrixXd parameter_covariance(const Covariance& covariance,
                                                   const Eigen::MatrixXd& derivative);

inline constexpr double kRankTolerance = 1e-7;
inline constexpr double kUnseen = 1e-12, kSeen = 1e3;
/// Entries of a unit null direction (columns scaled to norm one) below this are rounding.
inline constexpr double kNullEntry = 1e-4;

}  // namespace shearfront::fit
