// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/parameters.hpp"

namespace shearfront::tools {

/// What is known about s a at one height.
enum class RateKind {
  known,   ///< no unknown has a part in it
  banded,  ///< all unknowns that have a part in it have error bars
  open     ///< one of them has none
};

/// s a(z) between two heights: a constant, or a curve sampled at several.
struct RatePiece {
  RateKind kind = RateKind::known;
  std::vector<double> z, rate, low, high;  ///< 95 % band; low = high = rate unless banded
};

/// Where an interface lies with 95 %.
struct BreakBand {
  std::size_t index = 0;
  fit::Interval interval;
};

/// s a(z) of an estimate with its pointwise 95 % band, by linear propagation of the covariance of the
/// parameters to log(s a(z)):
///
///     band = s a exp(-+ q sqrt(g^T C g)),   g_i = d log(s a) / d p_i,   C_ij = corr_ij se_i se_j,
///
/// where q is the quantile behind the confidence intervals of the estimate. For a layer with its own
/// unknown this is the confidence interval of that unknown. Unknown breaks of a layered a(z) have no part in
/// it; they have bands of their own. Table and exponential: sampled; layered: one piece per layer.
class RateBand {
 public:
  RateBand(const fit::FitSpec& spec, const fit::Estimate& estimate);

  [[nodiscard]] const std::vector<RatePiece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<BreakBand>& breaks() const { return breaks_; }
  [[nodiscard]] bool has(RateKind kind) const;
  /// Whether anything about a(z) or s was unknown.
  [[nodiscard]] bool is_unknown() const;
  /// s a(z) at the start of the search, bottom to top.
  [[nodiscard]] const RatePiece& start() const { return start_; }
  [[nodiscard]] bool is_layered() const { return is_layered_; }

 private:
  struct At {
    RateKind kind = RateKind::known;
    double rate = 0, low = 0, high = 0;
  };
  [[nodiscard]] At at(double z) const;
  void add_piece(const At& at, std::vector<double> z);
  void add_layers();
  void add_curve();
  void add_breaks();
  void set_start();

  const fit::Estimate& estimate_;
  fit::Parameters parameters_;
  Eigen::VectorXd values_;
  double quantile_ = 1.96;
  bool is_layered_;
  std::vector<RatePiece> pieces_;
  std::vector<BreakBand> breaks_;
  RatePiece start_;
};

}  // namespace shearfront::tools
