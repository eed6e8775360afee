// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/shearfront.hpp"

/// Fits in one header:
///
///     const auto estimate = shearfront::fit::fit(shearfront::fit::read_fit("fit.toml"));
///     for (const auto& p : estimate.parameters) std::cout << p.name << ' ' << p.estimate << '\n';
///
/// Without files: fill in a FitSpec (fit/fit_spec.hpp). Link with shearfront::fit.
