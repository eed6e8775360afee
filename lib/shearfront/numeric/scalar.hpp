// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <limits>
#include <type_traits>

/// Scalar types of the engines.
///
/// Every engine is a template over a binary floating-point scalar: `double` is what users run, a multiprecision number
/// (digits/real110.hpp) prints many digits and is the oracle that shows what rounding does. Both are binary, so
/// scaling by powers of two is exact in each.
namespace shearfront {

template <class S>
concept Real = std::numeric_limits<S>::is_specialized && !std::numeric_limits<S>::is_integer &&
               std::numeric_limits<S>::radix == 2 && std::numeric_limits<S>::digits >= 53;

/// The nearest double. Exact for double.
template <Real S>
[[nodiscard]] double to_double(const S& x) {
  return static_cast<double>(x);
}

template <Real S>
[[nodiscard]] bool is_finite(const S& x) {
  return x - x == S(0);  // NaN for infinities and NaN
}

/// +infinity of the scalar.
template <Real S>
[[nodiscard]] S infinity() {
  return std::numeric_limits<S>::infinity();
}

/// Unit roundoff of the scalar, 2^-p.
template <Real S>
[[nodiscard]] S unit_roundoff() {
  return std::numeric_limits<S>::epsilon() / S(2);
}

}  // namespace shearfront
