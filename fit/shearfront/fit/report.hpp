// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/covariance.hpp"
#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

/// Where a search ended: what error bars, checks and warnings are made of.
struct Minimum {
  const FitSpec& spec;
  const Parameters& parameters;
  const Objective& objective;
  Eigen::VectorXd u;         ///< the coordinates
  Objective::Evaluation at;  ///< with its Jacobian
  Covariance errors;
  double quantile = 0;  ///< half width of a 95 % interval in standard errors
};

/// What a search found, with error bars, predictions and warnings. `noise`: by which the rows of the objective are whitened.
[[nodiscard]] Estimate report(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                              const SearchResult& found, std::optional<NoiseEstimate> noise = {});

/// What a reader of the estimate must know, one sentence each: parameters at a bound, not seen by the data,
/// or confounded with others (with the direction that cannot be determined); intervals that are not to be
/// trusted; residuals with structure or far larger than their sigma; too few data.
[[nodiscard]] std::vector<std::string> warnings(const Minimum& minimum, const Estimate& estimate);

/// Whether parameters whose plain intervals do not do get profile intervals: those of all were asked for, or derivatives make them
/// cheap. They take some ten Jacobians and systems of all unknowns for each of them: of more than kMostProfiled nobody would wait
/// for what was not asked for.
[[nodiscard]] bool has_profiles(const FitSpec& spec, const Objective& objective);
inline constexpr std::size_t kMostProfiled = 50;

/// Whether the standard error of a positive number is more than half of its estimate: a 95 % interval by a factor of e or more.
[[nodiscard]] bool is_barely_seen(const Parameter& parameter, const ParameterEstimate& estimate);

}  // namespace shearfront::fit
