// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>

#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {

/// Running integrals: r = M(z, t) - y. The smoothest of the three: M has a continuous derivative in every
/// parameter except where two paths tie. Exact for cumulative data and for bins (the integral over the bins
/// so far of a time, gaps left out); point values are summed by the trapezoidal rule from the lowest height
/// upwards, which is wrong by about half the spacing times the jump at each shock.
struct CumulativeMisfit {
  static constexpr std::string_view kName = "cumulative";
  static constexpr std::string_view kDescription = "running integral M of phi; smooth";
  static constexpr bool kIsSmooth = true;

  static std::string refusal(const Observations& observations) {
    if (observations.quantity == Quantity::bed_height) return "heights of the bed have no concentrations";
    if (observations.quantity != Quantity::point) return "";
    for (const MeasuredProfile& profile : measured_profiles(observations))
      if (profile.rows.size() > 1) return "";
    return "needs two heights at the same time";
  }

  static ResidualRows rows(const Observations& observations, double bottom, double top) {
    RowBuilder builder(observations, Observable::M);
    for (const MeasuredProfile& profile : measured_profiles(observations)) {
      if (observations.quantity == Quantity::bin)
        add_bins(builder, observations, profile, bottom, top);
      else if (observations.quantity == Quantity::point)
        add_trapezoids(builder, observations, profile);
      else
        for (const std::size_t k : profile.rows) builder.row_of(k);
      builder.end_sum();
    }
    return builder.take();
  }

 private:
  /// Neighbouring bins share an edge, whose terms cancel.
  static void add_bins(RowBuilder& builder, const Observations& observations, const MeasuredProfile& profile,
                       double bottom, double top) {
    for (const std::size_t k : profile.rows) {
      const Observation& o = observations.rows[k];
      const double lo = std::max(bottom, o.z - o.width / 2), hi = std::min(top, o.z + o.width / 2);
      builder.model(profile.t, hi, 1);
      builder.model(profile.t, lo, -1);
      builder.data(k, hi - lo);
      builder.finish_row_of_sum();
    }
  }
  static void add_trapezoids(RowBuilder& builder, const Observations& observations,
                             const MeasuredProfile& profile) {
    for (std::size_t j = 1; j < profile.rows.size(); ++j) {
      const std::size_t below = profile.rows[j - 1], above = profile.rows[j];
      const double lo = observations.rows[below].z, hi = observations.rows[above].z;
      builder.model(profile.t, hi, 1);
      builder.model(profile.t, lo, -1);
      builder.data(below, (hi - lo) / 2);
      builder.data(above, (hi - lo) / 2);
      builder.finish_row_of_sum();
    }
  }
};

}  // namespace shearfront::fit
