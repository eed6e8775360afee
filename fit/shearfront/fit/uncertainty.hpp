// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fit/bootstrap.hpp"
#include "shearfront/fit/profile_likelihood.hpp"

namespace shearfront::fit {

/// What [uncertainty] of a fit file asks for and cannot be had. Errors: InputError (uncertainty.profile):
/// with a shape the coordinates are steps between the values, whose profiles say nothing about a single
/// value.
void check_uncertainty(const FitSpec& spec);

/// Adds profile-likelihood and bootstrap intervals and their warnings to a usable estimate, as far as
/// spec.uncertainty asks for them; nothing if the search was interrupted.
void add_uncertainty(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                     const Refit& refit, const Progress& progress, Estimate& estimate);

}  // namespace shearfront::fit
