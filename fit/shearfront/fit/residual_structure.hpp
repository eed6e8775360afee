// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/solution/observation.hpp"

namespace shearfront::fit {

/// Whether what a fit leaves looks like independent noise, from the residuals e = (predicted - value) / sigma
/// (sigma = 1 where it is not given), by three tests:
///
///   lag1_height   sum e_i e_{i+1} / sqrt(sum e_i^2 sum e_{i+1}^2) over neighbours in z at one time
///   lag1_time     the same over successive times at one height
///   runs_z_score  (R - E R) / sqrt(Var R) of the runs of equal sign over z, R, E R and Var R summed over the
///                 times (Wald & Wolfowitz 1940); zeros are left out
///
/// A correlation is tested by z = sum x_i x_{i+1} / sqrt(sum (x_i x_{i+1})^2) with the signed normal scores
/// x = sign(e) Phi^-1((1 + rank |e| / (n + 1)) / 2): given the sizes |e|, the products of independent
/// residuals with symmetric laws have independent signs, so z has mean 0 and variance 1 whatever their
/// variances, and single gross residuals decide nothing. is_structured: one of the tests fails on either side
/// at the level kStructureLevel divided by the number of tests done (Bonferroni), so independent noise is called
/// structured in at most 1 % of all fits. No mean is subtracted: a shift of a whole profile is structure.
///
/// A number is NaN where its test has fewer than kFewestPairs pairs (residuals for the runs). Empty if all
/// have, or if the residuals are at rounding level: rms below kRounding times the range of the data.
/// Residuals that small count as zero, NaN predictions are skipped. Cost: O(n log n).
[[nodiscard]] std::optional<ResidualStructure> residual_structure(const Observations& observations,
                                                                  const std::vector<double>& predicted);

inline constexpr std::size_t kFewestPairs = 20;
inline constexpr double kStructureLevel = 0.01;

}  // namespace shearfront::fit
