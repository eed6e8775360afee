// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <ios>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Shortest decimal text that reads back to the same double ("0.31", "1e-300", "inf", "nan"). Locale-free.
[[nodiscard]] std::string number_text(double x);

/// `digits` significant digits; of a multiprecision number with trailing zeros.
[[nodiscard]] std::string number_text(double x, int digits);

/// A double at the beginning of a text, as std::from_chars reads it; value is 0 where there is an error.
struct ReadNumber {
  double value = 0;
  std::size_t length = 0;  ///< of what was read
  std::errc error{};       ///< invalid_argument: no number; result_out_of_range: too large, or too near to 0
};
/// Locale-free and rounded to nearest. Where the standard library cannot (libc++ before 20) fast_float does.
[[nodiscard]] ReadNumber read_number(std::string_view text);

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
