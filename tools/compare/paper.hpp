// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>

#include "compare/race.hpp"

namespace shearfront::tools {

/// Tables 1 and 2 of Buerger, Martinez & Villada (2023), "Front tracking ... a model of segregation", as
/// printed there, beside our numbers for the same scene (their Example 1): the event times and L1 errors of
/// front tracking on their singular-mapping grid with steps of a of 4 delta, which reproduces their event
/// times, and on the grid of levels with steps of phi of 4 delta; and the consistent Engquist-Osher scheme on
/// as many cells. Their seconds are MATLAB's, of 2023.
[[nodiscard]] std::string paper_text(const RaceLimits& limits);

}  // namespace shearfront::tools
