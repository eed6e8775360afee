// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/resolution_shift.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

namespace shearfront::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::optional<FinerMethod> finer(const Method& method) {
  if (method.guarantees().exact) return {};
  for (const Option& option : method.options()) {
    FinerMethod fine{method, std::string(option.info.name)};
    if (const auto* step = std::get_if<double>(&option.value); step && fine.option == "resolution") {
      fine.before = *step, fine.now = *step / 2;
      fine.method.set(fine.option, fine.now);
      return fine;
    }
    const auto* cells = std::get_if<std::uint64_t>(&option.value);
    if (!cells || fine.option != "cells" || !option.info.range.contains(2 * static_cast<double>(*cells)))
      continue;
    fine.before = static_cast<double>(*cells), fine.now = 2 * fine.before;
    fine.method.set(fine.option, std::uint64_t{2 * *cells});
    return fine;
  }
  return {};
}

std::optional<ResolutionShift> resolution_shift(const Objective& objective, const Method& fine,
                                                const VectorXd& u, const Estimate& estimate) {
  if (!fine.refusal(objective.parameters().start_scene()).empty()) return {};
  const Objective::Evaluation at = objective.inspect(u, true);
  RunControl control = objective.control().for_part(1);
  const Objective finer(objective.parameters(), objective.coordinates(), {fine}, objective.rows(),
                        objective.loss(), control);
  const Objective::Evaluation there = finer.inspect(u, false);
  if (!at.is_valid || !there.is_valid) return {};
  const Index n = there.residuals.size();
  const VectorXd change = there.residuals - at.residuals.head(n);
  const double order = objective.rows().field == Observable::phi
                           ? fine.guarantees().order_phi
                           : fine.order_M(objective.parameters().start_scene());
  const double factor = order > 0 ? 1 / (1 - std::exp2(-order)) : 1;
  VectorXd weight(n);
  for (Index i = 0; i < n; ++i) {
    const double r = at.residuals[i];
    weight[i] = std::sqrt(std::max(0.0, objective.loss()(r * r).first));
  }
  // Only what has an error bar: the others are held, or not seen.
  std::vector<Index> free;
  for (Index j = 0; j < u.size(); ++j)
    if (estimate.parameters[static_cast<std::size_t>(j)].std_error) free.push_back(j);
  ResolutionShift result{VectorXd::Zero(u.size()), 0};
  if (free.empty()) return result;
  const MatrixXd jacobian = weight.asDiagonal() * at.jacobian(Eigen::seqN(0, n), free);
  const VectorXd moved = jacobian.colPivHouseholderQr().solve(factor * weight.cwiseProduct(change));
  VectorXd step = VectorXd::Zero(u.size());
  for (std::size_t k = 0; k < free.size(); ++k) step[free[k]] = moved[static_cast<Index>(k)];
  const VectorXd of_values = objective.coordinates().derivative(u) * step;
  for (const Index j : free)
    result.shift[j] = of_values[j] / *estimate.parameters[static_cast<std::size_t>(j)].std_error;
  const double norm = at.residuals.head(n).norm();
  result.share = norm > 0 ? change.norm() / norm : 0;
  return result;
}

}  // namespace shearfront::fit
