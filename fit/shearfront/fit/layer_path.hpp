// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <map>

#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/run_control.hpp"

namespace shearfront::fit {

/// Starts of fits of 1 to `most` layers whose breaks are unknown, built from the data: each is where a search has ended lowest among
///   - layers equally thick, the rates those of the scene;
///   - the best with one layer fewer, one of them split in two, at a quarter, at half or at three quarters of it, where a linear estimate
///     promises most: with r the residuals, J their Jacobian and c their derivative by the logarithm of the rate in a part of a layer,
///     (r . c')^2 / |c'|^2, c' what of c is normal to all columns of J. A step of all parts at once tells it of all of them;
///   - afterwards, from the most layers down, the best with one layer more, two neighbours made one.
/// A search for many breaks at once ends in the nearest of many valleys: each layer that is split well is one fewer to be found.
/// Numbers of layers for which no search has ended are left out. Precondition: the forward model has exact derivatives for them
/// (has_layer_path()). Cost: some six searches for each number of layers.
[[nodiscard]] std::map<std::size_t, FitSpec> layer_path(const FitSpec& base, const ModelChoice& choice,
                                                        std::size_t most, const Progress& progress);

/// Whether derivatives of the predictions by layers are exact.
[[nodiscard]] bool has_layer_path(const FitSpec& base, const ModelChoice& choice);

}  // namespace shearfront::fit
