// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/fv/section.hpp"

namespace shearfront::fv {

/// Which cells step how much longer than the fastest: 2^octave times, the most that their rates and widths
/// allow. A run of cells with a faster neighbour has at least kLanes cells for each of the two borders:
/// shorter ones join the faster neighbour. Octaves are limited so that one step of the slowest cells is no
/// more than about 2^28 cell updates. Empty if all cells have the same. Cost: O(cells).
[[nodiscard]] std::vector<int> octaves_of(const CellData& data);

}  // namespace shearfront::fv
