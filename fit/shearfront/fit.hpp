// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/posterior.hpp"
#include "shearfront/shearfront.hpp"

/// Fits in one header:
///
///     const auto estimate = shearfront::fit::fit(shearfront::fit::read_fit("fit.toml"));
///     for (const auto& p : estimate.parameters) std::cout << p.name << ' ' << p.estimate << '\n';
///
/// Without files: fill in a FitSpec (fit/fit_spec.hpp). What data and priors together say, for samplers: Posterior
/// (fit/posterior.hpp). Link with shearfront::fit.
namespace shearfront::fit {

/// Finds the unknown entries of a scene from observations: the minimum of sum rho(r_i^2) / 2 over the box of
/// their bounds, with error bars and with warnings where the data do not say what is asked.
///
/// Defaults that follow from the data: quantity = that of the observations; loss = squared, for point data
/// huber; point data with a search that uses derivatives in two stages: sums over z first (smooth in the
/// parameters), then the points that no shock is near (rows_without_jumps; all with diffusion, which has no
/// shocks), renewed until the estimate stays.
/// Noise: sigma of the observations, otherwise estimated from the residuals, for robust losses by their
/// median absolute value. Guaranteed: the outcome is a Status with a message; an unusable estimate carries no
/// numbers. The same input gives the same numbers to the bit, whatever the number of threads.
/// Errors: InputError for what holds between entries of the specification (keys as in a fit file).
/// Cost: evaluations x one run of the forward model; exact engine, 2000 observations: about 1 ms each.
[[nodiscard]] Estimate fit(const FitSpec& spec, const Progress& progress = {});

/// What a fit compares and how residuals count: names of MisfitList and LossList, defaults resolved.
[[nodiscard]] std::string_view quantity_of(const FitSpec& spec);
[[nodiscard]] std::string_view loss_of(const FitSpec& spec);

}  // namespace shearfront::fit
