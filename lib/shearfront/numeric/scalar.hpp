// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "shearfront/numeric/multiprecision.hpp"

/// Scalar types of the engines.
///
/// Every engine is a template over one of three scalars: `double` is what users run, `Real50` (50 significant
/// decimal digits) is the oracle that shows what rounding does, and `Real110` serves printing of up to 100
/// digits. All three are binary, so scaling by powers of two is exact in each.
namespace shearfront {

template <class S>
concept Real = std::same_as<S, double> || std::same_as<S, Real50> || std::same_as<S, Real110>;

/// The nearest double. Exact for double.
template <Real S>
[[nodiscard]] double to_double(const S& x) {
  if constexpr (std::same_as<S, double>) {
    return x;
  } else {
    return x.template convert_to<double>();
  }
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
