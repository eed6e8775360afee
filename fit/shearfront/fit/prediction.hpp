// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <functional>
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
  bool are_replicates = false;  ///< those of a bootstrap

  /// One of the independent directions in which the unknowns vary, by a number xi of unit deviation. The scenes at -x and
  /// x on it: near the estimate, at kNear, and so far that a number that is linear in all xi stays between them and their like with
  /// 95 %: at quantile sqrt(number of axes).
  struct Axis {
    std::vector<double> slopes;                                           ///< of the unknowns in xi
    std::optional<Scene<double>> near_low, near_high, far_low, far_high;  ///< empty: no valid scene
  };
  static constexpr double kNear = 1e-3;
  std::vector<Axis> axes;
  std::vector<std::size_t> entries;  ///< of the unknowns among those of the scene
  double quantile = 0;               ///< of 97.5 %

  [[nodiscard]] double reach() const { return quantile * std::sqrt(static_cast<double>(axes.size())); }
};

/// `n` scenes; the same for the same seed. Precondition: the estimate is usable. Cost: n scenes.
[[nodiscard]] DrawnScenes draw_scenes(const Parameters& parameters, const Estimate& estimate, std::size_t n,
                                      std::uint64_t seed);

/// The scenes behind the bands of a fit: one for each replicate of its bootstrap, without axes, so that bands lie between
/// the quantiles of what the replicates say; without a bootstrap draw_scenes(). Precondition: the estimate is usable.
[[nodiscard]] DrawnScenes scenes_behind(const Parameters& parameters, const Estimate& estimate, std::size_t n,
                                        std::uint64_t seed);

/// A number g at the estimate, and where it is with 95 %.
///
/// By derivatives, where the method has them: g -+ quantile sd, sd^2 = sum over the axes of (dg/dxi)^2, if at both far
/// ends of every axis the straight line is off by no more than kMostBent of that (times the number of axes, the square of
/// how much farther they are). Times, which are positive, in their logarithm.
/// Elsewhere, as where a shock may have passed or not, by draws: what lies between the 2.5 % and the 97.5 % quantile of the
/// drawn scenes, (n + 1) p-th in order with linear interpolation; so a band follows phi from one state to the other, where
/// a derivative has no meaning. An event that never comes has kNever.
struct PredictedNumber {
  static constexpr double kMostBent = 0.05;
  double value = 0;
  std::optional<Interval> band;     ///< empty without axes and draws
  std::optional<double> std_error;  ///< sd, if the band is by derivatives
};

/// phi and M at times x heights, heights running fastest. Derivatives are those of Method::linearise.
struct PredictedSamples {
  std::vector<PredictedNumber> phi, M;
  std::size_t n_failed = 0;    ///< draws that the method could not solve, left out
  std::size_t n_by_draws = 0;  ///< numbers whose bands are by draws
};
/// Errors: as solve(). Cost: two solutions for each axis, and one for each draw where draws are needed.
[[nodiscard]] PredictedSamples predict_samples(const Scene<double>& estimated, const DrawnScenes& draws,
                                               const Method& method, const std::vector<double>& times,
                                               const std::vector<double>& heights,
                                               const Progress& progress = {});

/// The event times, as in Timeline. Derivatives are those of Method::linearise_timeline; where it has none, for some unknown or some
/// event, differences of exact times along the axes, right to nine digits. A method that is not exact has neither. Cost: two timelines
/// for each axis, four where they are differenced, and one for each draw where draws are needed.
struct PredictedEvents {
  Timeline<double> at_estimate;
  struct AtInterface {
    PredictedNumber first, last;
  };
  PredictedNumber t0, t1, t_star;
  std::vector<AtInterface> interfaces;
  std::size_t n_failed = 0, n_by_draws = 0;
};
[[nodiscard]] PredictedEvents predict_events(const Scene<double>& estimated, const DrawnScenes& draws,
                                             const Method& method, const Progress& progress = {});

/// Numbers that are made of an integral over the bed and the amount of its grains, as the height of the bed is.
struct BedFunction {
  struct Number {
    double value, by_integral, by_mass;
  };
  ShareFunction integrand;  ///< with its slope
  std::function<std::vector<Number>(const Scene<double>&, double integral)> numbers;
};
/// The height of the bed. Precondition: BedHeight::refusal(scene) is empty.
[[nodiscard]] BedFunction bed_height_function(const Scene<double>& scene);
/// Entropy and parameter of mixing (solution/mixing.hpp).
[[nodiscard]] BedFunction mixing_function();

/// Those numbers at every time, one time after the other. Derivatives are those of Method::linearise_integrals, or differences, as for
/// event times. Errors: as solve(). Cost: as predict_events().
struct PredictedNumbers {
  std::vector<PredictedNumber> numbers;
  std::size_t n_failed = 0, n_by_draws = 0;
};
[[nodiscard]] PredictedNumbers predict_bed(const Scene<double>& estimated, const DrawnScenes& draws,
                                           const Method& method, const BedFunction& bed,
                                           const std::vector<double>& times, const Progress& progress = {});

}  // namespace shearfront::fit
