// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

/// What a search found, with error bars, predictions and warnings.
[[nodiscard]] Estimate report(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                              const SearchResult& found);

}  // namespace shearfront::fit
