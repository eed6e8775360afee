// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "shearfront/fit/fit_file.hpp"
#include "shearfront/io/detail/toml_source.hpp"

namespace shearfront::fit {

/// Reads the table [compare] of a fit file: layers = [1, 2, 3], models = ["exponential", "table:6"], breaks = "free". What
/// is wrong goes into the report of the table, or to `add`, which knows where entries stand.
[[nodiscard]] ModelChoice read_model_choice(detail::TableReader& table,
                                            const std::function<void(Complaint)>& add);

}  // namespace shearfront::fit
