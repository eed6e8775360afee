// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/numeric/number_text.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
#include <cmath>
#include <cstdio>
#include <cstdlib>
#endif
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#include <fast_float/fast_float.h>
#endif

namespace shearfront {
namespace {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
using fast_float::from_chars;
#else
using std::from_chars;
#endif

}  // namespace

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

namespace {

using NumberBuffer = std::array<char, 400>;

std::string printed(const char* format, int precision, double x) {
  NumberBuffer buffer;
  const int n = std::snprintf(buffer.data(), buffer.size(), format, precision, x);
  return {buffer.data(), static_cast<std::size_t>(n)};
}

}  // namespace

/// As std::to_chars has it, which that library lacks: the fewest digits that read back, in the shorter of both notations.
std::string number_text(double x) {
  if (!std::isfinite(x)) return printed("%.*g", 1, x);
  constexpr int kEnough = 17;
  int digits = 1;
  while (digits < kEnough && std::strtod(printed("%.*e", digits - 1, x).c_str(), nullptr) != x) ++digits;
  const std::string scientific = printed("%.*e", digits - 1, x);
  const int exponent = std::atoi(scientific.c_str() + scientific.find('e') + 1);
  const std::string fixed = printed("%.*f", exponent < digits - 1 ? digits - 1 - exponent : 0, x);
  return scientific.size() < fixed.size() ? scientific : fixed;
}

std::string number_text(double x, int digits) { return printed("%.*g", digits > 0 ? digits : 1, x); }

#else

std::string number_text(double x) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr;
  return {buffer.data(), end};
}

std::string number_text(double x, int digits) {
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, std::chars_format::general, digits).ptr;
  return {buffer.data(), end};
}

#endif

ReadNumber read_number(std::string_view text) {
  double x = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), x);
  return {error == std::errc{} ? x : 0, static_cast<std::size_t>(end - text.data()), error};
}

}  // namespace shearfront
