// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "shearfront/fit/design/design.hpp"

namespace shearfront::fit {

/// Information that units of measurements bring: symmetric p x p matrices, the same units for each draw of the scene.
struct UnitInformation {
  std::vector<Eigen::MatrixXd> before;              ///< [draw]: of the observations that are there already
  std::vector<std::vector<Eigen::MatrixXd>> units;  ///< [draw][unit]
};

/// A criterion as a function of the information, +infinity where this is singular, and its derivative S in it:
/// d criterion = trace(S dM). Convex.
class InformationCriterion {
 public:
  /// `target`: coordinate of Criterion::target.
  InformationCriterion(Criterion criterion, Eigen::Index target) : criterion_(criterion), target_(target) {}

  [[nodiscard]] double value(const Eigen::MatrixXd& information) const;
  struct Tangent {
    double value = 0;
    Eigen::MatrixXd slope;
  };
  /// Nothing where the information is singular.
  [[nodiscard]] std::optional<Tangent> tangent(const Eigen::MatrixXd& information) const;

 private:
  Criterion criterion_;
  Eigen::Index target_;
};

/// Weights of the continuous design of n units and what it says: see design().
struct ContinuousDesign {
  Eigen::VectorXd weights;
  Eigen::VectorXd worth;  ///< - d criterion / d weight
  double value = 0;       ///< mean criterion over the draws
  double bound = 0;       ///< no n units have less
};
/// Nothing if even equal weights of all units leave the information singular.
[[nodiscard]] std::optional<ContinuousDesign> continuous_design(const UnitInformation& information,
                                                                const InformationCriterion& criterion,
                                                                std::size_t n);

/// n different units, from the largest weights on by exchange until no exchange of one is better.
[[nodiscard]] std::vector<std::size_t> exchanged_design(const UnitInformation& information,
                                                        const InformationCriterion& criterion, std::size_t n,
                                                        const ContinuousDesign& start);

/// Mean criterion of units over the draws.
[[nodiscard]] double mean_criterion(const UnitInformation& information, const InformationCriterion& criterion,
                                    const std::vector<std::size_t>& units);

}  // namespace shearfront::fit
