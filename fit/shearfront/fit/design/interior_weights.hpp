// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

#include "shearfront/fit/design/correlated_information.hpp"

namespace shearfront::fit {

/// The relaxed information M(a) of correlated_information.hpp, a_g = n w_g, as a function of the parts 0 <= a_g <= 1 of units.
struct RelaxedAt {
  double value = 0;        ///< mean criterion over the draws, +infinity where the information is singular
  Eigen::VectorXd slopes;  ///< d value / d a_g <= 0, of all units; empty at infinity
};
/// Units of part 0 cost nothing but their slope: m^3 / 3 + c m p flops, m rows of a part > 0 of c.
[[nodiscard]] RelaxedAt relaxed_at(const CorrelatedInformation& information,
                                   const InformationCriterion& criterion, double s,
                                   const Eigen::VectorXd& parts);

struct InteriorOptions {
  double first_gap = 1;     ///< about how far the start is from the least
  double tolerance = 1e-5;  ///< of the criterion
  int most_factors = 60;    ///< of covariances; what is found by then is returned
};
struct InteriorParts {
  Eigen::VectorXd parts;  ///< strictly between 0 and 1
  int factors = 0;        ///< that this took
};
/// The parts of the sum that those of `start` have, 0 < sum < units, with which the relaxed criterion is least: a primal-dual
/// interior point method with Newton's steps (Nocedal & Wright 2006, chapter 19). The value at `start` is finite.
/// Cost: some 20 factors of m rows, and for each m^3 flops, or m^2 p units where that is less.
[[nodiscard]] InteriorParts interior_parts(const CorrelatedInformation& information,
                                           const InformationCriterion& criterion, double s,
                                           const Eigen::VectorXd& start, const InteriorOptions& options);

}  // namespace shearfront::fit
