// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/search/nlopt_space.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace shearfront::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

NloptSpace::NloptSpace(const Coordinates& coordinates, const VectorXd& start_u,
                       const NloptAlgorithm& algorithm)
    : coordinates_(&coordinates), lower_(coordinates.lower()), upper_(coordinates.upper()) {
  constexpr double kUnit = 1e-3;
  if (!coordinates.shaped().empty())
    steps_.assign(coordinates.shaped().begin(), coordinates.shaped().end() - 1);
  if (steps_.empty()) return;
  if (algorithm.takes_constraints) {
    kind_ = Kind::values;
    constrained_ = steps_;
    for (Index j = 0; j < lower_.size(); ++j) {
      const double lowest = coordinates.lowest_values()[j], highest = coordinates.highest_values()[j];
      lower_[j] = coordinates.is_positive(j) ? std::log(lowest) : lowest;
      upper_[j] = coordinates.is_positive(j) ? std::log(highest) : highest;
    }
  } else if (algorithm.is_global) {
    kind_ = Kind::logarithmic_steps;
    unit_ = kUnit * coordinates.values(start_u)[coordinates.shaped().front()];
    for (const Index k : steps_) upper_[k] = std::log1p(upper_[k] / unit_);
  }
}

VectorXd NloptSpace::u(const VectorXd& v) const {
  VectorXd u = v;
  if (kind_ == Kind::logarithmic_steps)
    for (const Index k : steps_) u[k] = unit_ * std::expm1(v[k]);
  if (kind_ != Kind::values) return u;
  for (Index j = 0; j < v.size(); ++j)
    if (coordinates_->is_positive(j)) u[j] = std::exp(v[j]);
  return coordinates_->unbounded(u);
}

VectorXd NloptSpace::v(const VectorXd& u) const {
  VectorXd v = u;
  if (kind_ == Kind::logarithmic_steps)
    for (const Index k : steps_) v[k] = std::log1p(u[k] / unit_);
  if (kind_ == Kind::values) {
    v = coordinates_->values(u);
    for (Index j = 0; j < v.size(); ++j)
      if (coordinates_->is_positive(j)) v[j] = std::log(v[j]);
  }
  return v.cwiseMax(lower_).cwiseMin(upper_);
}

MatrixXd NloptSpace::derivative(const VectorXd& u) const {
  VectorXd d = VectorXd::Ones(u.size());
  if (kind_ == Kind::logarithmic_steps)
    for (const Index k : steps_) d[k] = u[k] + unit_;
  if (kind_ != Kind::values) return d.asDiagonal();
  const VectorXd p = coordinates_->values(u);
  for (Index j = 0; j < u.size(); ++j)
    if (coordinates_->is_positive(j)) d[j] = p[j];
  return coordinates_->derivative(u).partialPivLu().solve(MatrixXd(d.asDiagonal()));
}

VectorXd NloptSpace::steps(const VectorXd& u) const {
  constexpr double kShare = 0.1;
  const VectorXd at = v(u), p = coordinates_->values(u);
  VectorXd step(at.size());
  for (Index j = 0; j < at.size(); ++j) {
    const double width = upper_[j] - lower_[j];
    step[j] = kShare;  // a logarithm: a tenth of the value
    if (kind_ != Kind::values && std::find(steps_.begin(), steps_.end(), j) != steps_.end())
      step[j] = kind_ == Kind::coordinates ? kShare * std::max(u[j], kShare * p[j]) : kShare;
    else if (!coordinates_->is_positive(j))
      step[j] = kShare * (std::isfinite(width) ? width : std::max(1.0, std::abs(at[j])));
    if (std::isfinite(width)) step[j] = std::min(step[j], width / 4);
    if (!(step[j] > 0)) step[j] = kShare;  // an empty range: NLopt leaves the variable out
  }
  return step;
}

}  // namespace shearfront::fit
