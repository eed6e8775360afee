// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "shearfront/fit/report.hpp"

namespace shearfront::fit {

/// Whether the misfit rises towards the ends of the 95 % intervals like the parabola the intervals come from.
/// With
///
///     rise(x) = sqrt(2 (F(u_min + x v) - F_min) / (c_j (q x)^2)),   v = -+ q cov_j / sqrt(cov_jj),
///
/// 1 for a parabola, an end (x = 1) is too near if rise(k) < 1 / k, too far if rise(1 / k) > k, k = kMostOff:
/// a profile interval ends more than k times farther or nearer there. v is where a linear model has the
/// minimum over the other coordinates (c_j is Covariance::misfit_scale, q the quantile of the interval);
/// elsewhere F can only be larger, so an end that is too near is proved to be, and the others are refitted
/// (Ceres) before one is called too far. A bound on the way is looked at in place of what is beyond it; an
/// end beyond it is never called too near.
///
/// Empty for parameters without interval or with one that is rounding (exact data); for all with a shape
/// (intervals of differences have no such line), of more than kMostProfiled unknowns, and where points near a shock are left out (which ones
/// depends on the estimate). Cost: two runs of the model per parameter; one more, or a refit of about ten,
/// for an end where rise(1) is far from 1. Source: Bates & Watts (1988), Nonlinear Regression Analysis,
/// section 6.1 (profile t plots).
[[nodiscard]] std::vector<std::optional<IntervalCheck>> check_intervals(const Minimum& minimum,
                                                                        const Estimate& estimate);

inline constexpr double kMostOff = 1.5;

}  // namespace shearfront::fit
