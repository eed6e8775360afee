// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/numeric/number_text.hpp"

#include <array>
#include <charconv>
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

ReadNumber read_number(std::string_view text) {
  double x = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), x);
  return {error == std::errc{} ? x : 0, static_cast<std::size_t>(end - text.data()), error};
}

}  // namespace shearfront
