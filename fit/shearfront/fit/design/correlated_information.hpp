// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/fit/design/information.hpp"

namespace shearfront::fit {

/// Information that units of measurements with correlated noise bring. It does not add up: those of a set S together say
///
///     M(S) = before + J_S^T (C_SS)^-1 J_S,
///
/// J and C being those of what the observations that are there already do not foretell of the candidates.
struct CorrelatedInformation {
  std::vector<Eigen::MatrixXd> before;     ///< [draw]
  std::vector<Eigen::MatrixXd> jacobians;  ///< [draw]: row = candidate
  Eigen::MatrixXd covariance;              ///< of the candidates, positive definite
  std::vector<std::vector<Eigen::Index>> units;
};

/// With C = s 1 + K, s > 0 its least eigenvalue, and A the diagonal matrix of n w_g for the candidates of unit g,
///
///     M(w) = before + J^T (s A^-1 + K)^-1 J
///
/// is M(S) where n w_g is 1 for the units of S and 0 for the others, and concave in w, for parallel sums of matrices are
/// (Anderson & Duffin 1969, J. Math. Anal. Appl. 26, 576-594): the criterion is convex, and its tangent bounds all sets of n.
/// Solved over few units at a time (correlated_relaxation.cpp), the bound within 1e-6 of the value where that takes no longer than what
/// follows. Cost: the eigenvalues of C, c^3 4/3 flops, c candidates; where few units are fractional little more, at most as much again
/// or twice that.
[[nodiscard]] std::optional<ContinuousDesign> continuous_design(const CorrelatedInformation& information,
                                                                const InformationCriterion& criterion,
                                                                std::size_t n);

/// n different units by exchange until no exchange of one is better: the best that is found from the largest weights on, and from
/// samples of the weights while these are cheap. Each in turn is taken out by the formula of partitioned inverses, and those that can
/// be best in its place, by the tangent at the set as it is, are tried. Cost: a pass is n times c (p^2 + m) flops, m candidates
/// chosen, and (m + c - m) m^2 before it; c m for each exchange.
[[nodiscard]] std::vector<std::size_t> exchanged_design(const CorrelatedInformation& information,
                                                        const InformationCriterion& criterion, std::size_t n,
                                                        const ContinuousDesign& start);

[[nodiscard]] Eigen::MatrixXd information_of(const CorrelatedInformation& information, std::size_t draw,
                                             const std::vector<std::size_t>& units);

}  // namespace shearfront::fit
