// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fit/estimate.hpp"
#include "shearfront/io/detail/json.hpp"

namespace shearfront::fit {

/// {"name","method","algorithm","quantity","loss","parameters":[{"name","start","estimate","std_error",
/// "ci95":[lo,hi],"at_bound"}],"misfit","residual_norm","sigma",...}: the keys are described in docs/reference/formats. What is not
/// known, or not a finite number, is null.
[[nodiscard]] detail::Json to_json(const Estimate& estimate);

}  // namespace shearfront::fit
