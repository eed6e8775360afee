// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace shearfront::fit {

/// The inverse of a matrix from its Cholesky factor. Cost: 2/3 n^3 flops, a third of those of solving for the unit matrix, for what is
/// 0 of the inverse of L is left out.
[[nodiscard]] Eigen::MatrixXd symmetric_inverse(const Eigen::LLT<Eigen::MatrixXd>& factor);

}  // namespace shearfront::fit
