// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <vector>

namespace shearfront {

/// When a bed is lowest: the time at which its grains are mixed best.
struct LowestBed {
  double t = 0, height = 0;
};

/// The heights of a bed at some times, ascending; empty if they cannot be computed.
using BedHeights = std::function<std::vector<double>(const std::vector<double>& times)>;

/// The least height in [0, t_end], t_end > 0 and finite: the lowest of 65 equally spaced times, then of 17
/// between its neighbours, and so on.
///
/// Guarantee: the height is within rounding of a local minimum that is the least one seen at the 65 times; t
/// is as exact as the heights tell, about t_end sqrt(error of H). Where the height stays the same (a bed that
/// never mixes) t is the first such time. Nothing if the heights cannot be computed. Cost: about 7 calls.
[[nodiscard]] std::optional<LowestBed> lowest_bed(const BedHeights& heights, double t_end);

}  // namespace shearfront
