// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/fit/prediction.hpp"

/// Bands of predicted numbers, by their slopes on the axes of the unknowns or by draws: see PredictedNumber.
namespace shearfront::fit {

using Numbers = std::vector<double>;

/// A number on an axis.
struct OnAxis {
  double slope, far_low, far_high;
};

/// The slope on an axis of a number with these derivatives.
[[nodiscard]] double slope_on(const DrawnScenes::Axis& axis, const double* derivatives);

/// The deviation of a number by its slopes; nothing where a straight line does not do.
[[nodiscard]] std::optional<double> linear_deviation(double value, const std::vector<OnAxis>& on,
                                                     const DrawnScenes& draws);

[[nodiscard]] bool has_axes(const DrawnScenes& draws);

/// By its numbers next to the estimate.
[[nodiscard]] double difference_on_axis(double near_low, double near_high);

/// Whether there are axes, and the method has derivatives by all unknowns.
[[nodiscard]] bool has_derivatives(const Scene<double>& estimated, const DrawnScenes& draws,
                                   const Method& method);

void set_linear_band(PredictedNumber& number, const std::vector<OnAxis>& on, const DrawnScenes& draws);

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

/// The numbers without a band by derivatives get that of the draws. Returns how many they are.
std::size_t set_drawn_bands(const std::vector<Numbers>& drawn, std::vector<PredictedNumber>& predicted);

[[nodiscard]] bool all_have_bands(const std::vector<PredictedNumber>& predicted);

}  // namespace shearfront::fit
