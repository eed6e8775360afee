// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <boost/random/sobol.hpp>
#include <cstdint>

#include "shearfront/fit/coordinates.hpp"

namespace shearfront::fit {

/// Points that fill the box of the parameters evenly: a Sobol sequence, shifted by the seed (modulo one), of
/// the logarithms of positive parameters and of the others themselves.
///
/// Guaranteed: inside the bounds; breaks in order; the shape kept (values sorted, the steps of a convex one
/// raised to zero); the same points for the same seed. A parameter without finite bounds stays within
/// max(unit, |start|) of its start.
/// Source: Sobol, USSR Comput. Math. Math. Phys. 7 (1967); shift: Cranley & Patterson, SIAM J. Numer. Anal.
/// 13 (1976).
class StartPoints {
 public:
  /// `widest`: positive parameters within this factor of the start, if the bounds are wider.
  StartPoints(const Coordinates& coordinates, const Eigen::VectorXd& start_u, std::uint64_t seed,
              double widest = 1e300);
  [[nodiscard]] Eigen::VectorXd next();  ///< coordinates u of the next point

 private:
  const Coordinates* coordinates_;
  Eigen::VectorXd lower_, upper_, shift_;  ///< in logarithms where positive
  boost::random::sobol sequence_;
};

}  // namespace shearfront::fit
