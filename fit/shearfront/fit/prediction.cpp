// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prediction.hpp"

#include <algorithm>
#include <any>
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

/// A number on an axis.
struct OnAxis {
  double slope, far_low, far_high;
};

/// The deviation of a number by its slopes; nothing where a straight line does not do.
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
         std::all_of(draws.axes.begin(), draws.axes.end(), [](const DrawnScenes::Axis& axis) {
           return axis.near_low && axis.near_high && axis.far_low && axis.far_high;
         });
}

/// Solves every drawn scene; take(result) for those that have a result. Returns how many have none.
template <class Take>
std::size_t solve_all(const DrawnScenes& draws, const Method& method, const SolverRequest& request,
                      const Progress& progress, Take&& take) {
  std::size_t n_failed = 0;
  for (std::size_t i = 0; i < draws.scenes.size(); ++i) {
    const SolverResult result = solve(draws.scenes[i], method, request);
    if (result.summary.usable())
      take(result);
    else
      ++n_failed;
    if (progress && !progress(i + 1, 0)) break;
  }
  return n_failed;
}

using Numbers = std::vector<double>;

/// phi of all places, then M.
Numbers numbers_of(const std::vector<Sample>& samples) {
  Numbers numbers;
  for (const Sample& s : samples) numbers.push_back(s.phi);
  for (const Sample& s : samples) numbers.push_back(s.M);
  return numbers;
}

/// Sets the bands that derivatives give; false if there are none.
bool set_linear_bands(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                      const SolverRequest& request, std::vector<PredictedNumber>& predicted) {
  if (!has_axes(draws)) return false;
  const std::vector<Entry> all = entries(estimated.spec());
  for (const std::size_t i : draws.entries)
    if (!method.has_derivative(estimated, all[i])) return false;
  std::vector<Place> places;
  for (const double t : request.times)
    for (const double z : request.heights) places.push_back({t, z});
  std::any memory;
  const Linearisation linear = method.linearise(estimated, places, draws.entries, memory);
  if (!linear.summary.usable()) return false;
  const std::size_t n_entries = draws.entries.size(), n = places.size();
  std::vector<std::vector<OnAxis>> on(2 * n);
  for (const DrawnScenes::Axis& axis : draws.axes) {
    const SolverResult low = solve(*axis.far_low, method, request),
                       high = solve(*axis.far_high, method, request);
    if (!low.summary.usable() || !high.summary.usable()) return false;
    const Numbers at_low = numbers_of(low.samples), at_high = numbers_of(high.samples);
    for (std::size_t i = 0; i < n; ++i) {
      OnAxis phi{0, at_low[i], at_high[i]}, M{0, at_low[n + i], at_high[n + i]};
      for (std::size_t k = 0; k < n_entries; ++k) {
        phi.slope += linear.derivatives[i * n_entries + k].phi * axis.slopes[k];
        M.slope += linear.derivatives[i * n_entries + k].M * axis.slopes[k];
      }
      on[i].push_back(phi);
      on[n + i].push_back(M);
    }
  }
  for (std::size_t i = 0; i < 2 * n; ++i) {
    PredictedNumber& number = predicted[i];
    number.std_error = linear_deviation(number.value, on[i], draws);
    if (!number.std_error) continue;
    const double half = draws.quantile * *number.std_error;
    number.band = {number.value - half, number.value + half};
  }
  return true;
}

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

/// Numbers of the timelines on an axis; empty if one has another number of interfaces, or there is none.
std::vector<Numbers> on_axis(const DrawnScenes::Axis& axis, const Method& method, std::size_t n) {
  SolverRequest request;
  request.timeline = true;
  std::vector<Numbers> all;
  for (const auto* scene : {&axis.near_low, &axis.near_high, &axis.far_low, &axis.far_high}) {
    const SolverResult result = solve(**scene, method, request);
    if (!result.summary.usable() || !result.timeline) return {};
    all.push_back(numbers_of(*result.timeline));
    if (all.back().size() != n) return {};
  }
  return all;
}

