// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/report.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "shearfront/fit/interval_check.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/noise.hpp"
#include "shearfront/fit/residual_structure.hpp"
#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUpper = 0.975;

/// Observations predicted in their own quantity, unknown if the forward model has no solution, and what its solver has to
/// remark.
struct PredictedObservations {
  std::vector<double> values;
  std::string remark;
};
PredictedObservations predictions(const FitSpec& spec, const Parameters& parameters, const VectorXd& values,
                                  RunControl& control) {
  const ResidualRows rows = rows_of(name_of(spec.observations.quantity), spec, parameters);
  const Forward forward(parameters, spec.forward, rows.field, rows.points);
  const Prediction at =
      forward.predict(values, false, [&](double, std::uint64_t) { return control.may_run(); });
  PredictedObservations predicted{std::vector<double>(spec.observations.rows.size(), kUnknown), at.remark};
  if (!at.is_valid()) return predicted;
  const VectorXd r = rows.residuals(at.values);
  // Rows may stand in another order than the data; in its own quantity each has one observation.
  for (std::size_t i = 0; i < rows.rows.size(); ++i)
    predicted.values[rows.data(i).front().index] =
        rows.rows[i].target + r[static_cast<Index>(i)] / rows.rows[i].weight;
  return predicted;
}

/// Gaussian log likelihood up to a constant that depends on the data alone.
void set_information_criteria(const FitSpec& spec, const Minimum& minimum, Estimate& estimate) {
  const NoiseCovariance* noise = minimum.objective.rows().noise.get();
  double chi2 = 0;
  for (std::size_t i = 0; i < estimate.predicted.size(); ++i) {
    const Observation& o = spec.observations.rows[i];
    const double r = (estimate.predicted[i] - o.value) / (o.sigma > 0 ? o.sigma : 1);
    chi2 += r * r;
  }
  if (noise) chi2 = minimum.at.residuals.squaredNorm();
  const auto n = static_cast<double>(estimate.predicted.size());
  auto p = static_cast<double>(estimate.parameters.size() + (estimate.noise ? estimate.noise->estimated : 0));
  if (!estimate.sigma_is_given) {
    if (!(chi2 > 0) || !(estimate.freedom > 0)) return;
    chi2 = n * std::log(chi2 / n);
    p += 1;  // the noise is estimated as well
  }
  if (noise) chi2 += noise->log_determinant();
  if (!std::isfinite(chi2)) return;
  estimate.aic = chi2 + 2 * p;
  estimate.bic = chi2 + p * std::log(n);
}

void set_error_bars(const Minimum& minimum, Estimate& estimate) {
  const MatrixXd cov =
      parameter_covariance(minimum.errors, minimum.objective.coordinates().derivative(minimum.u));
  const auto n = minimum.u.size();
  const double quantile = minimum.quantile;
  estimate.correlation = MatrixXd::Constant(n, n, kUnknown);
  const auto has_error = [&](Index a) {
    return !estimate.parameters[static_cast<std::size_t>(a)].is_held() && cov(a, a) > 0 &&
           std::isfinite(cov(a, a));
  };
  for (Index a = 0; a < n; ++a) {
    if (!has_error(a)) continue;
    ParameterEstimate& parameter = estimate.parameters[static_cast<std::size_t>(a)];
    const double error = std::sqrt(cov(a, a));
    parameter.std_error = error;
    if (minimum.parameters[static_cast<std::size_t>(a)].entry.range == Range::positive) {
      const double factor = std::exp(quantile * error / parameter.estimate);
      parameter.ci95 = {parameter.estimate / factor, parameter.estimate * factor};
    } else {
      parameter.ci95 = {parameter.estimate - quantile * error, parameter.estimate + quantile * error};
    }
    for (Index b = 0; b < n; ++b)
      if (has_error(b))
        estimate.correlation(a, b) = a == b ? 1 : cov(a, b) / std::sqrt(cov(a, a) * cov(b, b));
  }
}

