// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prediction.hpp"

#include <algorithm>
#include <any>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "shearfront/fit/number_bands.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"

namespace shearfront::fit {
namespace {

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
