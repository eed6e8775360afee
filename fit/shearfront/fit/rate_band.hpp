// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// s a at a height, with its 95 % interval: its ends are equal where no unknown has a part in s a; empty
/// where one that has no error bar has.
struct RateRow {
  double z = 0, a = 0;
  std::optional<Interval> band;
  std::optional<Interval> everywhere;  ///< the band that holds at all heights at once; empty in the start
};

/// Where an interface lies with 95 %, and the span of s a on both sides of it.
struct InterfaceBand {
  Interval z, a;
};

/// s a(z) of an estimate with two 95 % bands: that of each height by itself, and the wider one that holds at all heights at
/// once. By linear propagation of the covariance of the parameters to log(s a(z)):
///
///     band = s a exp(-+ q sqrt(g^T C g)),   g_i = d log(s a) / d p_i,   C_ij = corr_ij se_i se_j,
///
/// where q is the quantile behind the confidence intervals of the estimate. After a bootstrap: between the 2.5 % and the
/// 97.5 % quantile of s a over its replicates. For a layer with its own unknown this is the interval of that unknown.
/// The band of all heights is the same with log(s a) stretched by one factor: the 95 % quantile of the largest deviation over
/// the rows in half-widths of the band, over the replicates or over kBandDraws draws from C (so known to 1 %).
/// Unknown interfaces have no part in either; they have bands of their own. Layers have a row at each end, other beds 201
/// rows and one at each knot.
struct RateBand {
  static constexpr std::size_t kBandDraws = 10000;
  std::vector<RateRow> rows, start;  ///< of the estimate; of the start of the search, without bands
  std::vector<InterfaceBand> interfaces;
  bool is_unknown = false;       ///< whether anything about a or s was
  std::size_t n_replicates = 0;  ///< of the bootstrap behind the band; 0: linear propagation
  double stretch = 1;            ///< of the band at all heights
};

/// s a(z) of a scene, in the same rows, without bands.
[[nodiscard]] std::vector<RateRow> rate_rows(const Scene<double>& scene);

[[nodiscard]] RateBand rate_band(const Parameters& parameters, const Estimate& estimate);

}  // namespace shearfront::fit