void set_order(const Minimum& minimum, Estimate& estimate) {
  for (std::size_t i = 0; i < minimum.at.order_holds.size(); ++i) {
    const ParameterEstimate& parameter = estimate.parameters[i];
    if (!parameter.std_error) continue;
    const StepRange& range = minimum.at.order_holds[i];
    const double n = std::min(range.down, range.up) / *parameter.std_error;
    if (!std::isfinite(n) || (estimate.order && estimate.order->std_errors <= n)) continue;
    estimate.order = {parameter.name, n, minimum.objective.n_order_changes()};
  }
}

/// The predictions, or what they would be if the noise were what is left of it when it is whitened.
std::vector<double> with_white_residuals(const FitSpec& spec, const ResidualRows& rows,
                                         const VectorXd& residuals, std::vector<double> predicted) {
  for (std::size_t i = 0; rows.noise && i < rows.rows.size(); ++i) {
    const std::size_t k = rows.data(i).front().index;
    const Observation& o = spec.observations.rows[k];
    predicted[k] = o.value + (o.sigma > 0 ? o.sigma : 1) * residuals[static_cast<Index>(i)];
  }
  return predicted;
}

/// Distance from a bound, in standard errors, below which an estimate is at it: searches without derivatives
/// do not end there exactly.
constexpr double kAtBound = 1e-3;

/// Holds determined coordinates that are that close to a bound; whether there are any.
bool hold_near_bounds(const Coordinates& coordinates, const VectorXd& u, const Covariance& errors,
                      std::vector<bool>& held) {
  bool any = false;
  for (Index j = 0; j < u.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const double near = kAtBound * std::min(1.0, std::sqrt(errors.matrix(j, j)));
    if (held[k] || !errors.determined[k]) continue;
    held[k] = u[j] - coordinates.lower()[j] < near || coordinates.upper()[j] - u[j] < near;
    any = any || held[k];
  }
  return any;
}

/// Sets the noise, the covariance, and the quantile of the 95 % intervals, with these coordinates held.
void set_errors(Minimum& minimum, const std::vector<bool>& held, Estimate& estimate) {
  const Observations& observations = minimum.spec.observations;
  const Objective& objective = minimum.objective;
  minimum.quantile = boost::math::quantile(boost::math::normal(), kUpper);
  estimate.sigma_is_given = observations.has_sigma();
  estimate.sigma = 1;
  if (!estimate.sigma_is_given) {
    const Noise noise = noise_of(objective, observations, minimum.at, estimate.predicted,
                                 static_cast<std::size_t>(std::count(held.begin(), held.end(), false)));
    estimate.sigma = noise.sigma;
    estimate.freedom = noise.freedom;
    if (noise.freedom > 0)
      minimum.quantile = boost::math::quantile(boost::math::students_t(noise.freedom), kUpper);
  }
  minimum.errors =
      covariance(objective.rows(), observations, minimum.at, objective.loss(), estimate.sigma, held);
}

void mark_bounds(const Minimum& minimum, Estimate& estimate) {
  const Parameters& parameters = minimum.parameters;
  const std::vector<bool>& held = minimum.errors.held;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = estimate.parameters[i].estimate;
    estimate.parameters[i].at_bound = value <= parameters[i].lower || value >= parameters[i].upper;
  }
  for (std::size_t j = 0; j < held.size(); ++j)
    if (held[j]) {
      const auto together = minimum.objective.coordinates().bound_together(static_cast<Index>(j));
      for (const Index i : together) {
        ParameterEstimate& p = estimate.parameters[static_cast<std::size_t>(i)];
        (together.size() > 1 ? p.held_by_shape : p.at_bound) = true;
      }
    }
}

std::string text_of(const Parameters& parameters, const VectorXd& values) {
  std::string text;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    text +=
        (i == 0 ? "" : ", ") + parameters[i].name() + " = " + number_text(values[static_cast<Index>(i)], 6);
  return text;
}

}  // namespace

