// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {

/// Point values: r = phi(z, t) - y. Not smooth: a row jumps when a shock passes its place, so searches with
/// derivatives need a start close by (two stages, FitSpec). Bins are taken as points at their middle, which
/// is wrong by their curvature and at shocks.
struct PointMisfit {
  static constexpr std::string_view kName = "point";
  static constexpr std::string_view kDescription = "phi at single heights; jumps when a shock passes";
  static constexpr bool kIsSmooth = false;

  /// Why these data cannot be compared in this way; empty if they can.
  static std::string refusal(const Observations& observations) {
    if (observations.quantity == Quantity::bed_height) return "heights of the bed have no concentrations";
    return observations.quantity == Quantity::cumulative ? "cumulative data have no point values; use bin"
                                                         : "";
  }
  static ResidualRows rows(const Observations& observations, double /*bottom*/, double /*top*/) {
    RowBuilder builder(observations, Observable::phi);
    for (std::size_t k = 0; k < observations.rows.size(); ++k) builder.row_of(k);
    return builder.take();
  }
};

}  // namespace shearfront::fit
