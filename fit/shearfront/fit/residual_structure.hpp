// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/solution/observation.hpp"

namespace shearfront::fit {

/// Whether what a fit leaves looks like independent noise. Empty if it cannot be told: fewer than kFewest
/// residuals in neighbouring pairs, or residuals at rounding level.
[[nodiscard]] std::optional<ResidualStructure> residual_structure(const Observations& observations,
                                                                  const std::vector<double>& predicted);

}  // namespace shearfront::fit
