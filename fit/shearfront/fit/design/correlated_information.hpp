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
/// Cost: up to 100 times c^3 / 3 flops, c candidates.
[[nodiscard]] std::optional<ContinuousDesign> continuous_design(const CorrelatedInformation& information,
                                                                const InformationCriterion& criterion,
                                                                std::size_t n);

/// n different units, from the largest weights on by exchange until no exchange of one is better. Each is taken out by the
/// formula of partitioned inverses, and all others are tried in its place.
/// Cost: a pass is n times c m flops and c spectra of p x p matrices, m candidates chosen; m^3 + c m^2 for each exchange.
[[nodiscard]] std::vector<std::size_t> exchanged_design(const CorrelatedInformation& information,
                                                        const InformationCriterion& criterion, std::size_t n,
                                                        const ContinuousDesign& start);

[[nodiscard]] Eigen::MatrixXd information_of(const CorrelatedInformation& information, std::size_t draw,
                                             const std::vector<std::size_t>& units);

}  // namespace shearfront::fit
