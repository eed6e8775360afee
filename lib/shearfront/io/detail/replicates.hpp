// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/solution/observation.hpp"

/// Several values at one place: the same t, z and width.
namespace shearfront::detail {

/// A row at the place of an earlier one.
struct RepeatedPlace {
  std::size_t row, first;
};
/// By place; rows of one place in their order. Cost: O(n) for rows in ascending order of t, z and width, else O(n log n).
[[nodiscard]] std::vector<RepeatedPlace> repeated_places(const std::vector<Observation>& rows);

struct Means {
  std::vector<std::size_t> kept;  ///< where the rows that are left stood, ascending
  double spread = 0;
};
/// Puts the mean of the values at one place where the first of them stood. Their spread, pooled over all places (the root
/// of the sum of squares about the means over the degrees of freedom), is that of one value: at one place there are too
/// few to tell. Where it is not 0, sigma of a mean of n values becomes spread / sqrt(n). Equal values have a mean to the
/// bit, and no spread. A spread that is no finite number leaves the rows as they are.
[[nodiscard]] Means average_replicates(std::vector<Observation>& rows);

}  // namespace shearfront::detail
