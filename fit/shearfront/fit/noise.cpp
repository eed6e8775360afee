// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shearfront::fit {
namespace {

using Eigen::Index;

/// Entries of a Jacobian this much smaller than the largest of their column are rounding.
constexpr double kRoundingOfTerms = 1e-12;

/// Huber's proposal 2: sum min(r^2 / s^2, k^2) = freedom E[min(x^2, k^2)] for a Gaussian x. Gross errors
/// count as k each; unlike the median it does not vanish when a robust fit goes through more than half of the
/// data.
double huber_deviation(const std::vector<double>& residuals, double freedom) {
  constexpr double k = 1.345, kExpected = 0.7101645482690486;  // E[min(x^2, k^2)]
  constexpr int kIterations = 100;
  double squares = 0;
  for (const double r : residuals) squares += r * r;
  double s = std::sqrt(squares / freedom);
  for (int i = 0; i < kIterations && s > 0; ++i) {
    double sum = 0;
    for (const double r : residuals) sum += std::min(r * r, k * k * s * s);
    const double next = std::sqrt(sum / (freedom * kExpected));
    const bool stays = std::abs(next - s) <= 1e-12 * s;
    s = next;
    if (stays) break;
  }
  return s;
}

Noise noise_from(const std::vector<double>& residuals, std::size_t n_free, bool is_robust) {
  const auto n = static_cast<double>(residuals.size());
  Noise noise{std::numeric_limits<double>::quiet_NaN(), n - static_cast<double>(n_free)};
  if (!(noise.freedom > 0)) return noise;
  if (is_robust) {
    noise.sigma = huber_deviation(residuals, noise.freedom);
  } else {
    double squares = 0;
    for (const double r : residuals) squares += r * r;
    noise.sigma = std::sqrt(squares / noise.freedom);
  }
  return noise;
}

}  // namespace

std::vector<bool> dependent_rows(const Eigen::MatrixXd& jacobian) {
  std::vector<bool> depends(static_cast<std::size_t>(jacobian.rows()), false);
  for (const auto column : jacobian.colwise()) {
    const double least = kRoundingOfTerms * column.lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < column.size(); ++i)
      if (std::abs(column[i]) > least) depends[static_cast<std::size_t>(i)] = true;
  }
  return depends;
}

double median_deviation(std::vector<double> residuals) {
  constexpr double kOfGaussian = 1.482602218505602;
  if (residuals.empty()) return 0;
  for (double& r : residuals) r = std::abs(r);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return kOfGaussian * *middle;
}

Noise noise_of(const Objective& objective, const Observations& observations, const Objective::Evaluation& at,
               const std::vector<double>& predicted, std::size_t n_free) {
  const bool is_robust = objective.loss().is_robust;
  const std::vector<ResidualRows::Row>& rows = objective.rows().rows;
  const std::vector<bool> depends = dependent_rows(at.jacobian);
  std::vector<double> residuals;
  if (objective.rows().are_single()) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (depends[i] || objective.rows().noise) residuals.push_back(at.residuals[static_cast<Index>(i)]);
    return noise_from(residuals, n_free, is_robust);
  }
  std::vector<bool> is_used(predicted.size(), false);
  bool depends_later = false;  // some row whose sum row i is part of
  for (std::size_t i = rows.size(); i-- > 0;) {
    depends_later = depends_later || depends[i];
    for (const Term& term : objective.rows().data(i))
      if (depends_later && std::isfinite(predicted[term.index])) is_used[term.index] = true;
    if (!rows[i].continues) depends_later = false;
  }
  for (std::size_t k = 0; k < predicted.size(); ++k)
    if (is_used[k]) residuals.push_back(predicted[k] - observations.rows[k].value);
  return noise_from(residuals, n_free, is_robust || observations.quantity == Quantity::point);
}

}  // namespace shearfront::fit
