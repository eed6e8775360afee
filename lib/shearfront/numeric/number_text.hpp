// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <charconv>
#include <ios>
#include <string>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Shortest decimal text that reads back to the same double ("0.31", "1e-300", "inf", "nan"). Locale-free.
[[nodiscard]] inline std::string number_text(double x) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr;
  return {buffer.data(), end};
}

/// Multiprecision: as many digits as the type guarantees.
template <Real S>
[[nodiscard]] std::string number_text(const S& x) {
  return x.str(std::numeric_limits<S>::digits10, std::ios_base::fmtflags{});
}

/// `digits` significant digits of a multiprecision number, trailing zeros kept.
template <Real S>
[[nodiscard]] std::string number_text(const S& x, int digits) {
  if constexpr (std::same_as<S, double>) {
    std::array<char, 400> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, std::chars_format::general, digits)
            .ptr;
    return {buffer.data(), end};
  } else {
    return x.str(digits, std::ios_base::showpoint);
  }
}

}  // namespace shearfront
