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
/// for coordinates of order one (logarithms, heights). Cost: 8 runs.
[[nodiscard]] Eigen::VectorXd numeric_steps(const ResidualFunction& residuals, const Eigen::VectorXd& u,
                                            const Eigen::VectorXd& at_u, double smallest);

/// Column j of the Jacobian by a central difference; one-sided where one side has no solution, NaN where
/// neither has.
[[nodiscard]] Eigen::VectorXd difference(const ResidualFunction& residuals, const Eigen::VectorXd& u,
                                         const Eigen::VectorXd& at_u, Eigen::Index j, double step);

}  // namespace shearfront::fit
