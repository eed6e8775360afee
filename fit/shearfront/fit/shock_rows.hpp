// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// Point observations that no jump of phi is near: keep[k] for observation k.
///
/// The interval of an observation reaches to the midpoints to its neighbours in z at the same time (alone at
/// its time: it is kept). It contains a jump if phi changes within two of its kParts parts by more than kJump
/// and kSteeper times as much as in the median of such pairs. A shock moving over the height of an
/// observation changes it by a finite amount at once, which no derivative tells, and at a jump of a(z)
/// neither data nor grids tell on which side they are; away from jumps phi is differentiable in the
/// parameters. `progress` is asked as by Forward; if it ends the runs, all are kept. Cost: two runs of the forward model.
[[nodiscard]] std::vector<bool> rows_without_jumps(const Parameters& parameters, const ForwardSpec& forward,
                                                   const Observations& observations,
                                                   const Eigen::VectorXd& values,
                                                   const shearfront::Progress& progress = {});

}  // namespace shearfront::fit
