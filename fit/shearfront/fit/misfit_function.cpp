// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/misfit_function.hpp"

#include <Eigen/LU>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/noise_reml.hpp"

namespace shearfront::fit {

using Eigen::VectorXd;

namespace {

/// The rows of a misfit; with correlated noise that is known, whitened.
ResidualRows whitened_rows(const FitSpec& spec, const Parameters& parameters) {
  ResidualRows rows = rows_of(quantity_of(spec), spec, parameters);
  if (spec.noise.model == NoiseModel::independent) return rows;
  if (const std::string refusal = noise_refusal(spec, rows); !refusal.empty())
    throw InputError("noise.model", "", refusal);
  const auto places = noise_places(spec, rows);
  const auto numbers = given_noise(spec.noise, *places);
  if (!numbers)
    throw InputError("noise", "estimated", "must have numbers for the misfit alone: a fit finds them");
  rows.noise = std::make_shared<NoiseCovariance>(places, numbers->shape);
  return rows;
}

}  // namespace

MisfitFunction::MisfitFunction(const FitSpec& spec)
    : parameters_(spec.scene, spec.unknown),
      coordinates_(parameters_),
      control_(std::numeric_limits<std::size_t>::max()),
      objective_(parameters_, coordinates_, spec.forward, whitened_rows(spec, parameters_),
                 find_loss(loss_of(spec), spec.misfit.loss_scale.value_or(0)), control_) {}

void MisfitFunction::expect_size(const VectorXd& p) const {
  if (p.size() != coordinates_.size())
    throw InputError("p", "(" + std::to_string(p.size()) + " entries)",
                     "must have one number per unknown (" + std::to_string(coordinates_.size()) + ")");
}

MisfitFunction::Value MisfitFunction::at(const VectorXd& p, bool with_jacobian) const {
  expect_size(p);
  const std::scoped_lock one_at_a_time(mutex_);
  const ResidualRows& rows = objective_.rows();
  const bool is_exact = objective_.has_derivatives();
  const Prediction prediction = objective_.forward().predict(p, with_jacobian && is_exact);
  Value value;
  value.failure = prediction.failure;
  if (!value.is_valid()) return value;
  value.residuals = rows.residuals(prediction.values);
  if (!with_jacobian) return value;
  if (is_exact) {
    value.jacobian = rows.jacobian(prediction.derivatives);
    return value;
  }
  // Differences are taken in the coordinates of a search: dr/dp = dr/du (dp/du)^-1.
  const VectorXd u = coordinates_.unbounded(p);
  const Objective::Evaluation differences = objective_.inspect(u, true);
  value.failure = differences.failure;
  if (!differences.is_valid) {
    if (value.is_valid()) value.failure = "outside the bounds";
    return value;
  }
  const auto turned = coordinates_.derivative(u).transpose().fullPivLu();
  value.jacobian = turned.solve(differences.jacobian.transpose()).transpose();
  return value;
}

MisfitFunction::Value MisfitFunction::with_gradient(const VectorXd& p) const {
  if (!objective_.forward().has_gradient()) {
    Value value = at(p, true);
    if (value.is_valid()) value.gradient = value.jacobian.transpose() * value.residuals;
    return value;
  }
  expect_size(p);
  const std::scoped_lock one_at_a_time(mutex_);
  const ResidualRows& rows = objective_.rows();
  Value value;
  const Prediction prediction = objective_.forward().predict_gradient(p, [&](const VectorXd& X) {
    value.residuals = rows.residuals(X);
    return rows.slopes(value.residuals);
  });
  value.failure = prediction.failure;
  value.gradient = prediction.gradient;
  return value;
}

double MisfitFunction::misfit(const VectorXd& residuals) const {
  double sum = 0;
  for (const double r : residuals) sum += objective_.loss()(r * r).rho;
  return sum / 2;
}

}  // namespace shearfront::fit
