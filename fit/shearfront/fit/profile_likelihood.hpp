// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// 95 % intervals of parameters, and what is to be said about them.
struct Profiles {
  /// An end that the data do not give is NaN; empty if neither end is known.
  std::vector<std::optional<Interval>> intervals;
  std::vector<std::string> warnings;
};

/// Profile-likelihood intervals of the wanted parameters, empty for all others: all values x of a coordinate for which
///
///     2 (min over the others of F(u | u_j = x) - F(u_min)) <= c_j q,
///
/// q the 95 % quantile of chi^2_1 if sigma is given, else of F(1, freedom) with the noise estimated once, at
/// the minimum. c_j is Covariance::misfit_scale: noise^2 for least squares of independent rows; for a robust
/// loss and for rows with correlated noise F is a quasi-likelihood, scaled so that its curvature agrees with
/// the covariance of the estimate. Unlike estimate -+ error they need no linear model: the intervals follow
/// the curved misfit, stop where the misfit jumps, and are the same for a parameter and its logarithm.
///
/// With exact derivatives and least squares each end is found by Newton's method on all coordinates at once, in some five
/// evaluations. Where that does not lead there (bounds, jumps of the misfit, no solution), and without derivatives, it
/// is bracketed from the standard error outwards and found by TOMS 748 to kEndTolerance of its
/// distance, with at most kMostRefits refits (Ceres) of the others, each from the last one; where that has no
/// solution, or ends beyond the interval, also from nearer to the start values of the fit, and the lower
/// counts. An end not reached inside the bounds of the parameter, or up to where the model has no solution,
/// stays open and is warned about; so is a misfit below the minimum. Preconditions: no shape; `estimate` is
/// the minimum of `objective`, usable. Cost: about 10 evaluations a parameter, or 10 refits. Source: Venzon & Moolgavkar (1988);
/// scaling: Chandler & Bate (2007).
[[nodiscard]] Profiles profile_intervals(const FitSpec& spec, const Parameters& parameters,
                                         const Objective& objective, const Estimate& estimate,
                                         const std::vector<bool>& wanted, const Progress& progress = {});

/// The intervals that a linear model cannot give because a parameter is at a bound, by profiles as above: those of parameters at
/// a bound, open beyond it, and of all that move by more than kMostMoved of their standard errors while one at a bound
/// moves to the inner end of its interval. With it taken as known theirs would be too narrow, and beside the truth where the bound is.
/// Empty for all others. Preconditions as above; the forward model has derivatives. Cost: some 10 refits for each of them.
[[nodiscard]] Profiles intervals_beside_bounds(const FitSpec& spec, const Parameters& parameters,
                                               const Objective& objective, const Estimate& estimate,
                                               const Progress& progress = {});

inline constexpr double kMostMoved = 0.3;
inline constexpr double kEndTolerance = 1e-3;
inline constexpr int kMostRefits = 40;

}  // namespace shearfront::fit