Estimate report(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                const SearchResult& found, std::optional<NoiseEstimate> noise) {
  Estimate estimate;
  estimate.noise = std::move(noise);
  estimate.name = spec.name;
  estimate.method = spec.forward.method.name();
  estimate.algorithm = spec.search.algorithm;
  estimate.status = found.status;
  estimate.message = found.message;
  estimate.evaluations = objective.control().evaluations();
  estimate.steps = objective.control().steps();
  estimate.misfit = found.misfit;
  Minimum minimum{spec, parameters, objective, found.u, objective.inspect(found.u, true), {}, 0};
  const RunControl& control = objective.control();
  const Objective::Evaluation& best = minimum.at;
  if (control.is_interrupted()) {
    estimate.status = Status::interrupted;
    estimate.message = kInterrupted;
    if (const Objective::Evaluation* known = objective.known(found.u); known && !best.is_valid)
      minimum.at = *known;
  }
  for (const Parameter& p : parameters) {
    ParameterEstimate& parameter = estimate.parameters.emplace_back();
    parameter.name = p.name();
    parameter.start = p.start;
    parameter.estimate = kUnknown;
  }
  if (!best.is_valid) {
    if (estimate.status == Status::ok) {
      // Solved on the way there, and only just: not again from scratch.
      estimate.status = Status::not_converged;
      estimate.message = "the search ended where the model has no solution";
    }
    if (control.is_interrupted())
      estimate.message = "interrupted before the misfit was known at the point reached, " +
                         text_of(parameters, objective.coordinates().values(found.u));
    else if (!best.failure.empty())
      estimate.message += ": " + best.failure;
    return estimate;
  }

  const VectorXd values = objective.coordinates().values(found.u);
  estimate.scene = Scene<double>(parameters.scene_with(values));
  auto [predicted, remark] = predictions(spec, parameters, values, objective.control());
  estimate.predicted = std::move(predicted);
  estimate.observations = static_cast<std::size_t>(best.residuals.size());
  double squares = 0;
  const VectorXd residuals = objective.rows().coloured(best.residuals);
  for (Index i = 0; i < residuals.size(); ++i)
    squares += std::pow(residuals[i] / objective.rows().rows[static_cast<std::size_t>(i)].weight, 2);
  estimate.residual_norm = std::sqrt(squares);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    estimate.parameters[i].estimate = values[static_cast<Index>(i)];
  if (best.jacobian.size() == 0) {  // interrupted before it was there
    estimate.correlation = MatrixXd::Constant(found.u.size(), found.u.size(), kUnknown);
    estimate.sigma_is_given = spec.observations.has_sigma();
    estimate.sigma = estimate.sigma_is_given ? 1 : kUnknown;
    return estimate;
  }
  std::vector<bool> held = objective.coordinates().at_bound(found.u);
  set_errors(minimum, held, estimate);
  if (hold_near_bounds(objective.coordinates(), found.u, minimum.errors, held))
    set_errors(minimum, held, estimate);
  mark_bounds(minimum, estimate);
  set_error_bars(minimum, estimate);
  set_order(minimum, estimate);
  set_information_criteria(spec, minimum, estimate);
  if (!control.is_interrupted()) {
    auto checks = check_intervals(minimum, estimate);
    for (std::size_t i = 0; i < checks.size() && !control.is_interrupted(); ++i)
      estimate.parameters[i].check = std::move(checks[i]);
  }
  estimate.structure = residual_structure(
      spec.observations, with_white_residuals(spec, objective.rows(), best.residuals, estimate.predicted));
  estimate.warnings = warnings(minimum, estimate);
  if (!remark.empty()) estimate.warnings.push_back(std::string(spec.forward.method.name()) + ": " + remark);
  return estimate;
}

bool has_profiles(const FitSpec& spec, const Objective& objective) {
  if (spec.unknown.shape != Shape::none) return false;
  return spec.uncertainty.profile ||
         (objective.has_derivatives() && objective.parameters().size() <= kMostProfiled);
}

bool is_barely_seen(const Parameter& parameter, const ParameterEstimate& estimate) {
  constexpr double kHugeError = 0.5;
  return parameter.entry.range == Range::positive && estimate.std_error &&
         *estimate.std_error > kHugeError * estimate.estimate;
}

}  // namespace shearfront::fit
