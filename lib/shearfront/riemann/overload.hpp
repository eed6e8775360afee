// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// Why a bed of monotone fluxes cannot pass on what comes, with the height; empty if it can.
///
/// All waves of such a bed go one way, and an interface passes on the flux it is given. So the fluxes at a height lie
/// between the least and the largest that begin on the way there or come in at the end; each layer must have states for
/// them all. Where a, c or T are smooth, their least and largest values between two knots count. Precondition: the fluxes
/// have no extremum and go the same way. Cost: O(knots + jumps).
[[nodiscard]] std::string overload(const Scene<double>& scene);

}  // namespace shearfront
