// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <optional>

#include "shearfront/fit/objective.hpp"

namespace shearfront::fit {

/// Where the misfit stays the same when one coordinate moves: an unknown break inside a bin that nothing passes, or a
/// rate above all observations. At the edge of such a flat the derivative to one side is 0, to the other it is not.

/// A point on the other side of a flat that has a smaller misfit: of the coordinates whose column of the Jacobian is
/// rounding, each moved by kFirstReach, 4 kFirstReach, ... either way up to its bounds. Nothing if there is none.
/// Cost: about 14 runs for each of them.
[[nodiscard]] std::optional<Eigen::VectorXd> beyond_flat(Objective& objective, const Eigen::VectorXd& u);

/// How far coordinate j may move down and up until the misfit changes, found to kFlatEnd of its unit; 0 where it
/// changes at once, infinite where it does not before the bound or kWidestReach. Cost: up to 20 runs each.
struct Flat {
  double down = 0, up = 0;
};
[[nodiscard]] Flat flat_around(const Objective& objective, const Eigen::VectorXd& u, Eigen::Index j);

inline constexpr double kFirstReach = 1e-3, kFlatEnd = 1e-3, kWidestReach = 4;

}  // namespace shearfront::fit
