// SPDX-License-Identifier: BSD-3-Clause
// Times of events, with bands.
#include <any>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/number_bands.hpp"
#include "shearfront/fit/prediction.hpp"

namespace shearfront::fit {
namespace {

/// t_0, t_1, t*, then first and last of every interface; kNever for those that do not come.
Numbers numbers_of(const Timeline<double>& timeline) {
  const auto time = [](const std::optional<double>& t) { return t.value_or(kNever); };
  Numbers numbers{time(timeline.t0), time(timeline.t1), time(timeline.t_star)};
  for (const auto& at : timeline.interfaces) {
    numbers.push_back(time(at.first));
    numbers.push_back(time(at.last));
  }
  return numbers;
}

/// In the same order.
std::vector<const std::vector<double>*> rows_of(const TimelineDerivatives& by) {
  std::vector<const std::vector<double>*> rows{&by.t0, &by.t1, &by.t_star};
  for (const auto& at : by.interfaces) {
    rows.push_back(&at.first);
    rows.push_back(&at.last);
  }
  return rows;
}

Numbers predicted_values(const std::vector<PredictedNumber>& predicted) {
  Numbers values;
  for (const PredictedNumber& number : predicted) values.push_back(number.value);
  return values;
}

/// Of n numbers; none if the scene has another number of interfaces, or no timeline.
Numbers times_at(const Scene<double>& scene, const Method& method, std::size_t n) {
  SolverRequest request;
  request.timeline = true;
  const SolverResult result = solve(scene, method, request);
  if (!result.summary.usable() || !result.timeline) return {};
  Numbers numbers = numbers_of(*result.timeline);
  return numbers.size() == n ? numbers : Numbers{};
}

/// Where the solver cannot say how a time changes, differences do.
void set_linear_bands(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                      std::vector<PredictedNumber>& predicted) {
  if (!has_axes(draws) || !method.guarantees().exact) return;
  LinearTimeline linear;
  if (method.has_linear_timeline() && has_derivatives(estimated, draws, method)) {
    std::any memory;
    linear = method.linearise_timeline(estimated, draws.entries, memory);
  }
  auto rows = rows_of(linear.derivatives);
  const std::vector<double> none;
  rows.resize(predicted.size(), &none);
  bool is_differenced = false;
  for (std::size_t i = 0; i < predicted.size(); ++i)
    is_differenced = is_differenced || (rows[i]->empty() && predicted[i].value != kNever);
  std::vector<std::vector<OnAxis>> on(predicted.size());
  std::vector<bool> is_fixed(predicted.size(), true);  // the same on all axes: 0, or never
  for (const DrawnScenes::Axis& axis : draws.axes) {
    const std::size_t n = predicted.size();
    const Numbers low = times_at(*axis.far_low, method, n), high = times_at(*axis.far_high, method, n);
    Numbers near_low = predicted_values(predicted), near_high = near_low;
    if (is_differenced) {
      near_low = times_at(*axis.near_low, method, n);
      near_high = times_at(*axis.near_high, method, n);
    }
    if (low.empty() || high.empty() || near_low.empty() || near_high.empty()) return;
    for (std::size_t i = 0; i < n; ++i) {
      const double value = predicted[i].value;
      for (const Numbers* at : std::initializer_list<const Numbers*>{&low, &high, &near_low, &near_high})
        is_fixed[i] = is_fixed[i] && (*at)[i] == value;
      const double slope = rows[i]->empty()
                               ? difference_on_axis(std::log(near_low[i]), std::log(near_high[i]))
                               : slope_on(axis, rows[i]->data()) / value;
      on[i].push_back({slope, std::log(low[i]), std::log(high[i])});
    }
  }
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    PredictedNumber& number = predicted[i];
    if (is_fixed[i]) {
      number.std_error = 0;
      number.band = {number.value, number.value};
    } else if (number.value > 0) {
      const auto relative = linear_deviation(std::log(number.value), on[i], draws);
      if (!relative) continue;
      const double factor = std::exp(draws.quantile * *relative);
      number.std_error = number.value * *relative;
      number.band = {number.value / factor, number.value * factor};
    }
  }
}

}  // namespace

PredictedEvents predict_events(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                               const Progress& progress) {
  SolverRequest request;
  request.timeline = true;
  const SolverResult at_estimate = solve(estimated, method, request);
  if (!at_estimate.summary.usable() || !at_estimate.timeline)
    throw InputError(std::string(method.name()), "",
                     "has no event times at the estimate: " + at_estimate.summary.message);
  PredictedEvents result;
  result.at_estimate = *at_estimate.timeline;
  std::vector<PredictedNumber> predicted;
  for (const double t : numbers_of(result.at_estimate)) predicted.push_back({t, {}, {}});
  set_linear_bands(estimated, draws, method, predicted);
  if (!all_have_bands(predicted)) {
    std::vector<Numbers> drawn;
    result.n_failed = solve_all(
        draws, method, request, progress,
        [&](const Scene<double>&, const SolverResult& one) { drawn.push_back(numbers_of(*one.timeline)); });
    result.n_by_draws = set_drawn_bands(drawn, predicted);
  }
  result.t0 = predicted[0];
  result.t1 = predicted[1];
  result.t_star = predicted[2];
  for (std::size_t i = 3; i + 1 < predicted.size(); i += 2)
    result.interfaces.push_back({predicted[i], predicted[i + 1]});
  return result;
}

}  // namespace shearfront::fit
