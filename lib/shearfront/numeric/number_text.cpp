// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/numeric/number_text.hpp"

#include <array>
#include <charconv>

namespace shearfront {

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

}  // namespace shearfront
