// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/number_bands.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fit/quantile.hpp"

namespace shearfront::fit {
namespace {

/// Of the size of a number: what its values on an axis may differ by for no reason.
constexpr double kSameOnAxis = 1e-12;

std::optional<Interval> quantiles_of(std::vector<double> numbers) {
  if (numbers.size() < 2) return std::nullopt;
  std::sort(numbers.begin(), numbers.end());
  return Interval{quantile(numbers, 0.025), quantile(numbers, 0.975)};
}

}  // namespace

double slope_on(const DrawnScenes::Axis& axis, const double* derivatives) {
  double slope = 0;
  for (std::size_t k = 0; k < axis.slopes.size(); ++k) slope += derivatives[k] * axis.slopes[k];
  return slope;
}

std::optional<double> linear_deviation(double value, const std::vector<OnAxis>& on,
                                       const DrawnScenes& draws) {
  double squares = 0;
  for (const OnAxis& axis : on) squares += axis.slope * axis.slope;
  const double sd = std::sqrt(squares);
  if (!std::isfinite(sd) || !std::isfinite(value)) return std::nullopt;
  const double most = PredictedNumber::kMostBent * draws.quantile * sd * static_cast<double>(on.size()) +
                      kSameOnAxis * std::max(1.0, std::abs(value));
  for (const OnAxis& axis : on) {
    const double step = draws.reach() * axis.slope;
    if (!(std::abs(axis.far_low - (value - step)) <= most &&
          std::abs(axis.far_high - (value + step)) <= most))
      return std::nullopt;
  }
  return sd;
}

bool has_axes(const DrawnScenes& draws) {
  return !draws.axes.empty() &&
         std::all_of(draws.axes.begin(), draws.axes.end(),
                     [](const DrawnScenes::Axis& axis) { return axis.far_low && axis.far_high; });
}

double difference_on_axis(double near_low, double near_high) {
  return (near_high - near_low) / (2 * DrawnScenes::kNear);
}

bool has_derivatives(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method) {
  if (!has_axes(draws)) return false;
  const std::vector<Entry> all = entries(estimated.spec());
  return std::all_of(draws.entries.begin(), draws.entries.end(),
                     [&](std::size_t i) { return method.has_derivative(estimated, all[i]); });
}

void set_linear_band(PredictedNumber& number, const std::vector<OnAxis>& on, const DrawnScenes& draws) {
  number.std_error = linear_deviation(number.value, on, draws);
  if (!number.std_error) return;
  const double half = draws.quantile * *number.std_error;
  number.band = {number.value - half, number.value + half};
}

std::size_t set_drawn_bands(const std::vector<Numbers>& drawn, std::vector<PredictedNumber>& predicted) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    if (predicted[i].std_error) continue;
    Numbers numbers;
    for (const Numbers& row : drawn)
      if (i < row.size()) numbers.push_back(row[i]);
    predicted[i].band = quantiles_of(std::move(numbers));
    ++n;
  }
  return n;
}

bool all_have_bands(const std::vector<PredictedNumber>& predicted) {
  return std::all_of(predicted.begin(), predicted.end(),
                     [](const PredictedNumber& number) { return number.std_error.has_value(); });
}

}  // namespace shearfront::fit
