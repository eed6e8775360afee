// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A sum of terms m exp(e) whose exponentials may overflow or underflow: kept as mantissa * exp(exponent),
/// the exponent being the largest met so far. Domain: finite m and e.
/// Guarantee: each term is relatively exact to (3 + |e - exponent|) units of roundoff. Cost: one exp per
/// term.
template <Real S>
class ScaledSum {
 public:
  void add(const S& mantissa, const S& exponent) {
    using std::exp;
    if (is_empty_) {
      mantissa_ = mantissa;
      exponent_ = exponent;
      is_empty_ = false;
    } else if (exponent <= exponent_) {
      mantissa_ += mantissa * exp(S(exponent - exponent_));
    } else {
      mantissa_ = mantissa_ * exp(S(exponent_ - exponent)) + mantissa;
      exponent_ = exponent;
    }
  }
  [[nodiscard]] const S& mantissa() const { return mantissa_; }
  [[nodiscard]] const S& exponent() const { return exponent_; }
  /// Whether a term with this exponent is `depth` below the largest one.
  [[nodiscard]] bool drowns(const S& exponent, const S& depth) const {
    return !is_empty_ && exponent < exponent_ - depth;
  }
  /// (this sum) / other; 0 where it underflows.
  [[nodiscard]] S over(const ScaledSum& other) const {
    using std::exp;
    return mantissa_ / other.mantissa_ * exp(S(exponent_ - other.exponent_));
  }

 private:
  S mantissa_{0}, exponent_{0};
  bool is_empty_ = true;
};

}  // namespace shearfront
