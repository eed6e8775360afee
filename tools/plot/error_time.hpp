// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "compare/race.hpp"

namespace shearfront::tools {

/// L1 error against wall time, both logarithmic, one panel per time and one line per method. Returns an exit
/// code: without gnuplot one line on standard error and kDone.
int draw_error_time(const std::string& path, std::string_view scene, const std::vector<Panel>& panels);

}  // namespace shearfront::tools
