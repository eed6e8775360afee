// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {

/// Means over intervals: r = (M(hi, t) - M(lo, t)) / (hi - lo) - y. Continuous, with kinks where a shock
/// enters or leaves a bin. Exact for bins. Cumulative data: the mean between neighbouring heights of a time.
/// Point values are taken as the means between the midpoints to their neighbours.
struct BinMisfit {
  static constexpr std::string_view kName = "bin";
  static constexpr std::string_view kDescription = "means of phi over bins; continuous";
  static constexpr bool kIsSmooth = true;

  static std::string refusal(const Observations& observations) {
    if (observations.quantity == Quantity::bed_height) return "heights of the bed have no concentrations";
    if (observations.quantity == Quantity::bin) return "";
    for (const MeasuredProfile& profile : measured_profiles(observations))
      if (profile.rows.size() > 1) return "";
    return "needs two heights at the same time";
  }

  /// Moving means over `n` neighbouring bins of a time, gaps left out; nothing for times with fewer bins. Times with
  /// more than kFine bins have them every n / 4 bins, which is all they resolve: terms are linear in the bins.
  /// Precondition: bins.
  static constexpr std::size_t kFine = 256;
  static ResidualRows wide_rows(const Observations& observations, double bottom, double top, std::size_t n) {
    RowBuilder builder(observations, Observable::M);
    for (const MeasuredProfile& profile : measured_profiles(observations)) {
      const std::size_t stride = profile.rows.size() > kFine ? std::max<std::size_t>(1, n / 4) : 1;
      for (std::size_t first = 0; first + n <= profile.rows.size(); first += stride) {
        const std::size_t end = first + n;
        const auto edges = [&](std::size_t j) {
          const Observation& o = observations.rows[profile.rows[j]];
          return std::pair(std::max(bottom, o.z - o.width / 2), std::min(top, o.z + o.width / 2));
        };
        double width = 0;
        for (std::size_t j = first; j < end; ++j) width += edges(j).second - edges(j).first;
        for (std::size_t j = first; j < end; ++j) {
          const auto [lo, hi] = edges(j);
          builder.model(profile.t, hi, 1 / width);
          builder.model(profile.t, lo, -1 / width);
          builder.data(profile.rows[j], (hi - lo) / width);
        }
        builder.finish_row();
      }
    }
    return builder.take();
  }

  static ResidualRows rows(const Observations& observations, double bottom, double top) {
    RowBuilder builder(observations, Observable::M);
    const auto mean = [&](double t, double lo, double hi) {
      builder.model(t, hi, 1 / (hi - lo));
      builder.model(t, lo, -1 / (hi - lo));
    };
    if (observations.quantity == Quantity::bin) {
      for (std::size_t k = 0; k < observations.rows.size(); ++k) {
        const Observation& o = observations.rows[k];
        mean(o.t, std::max(bottom, o.z - o.width / 2), std::min(top, o.z + o.width / 2));
        builder.data(k, 1);
        builder.finish_row();
      }
      return builder.take();
    }
    for (const MeasuredProfile& profile : measured_profiles(observations)) {
      const auto z = [&](std::size_t j) { return observations.rows[profile.rows[j]].z; };
      const std::size_t n = profile.rows.size();
      for (std::size_t j = 0; n > 1 && j < n; ++j) {
        if (observations.quantity == Quantity::point) {
          const double lo = j > 0 ? (z(j - 1) + z(j)) / 2 : std::max(bottom, z(0) - (z(1) - z(0)) / 2);
          const double hi =
              j + 1 < n ? (z(j) + z(j + 1)) / 2 : std::min(top, z(n - 1) + (z(n - 1) - z(n - 2)) / 2);
          mean(profile.t, lo, hi);
          builder.data(profile.rows[j], 1);
        } else {
          if (j == 0) continue;
          mean(profile.t, z(j - 1), z(j));
          builder.data(profile.rows[j], 1 / (z(j) - z(j - 1)));
          builder.data(profile.rows[j - 1], -1 / (z(j) - z(j - 1)));
        }
        builder.finish_row();
      }
    }
    return builder.take();
  }
};

}  // namespace shearfront::fit
