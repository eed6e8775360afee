// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <functional>

namespace shearfront::fit {

/// Residuals at a point; empty if there is no solution there.
using ResidualFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Noise of a computed function: the standard deviation of what rounding, event order or a grid add to it,
/// from a table of differences of n + 1 values at equal tiny steps (ECnoise). 0 if none is seen. Source: More
/// & Wild, Estimating computational noise, SIAM J. Sci. Comput. 33 (2011).
[[nodiscard]] double computational_noise(const Eigen::VectorXd& values);

/// Steps of central differences suited to the noise of the residuals, one per coordinate:
///
///     h = (3 noise / |r'''|)^(1/3) kept within [smallest, 0.1] max(1, |u|),     |r'''| taken as |r| / L^3, L = 1,
///
/// for coordinates of order one (Coordinates). |r| is the root mean square of the residuals, `unit` at least: the
/// size of what they are differences of. Cost: 8 runs.
[[nodiscard]] Eigen::VectorXd numeric_steps(const ResidualFunction& residuals, const Eigen::VectorXd& u,
                                            const Eigen::VectorXd& at_u, double smallest, double unit);

/// Column j of the Jacobian by a central difference; one-sided where one side has no solution, NaN where
/// neither has.
[[nodiscard]] Eigen::VectorXd difference(const ResidualFunction& residuals, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& at_u, Eigen::Index j, double step);

/// A column with the step that gave it and its error, relative to its norm.
struct Difference {
  Eigen::VectorXd column;
  double step = 0, error = 0;
};

/// The central difference of the smallest error among those with step, 2 step, 4 step, ... up to kLongestStep max(1,
/// |u_j|). Levels and cells make noise of every size, which no tiny steps show; it halves with the double step, on
/// which truncation grows fourfold: what changes from one step to the next is of the size of both. It stops at the
/// first change below kGoodColumn. Cost: 4 to about 16 runs.
[[nodiscard]] Difference best_difference(const ResidualFunction& residuals, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& at_u, Eigen::Index j, double step);

inline constexpr double kLongestStep = 0.1, kGoodColumn = 1e-3;

}  // namespace shearfront::fit
