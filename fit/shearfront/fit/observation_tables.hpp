// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/observations_csv.hpp"

namespace shearfront::fit {

/// Reads the tables [columns] and [format] of a fit file: how its observations are written, where that is not to be found
/// out. What is wrong goes into the report of `root`, or to `refuse`, which knows where entries stand.
void read_observation_format(detail::TableReader& root, const std::function<void(Complaint)>& refuse,
                             ObservationFormat& format);

}  // namespace shearfront::fit
