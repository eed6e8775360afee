// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <concepts>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Sum and rounding error of one addition: a + b == high + low exactly (Knuth 1969, TwoSum).
/// Domain: finite operands whose sum does not overflow. Cost: 6 additions. Needs -ffp-contract=off.
template <Real S>
struct TwoSum {
  S high, low;
  TwoSum(const S& a, const S& b) : high(a + b) {
    const S bb = high - a;
    low = (a - (high - bb)) + (b - bb);
  }
};

/// Product and rounding error of one multiplication: a b == high + low exactly for double (one fused
/// multiply-add), with low = 0 for the other scalars. Domain: no overflow and no underflow of low.
template <Real S>
struct TwoProduct {
  S high, low{0};
  TwoProduct(const S& a, const S& b) : high(a * b) {
    if constexpr (std::same_as<S, double>) low = std::fma(a, b, -high);
  }
};

/// Running sum with error feedback (Neumaier 1974): the error of value() is at most
/// 2 u |sum| + O(n u^2) sum |x|.
template <Real S>
class CompensatedSum {
 public:
  CompensatedSum& operator+=(const S& x) {
    const TwoSum<S> s(sum_, x);
    sum_ = s.high;
    low_ += s.low;
    return *this;
  }
  [[nodiscard]] S value() const { return sum_ + low_; }
  /// The sum in twice the digits.
  [[nodiscard]] TwoSum<S> parts() const { return {sum_, low_}; }

 private:
  S sum_{0}, low_{0};
};

}  // namespace shearfront
