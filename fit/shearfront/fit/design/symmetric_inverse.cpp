// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/symmetric_inverse.hpp"

#include <algorithm>

namespace shearfront::fit {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Columns at a time: as many as products of blocks need to be fast.
constexpr Index kColumnsAtATime = 64;

}  // namespace

MatrixXd symmetric_inverse(const Eigen::LLT<MatrixXd>& factor) {
  const MatrixXd lower = factor.matrixL();
  const Index n = lower.rows();
  MatrixXd of_lower = MatrixXd::Zero(n, n), inverse(n, n);
  for (Index j = 0; j < n; j += kColumnsAtATime) {
    const Index left = n - j, width = std::min(kColumnsAtATime, left);
    MatrixXd columns = MatrixXd::Identity(left, width);
    lower.bottomRightCorner(left, left).triangularView<Eigen::Lower>().solveInPlace(columns);
    of_lower.block(j, j, left, width) = columns;
  }
  // Rows j, ... of L^-T L^-1: L^-1 is 0 above them.
  for (Index j = 0; j < n; j += kColumnsAtATime) {
    const Index left = n - j, width = std::min(kColumnsAtATime, left);
    inverse.block(j, 0, width, j + width).noalias() =
        of_lower.block(j, j, left, width).transpose() * of_lower.block(j, 0, left, j + width);
  }
  return inverse.selfadjointView<Eigen::Lower>();
}

}  // namespace shearfront::fit
