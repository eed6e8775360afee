// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {

/// Copy this file to misfit/<name>.hpp, rename the struct, and add one line to misfit/all.hpp. Say here: what
/// is compared, where it is smooth, for which data it is exact. This copy compares point values.
struct SkeletonMisfit {
  static constexpr std::string_view kName = "skeleton";  ///< misfit.quantity in fit files
  static constexpr std::string_view kDescription = "phi at single heights";
  static constexpr bool kIsSmooth = false;

  /// Why these data cannot be compared in this way; empty if they can.
  static std::string refusal(const Observations& observations) {
    return observations.quantity == Quantity::point ? "" : "needs point data";
  }
  static ResidualRows rows(const Observations& observations, double /*bottom*/, double /*top*/) {
    RowBuilder builder(observations, Observable::phi);
    for (std::size_t k = 0; k < observations.rows.size(); ++k) builder.row_of(k);
    return builder.take();
  }
};

}  // namespace shearfront::fit
