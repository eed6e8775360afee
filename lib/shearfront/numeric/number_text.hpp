// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <ios>
#include <limits>
#include <string>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Shortest decimal text that reads back to the same double ("0.31", "1e-300", "inf", "nan"). Locale-free.
[[nodiscard]] std::string number_text(double x);

/// `digits` significant digits; of a multiprecision number with trailing zeros.
[[nodiscard]] std::string number_text(double x, int digits);

/// Multiprecision: as many digits as the type guarantees, or `digits` of them.
template <Real S>
[[nodiscard]] std::string number_text(const S& x) {
  return x.str(std::numeric_limits<S>::digits10, std::ios_base::fmtflags{});
}
template <Real S>
[[nodiscard]] std::string number_text(const S& x, int digits) {
  return x.str(digits, std::ios_base::showpoint);
}

}  // namespace shearfront
