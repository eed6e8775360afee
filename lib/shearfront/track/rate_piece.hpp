// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "shearfront/track/flux_branches.hpp"

namespace shearfront {

/// How the rate r = s a runs inside a piece of the bed.
enum class RateCurve : std::uint8_t { constant, linear, exponential };

/// A part of the bed in which the rate r(z) = s a(z) has one formula: constant, r_low + bend (z - z_low), or
/// r_low exp(bend (z - z_low)), and one flux. The sign of the bend is that of the slope.
struct RatePiece {
  double z_low, z_high;
  double low, high;  ///< r at the ends, > 0
  RateCurve curve;
  double bend;
  std::shared_ptr<const FluxBranches> flux;  ///< g; none for 4 u (1 - u)

  /// A rate that hardly changes is constant: it moves fronts by less than rounding of the heights does.
  RatePiece(double from, double to, double rate_from, double rate_to, RateCurve how,
            std::shared_ptr<const FluxBranches> g = nullptr)
      : z_low(from), z_high(to), low(rate_from), high(rate_to), curve(how), bend(0), flux(std::move(g)) {
    constexpr double kLeastChange = 1e-12;
    const double rise = high - low;
    if (curve == RateCurve::constant || std::abs(rise) < kLeastChange * low) {
      curve = RateCurve::constant;
      high = low;
    } else if (curve == RateCurve::linear) {
      bend = rise / (z_high - z_low);
    } else {
      bend = log_ratio(low, high) / (z_high - z_low);
    }
  }

  [[nodiscard]] bool falls() const { return bend < 0; }
  [[nodiscard]] bool is_constant() const { return curve == RateCurve::constant; }
  /// At a height of the piece; at its ends to the bit.
  [[nodiscard]] double rate(double z) const {
    if (!(z < z_high)) return high;
    if (!(z > z_low) || is_constant()) return low;
    if (curve == RateCurve::exponential) return low * std::exp(bend * (z - z_low));
    // From the smaller end: there it would cancel.
    return high < low ? high + bend * (z - z_high) : low + bend * (z - z_low);
  }
  /// 4 H of u where the rate is `rate`, and u of the largest flux.
  [[nodiscard]] double carried(double rate, double u) const { return rate * relative_flux(flux.get(), u); }
  [[nodiscard]] double top() const { return top_of(flux.get()); }
  /// Where the rate, continued beyond the ends, is `r`. Precondition: it is not constant, r > 0.
  [[nodiscard]] double height_of(double r) const {
    if (curve == RateCurve::linear)
      return std::abs(r - low) < std::abs(r - high) ? z_low + (r - low) / bend : z_high + (r - high) / bend;
    const bool is_low_nearer = (r / low < high / r) == (low < high);  // in log r
    return is_low_nearer ? z_low + std::log(r / low) / bend : z_high + std::log(r / high) / bend;
  }
  /// log(b / a), without cancellation where they are near to each other.
  [[nodiscard]] static double log_ratio(double a, double b) {
    const double rise = b - a;
    return rise > -a / 2 && rise < a ? std::log1p(rise / a) : std::log(b / a);
  }
  /// int dz / r from z to y, both in the piece.
  [[nodiscard]] double pure_time(double z, double y) const {
    const double d = y - z, r = rate(z);
    if (is_constant()) return d / r;
    if (curve == RateCurve::linear) return log_ratio(r, rate(y)) / bend;
    return -std::expm1(-bend * d) / (bend * r);
  }
};

}  // namespace shearfront
