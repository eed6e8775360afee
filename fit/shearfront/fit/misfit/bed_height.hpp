// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {

/// Heights of the bed: r = H(t) - y. Smooth in every parameter but where two shocks meet. Exact for data of
/// this kind; no other data say anything about the height.
struct BedHeightMisfit {
  static constexpr std::string_view kName = "bed-height";
  static constexpr std::string_view kDescription =
      "height of the bed, lower where the grains are mixed; smooth";
  static constexpr bool kIsSmooth = true;

  static std::string refusal(const Observations& observations) {
    return observations.quantity == Quantity::bed_height ? "" : "needs heights of the bed (column H)";
  }
  static ResidualRows rows(const Observations& observations, double /*bottom*/, double /*top*/) {
    RowBuilder builder(observations, Observable::bed_height);
    for (std::size_t k = 0; k < observations.rows.size(); ++k) builder.row_of(k);
    return builder.take();
  }
};

}  // namespace shearfront::fit
