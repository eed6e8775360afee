// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "shearfront/io/text.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Numbers of a TOML file, read from their text: in Real110 "0.31" is the decimal 0.31 and not its double.
namespace shearfront::detail {

/// A decimal number without its decoration: 0.significand * 10^exponent.
struct Decimal {
  bool negative = false;
  std::string significand;  ///< no leading zeros; empty for zero; at most kMostDigits digits
  long long exponent = 0;
};

/// More digits than any scalar distinguishes are cut off.
inline constexpr std::size_t kMostDigits = 400;

/// Takes a decimal TOML integer or float apart; nothing if the text is something else (0x1f, inf, a date).
[[nodiscard]] std::optional<Decimal> parse_decimal(std::string_view literal);

/// Whether the number fits into a double: 0, or between the smallest and the largest double in size.
/// The same limits hold for every scalar, so a file is valid or not whatever it is read in.
[[nodiscard]] bool fits_double(const Decimal& number);

/// The nearest number of the scalar. Precondition: fits_double(number).
template <Real S>
[[nodiscard]] S value_of(const Decimal& number) {
  if (number.significand.empty()) return number.negative ? -S(0) : S(0);
  const std::string text =
      (number.negative ? "-0." : "0.") + number.significand + "e" + std::to_string(number.exponent);
  if constexpr (std::same_as<S, double>) {
    return parse_number(text).value_or(0);
  } else {
    return S(text);
  }
}

/// The TOML text with every decimal number that a parser with 64-bit numbers would refuse (1e400, integers
/// beyond 2^63, hundreds of digits) replaced by a 1 and blanks. All places in the text stay where they are.
[[nodiscard]] std::string with_tame_numbers(std::string_view toml);

}  // namespace shearfront::detail
