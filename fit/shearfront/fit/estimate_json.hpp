// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/fit/estimate.hpp"

namespace shearfront::fit {

/// {"name","method","algorithm","quantity","loss","parameters":[{"name","start","estimate","std_error",
/// "ci95":[lo,hi],"at_bound"}],"misfit","residual_norm","sigma",...}: the keys are described in docs/formats.
///
/// Doubles are written with the shortest text that reads back to the same number; what is not known, or not a
/// finite number, is null. Every line begins with `indent`, the last one ends without a line break.
[[nodiscard]] std::string estimate_json(const Estimate& estimate, const std::string& indent = "");

}  // namespace shearfront::fit
