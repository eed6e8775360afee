// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/solver/solve.hpp"

/// What a fit says about numbers that were not measured, with its uncertainty.
namespace shearfront::fit {

/// Stands for the time of an event that never comes.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Scenes drawn from what the data leave possible: the unknowns are normal about their estimates (entries that must be
/// positive in their logarithm) with the standard errors and correlations of the fit; where the noise was estimated
/// from the residuals, Student's t with its degrees of freedom instead. An unknown at a bound stays there.
struct DrawnScenes {
  std::vector<Scene<double>> scenes;
  std::size_t n_refused = 0;  ///< draws outside the bounds or no valid scene, drawn again
  std::string
      why_none;  ///< why there are no scenes: an unknown without error bar, or hardly a draw was valid
};

/// `n` scenes; the same for the same seed. Precondition: the estimate is usable. Cost: n scenes.
[[nodiscard]] DrawnScenes draw_scenes(const Parameters& parameters, const Estimate& estimate, std::size_t n,
                                      std::uint64_t seed);

/// A number at the estimate, and between which 95 % of the drawn scenes have it: from the 2.5 % to the 97.5 % quantile,
/// (n + 1) p-th in order with linear interpolation. An event that never comes has kNever. So a band follows
/// phi where a shock may have passed or not: from one state to the other, where a linear propagation has no meaning.
struct PredictedNumber {
  double value = 0;
  std::optional<Interval> band;  ///< empty without draws
};

/// phi and M at times x heights, heights running fastest.
struct PredictedSamples {
  std::vector<PredictedNumber> phi, M;
  std::size_t n_failed = 0;  ///< draws that the method could not solve, left out
};
/// Errors: as solve(). Cost: one solution for each draw.
[[nodiscard]] PredictedSamples predict_samples(const Scene<double>& estimated, const DrawnScenes& draws,
                                               const Method& method, const std::vector<double>& times,
                                               const std::vector<double>& heights,
                                               const Progress& progress = {});

/// The event times, as in Timeline.
struct PredictedEvents {
  Timeline<double> at_estimate;
  struct InterfaceBands {
    std::optional<Interval> first, last;
  };
  std::optional<Interval> t0, t1, t_star;
  std::vector<InterfaceBands> interfaces;
  std::size_t n_failed = 0;
};
[[nodiscard]] PredictedEvents predict_events(const Scene<double>& estimated, const DrawnScenes& draws,
                                             const Method& method, const Progress& progress = {});

}  // namespace shearfront::fit
