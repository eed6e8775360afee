// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/search/nlopt_space.hpp"

#include <Eigen/Eigenvalues>
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
      lower_[j] = coordinates.scaled(j, coordinates.lowest_values()[j]);
      upper_[j] = coordinates.scaled(j, coordinates.highest_values()[j]);
    }
  } else if (algorithm.is_global) {
    kind_ = Kind::logarithmic_steps;
    unit_ = kUnit * coordinates.values(start_u)[coordinates.shaped().front()] / coordinates.step_unit();
    for (const Index k : steps_) upper_[k] = std::log1p(upper_[k] / unit_);
  }
}

VectorXd NloptSpace::u(const VectorXd& x) const {
  VectorXd v = x;
  // A constraint holds in the end only: on the way there may be no solution outside the box.
  if (is_preconditioned()) v = (centre_ + map_ * x).cwiseMax(lower_).cwiseMin(upper_);
  VectorXd u = v;
  if (kind_ == Kind::logarithmic_steps)
    for (const Index k : steps_) u[k] = unit_ * std::expm1(v[k]);
  if (kind_ != Kind::values) return u;
  for (Index j = 0; j < v.size(); ++j) u[j] = coordinates_->unscaled(j, v[j]);
  return coordinates_->unbounded(u);
}

VectorXd NloptSpace::v(const VectorXd& u) const {
  VectorXd v = u;
  if (kind_ == Kind::logarithmic_steps)
    for (const Index k : steps_) v[k] = std::log1p(u[k] / unit_);
  if (kind_ == Kind::values) {
    v = coordinates_->values(u);
    for (Index j = 0; j < v.size(); ++j) v[j] = coordinates_->scaled(j, v[j]);
  }
  return v.cwiseMax(lower_).cwiseMin(upper_);
}

MatrixXd NloptSpace::turned(const VectorXd& u, const MatrixXd& d) const {
  VectorXd slopes = VectorXd::Ones(u.size());
  if (kind_ == Kind::logarithmic_steps)
    for (const Index k : steps_) slopes[k] = u[k] + unit_;
  if (kind_ != Kind::values) return d * slopes.asDiagonal();
  const VectorXd p = coordinates_->values(u);
  for (Index j = 0; j < u.size(); ++j) slopes[j] = coordinates_->slope(j, p[j]);
  return d * coordinates_->derivative(u).partialPivLu().solve(MatrixXd(slopes.asDiagonal()));
}

MatrixXd NloptSpace::derivative(const VectorXd& u) const {
  return turned(u, MatrixXd::Identity(u.size(), u.size()));
}

void NloptSpace::precondition(const VectorXd& u, const MatrixXd& jacobian) {
  constexpr double kMostUneven = 100;
  const MatrixXd of_v = turned(u, jacobian);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(of_v.transpose() * of_v);
  VectorXd steepness = parts.eigenvalues().cwiseMax(0).cwiseSqrt();
  steepness = steepness.cwiseMax(std::max(steepness.maxCoeff() / kMostUneven, 1e-300));
  centre_ = v(u);
  map_ = parts.eigenvectors() * (steepness.cwiseInverse() * steepness.minCoeff()).asDiagonal();
}

VectorXd NloptSpace::excess(const VectorXd& x) const {
  const auto n = static_cast<Index>(constrained_.size());
  VectorXd all(n);
  const VectorXd step = u(x);
  if (is_preconditioned()) {
    const VectorXd v = centre_ + map_ * x;
    all.resize(n + 2 * v.size());
    for (Index j = 0; j < v.size(); ++j) {
      all[n + 2 * j] = std::isfinite(lower_[j]) ? lower_[j] - v[j] : -1;
      all[n + 2 * j + 1] = std::isfinite(upper_[j]) ? v[j] - upper_[j] : -1;
    }
  }
  for (Index i = 0; i < n; ++i) all[i] = -step[constrained_[static_cast<std::size_t>(i)]];
  return all;
}

MatrixXd NloptSpace::excess_derivative(const VectorXd& v) const {
  const MatrixXd of_u = derivative(u(v));
  MatrixXd rows(static_cast<Index>(constrained_.size()), v.size());
  for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = -of_u.row(constrained_[static_cast<std::size_t>(i)]);
  return rows;
}

VectorXd NloptSpace::steps(const VectorXd& u) const {
  constexpr double kShare = 0.1;
  const VectorXd at = v(u), p = coordinates_->values(u);
  VectorXd step(at.size());
  for (Index j = 0; j < at.size(); ++j) {
    const double width = upper_[j] - lower_[j];
    step[j] = kShare;  // a logarithm: a tenth of the value
    if (kind_ != Kind::values && std::find(steps_.begin(), steps_.end(), j) != steps_.end())
      step[j] = kind_ == Kind::coordinates
                    ? kShare * std::max(u[j], kShare * p[j] / coordinates_->step_unit())
                    : kShare;
    else if (!coordinates_->is_positive(j))
      step[j] = kShare * (std::isfinite(width) ? width : std::max(1.0, std::abs(at[j])));
    if (std::isfinite(width)) step[j] = std::min(step[j], width / 4);
    if (!(step[j] > 0)) step[j] = kShare;  // an empty range: NLopt leaves the variable out
  }
  return step;
}

}  // namespace shearfront::fit
