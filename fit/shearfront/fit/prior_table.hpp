// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/io/detail/toml_source.hpp"

namespace shearfront::fit {

/// The table [prior] of a fit file, if it has one: shear_rate.values = { lognormal = [1, 0.5] }, or with quotes
/// "shear_rate.values[0]" = { normal = [2.4, 0.1] }. What is wrong with it goes into the report.
[[nodiscard]] std::vector<Prior> read_priors(const detail::TomlSource& source,
                                             detail::ComplaintReport& report);

/// Complains of priors of what is no unknown, or has two.
void check_priors(const std::vector<Prior>& priors, const Parameters& parameters,
                  const detail::TomlSource& source, detail::ComplaintReport& report);

}  // namespace shearfront::fit
