// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/flat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shearfront/fit/covariance.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Of the misfit: what a solution on a grid changes for no reason is more than rounding.
constexpr double kSame = 1e-9;

double slack(const Objective& objective, double misfit) {
  return kSame * misfit + objective.rounding_misfit();
}

double room(const Objective& objective, const VectorXd& u, Index j, double sign) {
  const Coordinates& coordinates = objective.coordinates();
  return sign < 0 ? u[j] - coordinates.lower()[j] : coordinates.upper()[j] - u[j];
}

VectorXd moved(VectorXd u, Index j, double distance) {
  u[j] += distance;
  return u;
}

double reach(const Objective& objective, const VectorXd& u, Index j, double sign, double misfit) {
  const double most = std::min(room(objective, u, j, sign), kWidestReach);
  const auto is_same = [&](double distance) {
    const Objective::Evaluation there = objective.inspect(moved(u, j, sign * distance), false);
    return there.is_valid && std::abs(there.misfit - misfit) <= slack(objective, misfit);
  };
  double inside = 0, outside = std::min(kFirstReach, most);
  while (is_same(outside)) {
    inside = outside;
    if (outside >= most) return infinity<double>();
    outside = std::min(2 * outside, most);
  }
  while (inside > 0 && outside - inside > kFlatEnd) {
    const double middle = inside + (outside - inside) / 2;
    (is_same(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

std::optional<VectorXd> beyond_flat(Objective& objective, const VectorXd& u) {
  const Objective::Evaluation at = objective.evaluate(u, true);
  if (!at.is_valid || at.misfit <= objective.rounding_misfit()) return {};
  const VectorXd norm = at.jacobian.colwise().norm();
  const double least = std::max(kUnseen * norm.maxCoeff(), kSeen * at.rounding);
  std::optional<VectorXd> best;
  double smallest = at.misfit - slack(objective, at.misfit);
  for (Index j = 0; j < u.size(); ++j) {
    if (norm[j] > least) continue;
    for (const double sign : {-1.0, 1.0}) {
      const double most = std::min(room(objective, u, j, sign), kWidestReach);
      for (double distance = kFirstReach; distance < most && !objective.control().must_stop();
           distance *= 4) {
        const VectorXd there = moved(u, j, sign * distance);
        const double misfit = objective.evaluate_misfit(there, false).misfit;
        if (misfit < smallest) smallest = misfit, best = there;
      }
    }
  }
  return best;
}

Flat flat_around(const Objective& objective, const VectorXd& u, Index j) {
  const double misfit = objective.inspect(u, false).misfit;
  return {reach(objective, u, j, -1, misfit), reach(objective, u, j, 1, misfit)};
}

}  // namespace shearfront::fit
