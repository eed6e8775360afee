// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prediction.hpp"

#include <algorithm>
#include <any>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "shearfront/fit/quantile.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"

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

/// The slope on an axis of a number with these derivatives.
double slope_on(const DrawnScenes::Axis& axis, const double* derivatives) {
  double slope = 0;
  for (std::size_t k = 0; k < axis.slopes.size(); ++k) slope += derivatives[k] * axis.slopes[k];
  return slope;
}

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
         std::all_of(draws.axes.begin(), draws.axes.end(),
                     [](const DrawnScenes::Axis& axis) { return axis.far_low && axis.far_high; });
}

/// By its numbers next to the estimate.
double difference_on_axis(double near_low, double near_high) {
  return (near_high - near_low) / (2 * DrawnScenes::kNear);
}

/// Whether there are axes, and the method has derivatives by all unknowns.
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

/// Solves every drawn scene; take(scene, result) for those that have one. Returns how many have none.
template <class Take>
std::size_t solve_all(const DrawnScenes& draws, const Method& method, const SolverRequest& request,
                      const Progress& progress, Take&& take) {
  std::size_t n_failed = 0;
  for (std::size_t i = 0; i < draws.scenes.size(); ++i) {
    const SolverResult result = solve(draws.scenes[i], method, request);
    if (result.summary.usable())
      take(draws.scenes[i], result);
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

/// Sets the bands that derivatives give.
void set_linear_bands(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                      const SolverRequest& request, std::vector<PredictedNumber>& predicted) {
  if (!has_derivatives(estimated, draws, method)) return;
  std::vector<Place> places;
  for (const double t : request.times)
    for (const double z : request.heights) places.push_back({t, z});
  std::any memory;
  const Linearisation linear = method.linearise(estimated, places, draws.entries, memory);
  if (!linear.summary.usable()) return;
  const std::size_t n_entries = draws.entries.size(), n = places.size();
  std::vector<std::vector<OnAxis>> on(2 * n);
  for (const DrawnScenes::Axis& axis : draws.axes) {
    const SolverResult low = solve(*axis.far_low, method, request),
                       high = solve(*axis.far_high, method, request);
    if (!low.summary.usable() || !high.summary.usable()) return;
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
  for (std::size_t i = 0; i < 2 * n; ++i) set_linear_band(predicted[i], on[i], draws);
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

SolverRequest request_of(const BedFunction& bed, const std::vector<double>& times) {
  SolverRequest request;
  request.times = times;
  request.integrand = bed.integrand;
  return request;
}

Numbers numbers_of(const BedFunction& bed, const Scene<double>& scene, const std::vector<double>& integrals) {
  Numbers numbers;
  for (const double integral : integrals)
    for (const BedFunction::Number& number : bed.numbers(scene, integral)) numbers.push_back(number.value);
  return numbers;
}

Numbers numbers_at(const Scene<double>& scene, const Method& method, const BedFunction& bed,
                   const std::vector<double>& times) {
  const SolverResult result = solve(scene, method, request_of(bed, times));
  return result.summary.usable() ? numbers_of(bed, scene, result.integrals) : Numbers{};
}

/// The slopes on an axis of the same.
Numbers slopes_on(const DrawnScenes::Axis& axis, const Scene<double>& estimated, const BedFunction& bed,
                  const LinearIntegrals& linear) {
  Numbers slopes;
  const double mass = slope_on(axis, linear.mass_derivatives.data());
  for (std::size_t i = 0; i < linear.integrals.size(); ++i) {
    const double integral = slope_on(axis, &linear.derivatives[i * axis.slopes.size()]);
    for (const BedFunction::Number& number : bed.numbers(estimated, linear.integrals[i]))
      slopes.push_back(number.by_integral * integral + number.by_mass * mass);
  }
  return slopes;
}

void set_linear_bands(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                      const BedFunction& bed, const std::vector<double>& times,
                      std::vector<PredictedNumber>& predicted) {
  if (!has_axes(draws) || !method.guarantees().exact) return;
  std::optional<LinearIntegrals> linear;
  if (bed.integrand.slope && method.has_linear_integrals() && has_derivatives(estimated, draws, method)) {
    std::any memory;
    linear = method.linearise_integrals(estimated, times, bed.integrand, draws.entries, memory);
  }
  std::vector<std::vector<OnAxis>> on(predicted.size());
  for (const DrawnScenes::Axis& axis : draws.axes) {
    const Numbers low = numbers_at(*axis.far_low, method, bed, times),
                  high = numbers_at(*axis.far_high, method, bed, times);
    Numbers slopes;
    if (linear) {
      slopes = slopes_on(axis, estimated, bed, *linear);
    } else {
      const Numbers near_low = numbers_at(*axis.near_low, method, bed, times),
                    near_high = numbers_at(*axis.near_high, method, bed, times);
      for (std::size_t i = 0; i < std::min(near_low.size(), near_high.size()); ++i)
        slopes.push_back(difference_on_axis(near_low[i], near_high[i]));
    }
    for (const Numbers* all : std::initializer_list<const Numbers*>{&low, &high, &slopes})
      if (all->size() != predicted.size()) return;
    for (std::size_t i = 0; i < predicted.size(); ++i) on[i].push_back({slopes[i], low[i], high[i]});
  }
  for (std::size_t i = 0; i < predicted.size(); ++i) set_linear_band(predicted[i], on[i], draws);
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
  set_linear_bands(estimated, draws, method, request, predicted);
  if (!all_have_bands(predicted)) {
    std::vector<Numbers> drawn;
    result.n_failed = solve_all(
        draws, method, request, progress,
        [&](const Scene<double>&, const SolverResult& one) { drawn.push_back(numbers_of(one.samples)); });
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

BedFunction bed_height_function(const Scene<double>& scene) {
  return {BedHeight(scene).integrand(), [](const Scene<double>& of, double integral) {
            const BedHeight bed(of);
            return std::vector<BedFunction::Number>{
                {bed.height(integral), bed.height_by(integral, 1, 0), bed.height_by(integral, 0, 1)}};
          }};
}

BedFunction mixing_function() {
  return {entropy_function(), [](const Scene<double>& of, double integral) {
            const double mass = of.mass(), solid = of.solid(of.bottom(), of.top());
            const Mixing at = mixing(integral, mass, solid);
            const double by_mixed = at.mixed > 0 ? -at.parameter / at.mixed : 0;
            return std::vector<BedFunction::Number>{{at.entropy, 1, 0},
                                                    {at.parameter, at.mixed > 0 ? 1 / at.mixed : 0,
                                                     by_mixed * entropy_function().slope(mass / solid)}};
          }};
}

PredictedNumbers predict_bed(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                             const BedFunction& bed, const std::vector<double>& times,
                             const Progress& progress) {
  const SolverRequest request = request_of(bed, times);
  const SolverResult at_estimate = solve(estimated, method, request);
  if (!at_estimate.summary.usable())
    throw InputError(std::string(method.name()), "",
                     "has no solution at the estimate: " + at_estimate.summary.message);
  PredictedNumbers result;
  for (const double x : numbers_of(bed, estimated, at_estimate.integrals))
    result.numbers.push_back({x, {}, {}});
  set_linear_bands(estimated, draws, method, bed, times, result.numbers);
  if (all_have_bands(result.numbers)) return result;
  std::vector<Numbers> drawn;
  result.n_failed =
      solve_all(draws, method, request, progress, [&](const Scene<double>& scene, const SolverResult& one) {
        drawn.push_back(numbers_of(bed, scene, one.integrals));
      });
  result.n_by_draws = set_drawn_bands(drawn, result.numbers);
  return result;
}

}  // namespace shearfront::fit
