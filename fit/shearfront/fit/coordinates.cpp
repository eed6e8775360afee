// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace shearfront::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Coordinates::Coordinates(const Parameters& parameters) : shape_(parameters.shape()) {
  const auto n = static_cast<Index>(parameters.size());
  for (VectorXd* of_each : {&lower_, &upper_, &lowest_values_, &highest_values_, &units_, &origins_})
    of_each->resize(n);
  for (const Parameter& p : parameters) {
    const auto i = static_cast<Index>(is_positive_.size());
    const bool is_shaped = shape_ != Shape::none && p.entry.field == "shear_rate.values";
    names_.push_back(p.name());
    is_positive_.push_back(p.entry.range == Range::positive);
    units_[i] = p.unit;
    origins_[i] = p.origin;
    lowest_values_[i] = p.lower;
    highest_values_[i] = p.upper;
    lower_[i] = scaled(i, p.lower);
    upper_[i] = scaled(i, p.upper);
    if (is_shaped) shaped_.push_back(i);
  }
  for (std::size_t k = 0; k + 1 < shaped_.size(); ++k) {
    lower_[shaped_[k]] = 0;
    upper_[shaped_[k]] = (highest_values_[shaped_[k]] - lowest_values_[shaped_.back()]) / step_unit();
  }
}

double Coordinates::scaled(Index j, double p) const {
  return is_positive(j) ? 1 + std::log(p / units_[j]) : (p - origins_[j]) / units_[j];
}

double Coordinates::unscaled(Index j, double u) const {
  return is_positive(j) ? units_[j] * std::exp(u - 1) : origins_[j] + units_[j] * u;
}

VectorXd Coordinates::values(const VectorXd& u) const {
  VectorXd p(u.size());
  for (Index i = 0; i < u.size(); ++i)
    p[i] = u[i] == lower_[i] ? lowest_values_[i] : u[i] == upper_[i] ? highest_values_[i] : unscaled(i, u[i]);
  double step = 0;
  for (std::size_t k = shaped_.size(); k-- > 1;) {
    const Index above = shaped_[k], below = shaped_[k - 1];
    const double change = step_unit() * u[below];
    step = shape_ == Shape::convex ? step + change : change;
    p[below] = p[above] + step;
  }
  return p;
}

VectorXd Coordinates::coordinates(const VectorXd& p) const {
  return unbounded(p).cwiseMax(lower_).cwiseMin(upper_);
}

VectorXd Coordinates::unbounded(const VectorXd& p) const {
  VectorXd u(p.size());
  for (Index i = 0; i < p.size(); ++i) u[i] = scaled(i, p[i]);
  double last_step = 0;
  for (std::size_t k = shaped_.size(); k-- > 1;) {
    const double step = p[shaped_[k - 1]] - p[shaped_[k]];
    u[shaped_[k - 1]] = (shape_ == Shape::convex ? step - last_step : step) / step_unit();
    last_step = step;
  }
  return u;
}

std::vector<bool> Coordinates::at_bound(const VectorXd& u) const {
  const auto is_at = [](double x, double bound) {
    return std::isfinite(bound) && std::abs(x - bound) <= 1e-8 * std::max(1.0, std::abs(bound));
  };
  std::vector<bool> at;
  for (Index j = 0; j < u.size(); ++j) at.push_back(is_at(u[j], lower_[j]) || is_at(u[j], upper_[j]));
  return at;
}

std::vector<Index> Coordinates::bound_together(Index j) const {
  const auto place = std::find(shaped_.begin(), shaped_.end(), j);
  if (place == shaped_.end() || place + 1 == shaped_.end()) return {j};
  return {place, place + std::min<std::ptrdiff_t>(shaped_.end() - place, shape_ == Shape::convex ? 3 : 2)};
}

MatrixXd Coordinates::turned(const VectorXd& u, MatrixXd d) const {
  // v_k = v_{k+1} + step_k, from the bottom up: what v_k changes, v_{k+1} and the steps change.
  VectorXd of_step = VectorXd::Zero(d.rows());
  for (std::size_t k = 0; k + 1 < shaped_.size(); ++k) {
    const Index below = shaped_[k], above = shaped_[k + 1];
    if (shape_ != Shape::convex) of_step.setZero();
    of_step += d.col(below);
    d.col(above) += d.col(below);
    d.col(below) = step_unit() * of_step;
  }
  const auto steps = shaped_.empty() ? shaped_.end() : shaped_.end() - 1;
  for (Index i = 0; i < u.size(); ++i)
    if (std::find(shaped_.begin(), steps, i) == steps) d.col(i) *= slope(i, unscaled(i, u[i]));
  return d;
}

MatrixXd Coordinates::derivative(const VectorXd& u) const {
  return turned(u, MatrixXd::Identity(u.size(), u.size()));
}

}  // namespace shearfront::fit
