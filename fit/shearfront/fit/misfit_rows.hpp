// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
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

/// Why [noise] does not go with what is compared; empty if it does.
[[nodiscard]] std::string noise_refusal(const FitSpec& spec, const ResidualRows& rows);

/// Places of the noise of these rows. Precondition: noise_refusal() is empty.
[[nodiscard]] std::shared_ptr<const NoisePlaces> noise_places(const FitSpec& spec, const ResidualRows& rows);

/// Residuals beside `size`, which has their unit.
void set_size(ResidualRows& rows, double size);

/// Mean distance of neighbouring heights of one time.
[[nodiscard]] double mean_spacing(const Observations& observations);

}  // namespace shearfront::fit