void set_linear_bands(const DrawnScenes& draws, const Method& method,
                      std::vector<PredictedNumber>& predicted) {
  if (!has_axes(draws) || !method.guarantees().exact) return;
  std::vector<std::vector<OnAxis>> on(predicted.size());
  std::vector<bool> is_fixed(predicted.size(), true);  // the same on all axes: 0, or never
  for (const DrawnScenes::Axis& axis : draws.axes) {
    const std::vector<Numbers> at = on_axis(axis, method, predicted.size());
    if (at.empty()) return;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      for (const Numbers& numbers : at) is_fixed[i] = is_fixed[i] && numbers[i] == predicted[i].value;
      on[i].push_back({(std::log(at[1][i]) - std::log(at[0][i])) / (2 * DrawnScenes::kNear),
                       std::log(at[2][i]), std::log(at[3][i])});
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

/// The numbers without a band by derivatives get that of the draws. Returns how many they are.
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

}  // namespace

PredictedSamples predict_samples(const Scene<double>& estimated, const DrawnScenes& draws,
                                 const Method& method, const std::vector<double>& times,
                                 const std::vector<double>& heights, const Progress& progress) {
  SolverRequest request;
  request.times = times;
  request.heights = heights;
  const SolverResult at_estimate = solve(estimated, method, request);
  if (!at_estimate.summary.usable())
    throw InputError(std::string(method.name()), "",
                     "has no solution at the estimate: " + at_estimate.summary.message);
  std::vector<PredictedNumber> predicted;
  for (const double x : numbers_of(at_estimate.samples)) predicted.push_back({x, {}, {}});
  PredictedSamples result;
  (void)set_linear_bands(estimated, draws, method, request, predicted);
  if (!all_have_bands(predicted)) {
    std::vector<Numbers> drawn;
    result.n_failed = solve_all(draws, method, request, progress,
                                [&](const SolverResult& one) { drawn.push_back(numbers_of(one.samples)); });
    result.n_by_draws = set_drawn_bands(drawn, predicted);
  }
  const auto middle = predicted.begin() + static_cast<std::ptrdiff_t>(predicted.size() / 2);
  result.phi.assign(predicted.begin(), middle);
  result.M.assign(middle, predicted.end());
  return result;
}

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
  set_linear_bands(draws, method, predicted);
  if (!all_have_bands(predicted)) {
    std::vector<Numbers> drawn;
    result.n_failed = solve_all(draws, method, request, progress,
                                [&](const SolverResult& one) { drawn.push_back(numbers_of(*one.timeline)); });
    result.n_by_draws = set_drawn_bands(drawn, predicted);
  }
  result.t0 = predicted[0];
  result.t1 = predicted[1];
  result.t_star = predicted[2];
  for (std::size_t i = 3; i + 1 < predicted.size(); i += 2)
    result.interfaces.push_back({predicted[i], predicted[i + 1]});
  return result;
}

PredictedNumbers predict_numbers(const Scene<double>& estimated, const DrawnScenes& draws,
                                 const SceneNumbers& numbers, bool are_exact, const Progress& progress) {
  PredictedNumbers result;
  for (const double x : numbers(estimated)) result.numbers.push_back({x, {}, {}});
  const std::size_t n = result.numbers.size();
  std::vector<std::vector<OnAxis>> on(n);
  bool has_slopes = are_exact && has_axes(draws);
  for (std::size_t k = 0; has_slopes && k < draws.axes.size(); ++k) {
    const DrawnScenes::Axis& axis = draws.axes[k];
    std::vector<Numbers> at;
    for (const auto* scene : {&axis.near_low, &axis.near_high, &axis.far_low, &axis.far_high})
      at.push_back(numbers(**scene));
    has_slopes = std::all_of(at.begin(), at.end(), [&](const Numbers& x) { return x.size() == n; });
    for (std::size_t i = 0; has_slopes && i < n; ++i)
      on[i].push_back({(at[1][i] - at[0][i]) / (2 * DrawnScenes::kNear), at[2][i], at[3][i]});
  }
  for (std::size_t i = 0; has_slopes && i < n; ++i) {
    PredictedNumber& number = result.numbers[i];
    number.std_error = linear_deviation(number.value, on[i], draws);
    if (!number.std_error) continue;
    const double half = draws.quantile * *number.std_error;
    number.band = {number.value - half, number.value + half};
  }
  if (all_have_bands(result.numbers)) return result;
  std::vector<Numbers> drawn;
  for (const Scene<double>& scene : draws.scenes) {
    drawn.push_back(numbers(scene));
    if (drawn.back().empty()) ++result.n_failed;
    if (progress && !progress(drawn.size(), 0)) break;
  }
  result.n_by_draws = set_drawn_bands(drawn, result.numbers);
  return result;
}

}  // namespace shearfront::fit
