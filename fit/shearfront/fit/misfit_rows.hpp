// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/residual_rows.hpp"

/// What observations are compared as, and in which unit.
namespace shearfront::fit {

/// Rows in units of sigma, or of the data whatever they are compared as: weights take sigma = 1 of theirs.
[[nodiscard]] ResidualRows with_unit(ResidualRows rows, const FitSpec& spec, const Parameters& parameters);

/// The rows of a misfit of the list, with_unit(). Errors: InputError (key "misfit.quantity") for one that is not in the list
/// or refuses the observations.
[[nodiscard]] ResidualRows rows_of(std::string_view quantity, const FitSpec& spec,
                                   const Parameters& parameters);

/// Residuals beside `size`, which has their unit.
void set_size(ResidualRows& rows, double size);

/// Mean distance of neighbouring heights of one time.
[[nodiscard]] double mean_spacing(const Observations& observations);

}  // namespace shearfront::fit
