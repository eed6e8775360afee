// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// dF/du = sum_i rho'(r_i^2) r_i dr_i/du from an evaluation with its Jacobian.
[[nodiscard]] inline Eigen::VectorXd misfit_gradient(const Objective::Evaluation& at, const Loss& loss) {
  Eigen::VectorXd weighted = at.residuals;
  for (double& r : weighted) r *= loss(r * r).first;
  return at.jacobian.transpose() * weighted;
}

}  // namespace shearfront::fit
