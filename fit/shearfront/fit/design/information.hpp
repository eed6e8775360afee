// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
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
/// Mean criterion over the draws as a convex function of the weights, +infinity where the information is singular; `worth`,
/// unless null, becomes minus its derivatives.
using WeightedCriterion = std::function<double(const Eigen::VectorXd& weights, Eigen::VectorXd* worth)>;

/// Nothing if even equal weights of all units leave the information singular.
[[nodiscard]] std::optional<ContinuousDesign> continuous_design(const WeightedCriterion& criterion,
                                                                std::size_t n_units, std::size_t n,
                                                                int most_steps);
[[nodiscard]] std::optional<ContinuousDesign> continuous_design(const UnitInformation& information,
                                                                const InformationCriterion& criterion,
                                                                std::size_t n);

/// The n units of largest weights, or of largest worth where those are all but 0.
[[nodiscard]] std::vector<std::size_t> weightiest(const ContinuousDesign& design, std::size_t n);

/// n different units, from the largest weights on by exchange until no exchange of one is better.
[[nodiscard]] std::vector<std::size_t> exchanged_design(const UnitInformation& information,
                                                        const InformationCriterion& criterion, std::size_t n,
                                                        const ContinuousDesign& start);

/// What these units and what is there already say together.
[[nodiscard]] Eigen::MatrixXd information_of(const UnitInformation& information, std::size_t draw,
                                             const std::vector<std::size_t>& units);

/// Mean criterion of units over the draws.
template <class Information>
[[nodiscard]] double mean_criterion(const Information& information, const InformationCriterion& criterion,
                                    const std::vector<std::size_t>& units) {
  double sum = 0;
  for (std::size_t k = 0; k < information.before.size(); ++k)
    sum += criterion.value(information_of(information, k, units));
  return sum / static_cast<double>(information.before.size());
}

}  // namespace shearfront::fit
