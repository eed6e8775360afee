// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "shearfront/fit/covariance.hpp"
#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"

namespace shearfront::fit {

/// What a reader of the estimate must know, one sentence each: parameters at a bound, not seen by the data,
/// or confounded with others (with the direction that cannot be determined); intervals that are not to be
/// trusted; residuals with structure or far larger than their sigma; too few data.
[[nodiscard]] std::vector<std::string> warnings(const FitSpec& spec, const Parameters& parameters,
                                                const Objective& objective, const Covariance& errors,
                                                const Objective::Evaluation& best, const Estimate& estimate);

}  // namespace shearfront::fit
