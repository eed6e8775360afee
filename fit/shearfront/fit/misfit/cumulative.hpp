// SPDX-License-Identifier: BSD-3-Clause
#pragma once
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
    if (observations.quantity != Quantity::point) return "";
    for (const MeasuredProfile& profile : measured_profiles(observations))
      if (profile.rows.size() > 1) return "";
    return "needs two heights at the same time";
  }

  static ResidualRows rows(const Observations& observations, double bottom, double top) {
    RowBuilder builder(observations, Field::M);
    for (const MeasuredProfile& profile : measured_profiles(observations)) {
      for (std::size_t j = 0; j < profile.rows.size(); ++j) {
        if (observations.quantity == Quantity::point && j == 0) continue;
        if (observations.quantity == Quantity::cumulative) {
          const std::size_t k = profile.rows[j];
          builder.model(profile.t, observations.rows[k].z, 1);
          builder.data(k, 1);
        } else if (observations.quantity == Quantity::bin) {
          add_bins(builder, observations, profile, j, bottom, top);
        } else {
          add_trapezoids(builder, observations, profile, j);
        }
        builder.finish_row();
      }
    }
    return builder.take();
  }

 private:
  /// Neighbouring bins share an edge, whose terms cancel.
  static void add_bins(RowBuilder& builder, const Observations& observations, const MeasuredProfile& profile,
                       std::size_t last, double bottom, double top) {
    for (std::size_t i = 0; i <= last; ++i) {
      const Observation& o = observations.rows[profile.rows[i]];
      const double lo = std::max(bottom, o.z - o.width / 2), hi = std::min(top, o.z + o.width / 2);
      builder.model(profile.t, hi, 1);
      builder.model(profile.t, lo, -1);
      builder.data(profile.rows[i], hi - lo);
    }
  }
  static void add_trapezoids(RowBuilder& builder, const Observations& observations,
                             const MeasuredProfile& profile, std::size_t last) {
    const auto z = [&](std::size_t j) { return observations.rows[profile.rows[j]].z; };
    builder.model(profile.t, z(last), 1);
    builder.model(profile.t, z(0), -1);
    for (std::size_t i = 0; i <= last; ++i) {
      const double width = (i < last ? z(i + 1) - z(i) : 0) + (i > 0 ? z(i) - z(i - 1) : 0);
      builder.data(profile.rows[i], width / 2);
    }
  }
};

}  // namespace shearfront::fit
