// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/lowest_bed.hpp"

#include <algorithm>
#include <cstddef>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {
namespace {

std::vector<double> equally_spaced(double first, double last, std::size_t n) {
  std::vector<double> xs(n);
  for (std::size_t i = 0; i < n; ++i)
    xs[i] = first + (last - first) * (static_cast<double>(i) / static_cast<double>(n - 1));
  return xs;
}

}  // namespace

std::optional<LowestBed> lowest_bed(const BedHeights& heights, double t_end) {
  SHEARFRONT_EXPECTS(t_end > 0 && t_end < infinity<double>(), "a time");
  constexpr std::size_t kFirst = 65, kNext = 17;
  constexpr double kNarrow = 1e-8;
  double first = 0, last = t_end;
  std::optional<LowestBed> lowest;
  for (std::size_t n = kFirst; last - first > kNarrow * t_end; n = kNext) {
    const std::vector<double> times = equally_spaced(first, last, n), found = heights(times);
    if (found.empty()) return std::nullopt;
    const auto i = static_cast<std::size_t>(std::min_element(found.begin(), found.end()) - found.begin());
    if (!lowest || found[i] < lowest->height) lowest = LowestBed{times[i], found[i]};
    first = times[i == 0 ? 0 : i - 1];
    last = times[std::min(i + 1, n - 1)];
  }
  return lowest;
}

}  // namespace shearfront
