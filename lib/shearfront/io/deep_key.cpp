// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/deep_key.hpp"

#include <algorithm>
#include <string>

namespace shearfront::detail {
namespace {

bool is_in_bare_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         (c & '\x80') != 0;
}

/// After the string that opens at i; at the end of the line or text if it does not close.
std::size_t after_string(std::string_view toml, std::size_t i) {
  const char quote = toml[i];
  const std::string three(3, quote);
  const bool is_long = toml.substr(i, 3) == three;
  const std::string_view end = is_long ? std::string_view(three) : std::string_view(three).substr(0, 1);
  i += end.size();
  while (i < toml.size() && toml.substr(i, end.size()) != end) {
    if (!is_long && toml[i] == '\n') return i;
    i += quote == '"' && toml[i] == '\\' ? 2 : 1;
  }
  return std::min(i + end.size(), toml.size());
}

}  // namespace

std::optional<std::size_t> first_deep_key(std::string_view toml) {
  std::size_t n_names = 0, begin = 0;
  bool is_joined = false;  // a point since the last name
  const auto name = [&](std::size_t at) {
    if (!is_joined) begin = at, n_names = 0;
    is_joined = false;
    return ++n_names > kMostKeyNames;
  };
  for (std::size_t i = 0; i < toml.size();) {
    const char c = toml[i];
    if (c == '"' || c == '\'') {
      if (name(i)) return begin;
      i = after_string(toml, i);
    } else if (is_in_bare_name(c)) {
      if (name(i)) return begin;
      while (i < toml.size() && is_in_bare_name(toml[i])) ++i;
    } else if (c == '#') {
      i = std::min(toml.find('\n', i), toml.size());
    } else {
      if (c == '.')
        is_joined = true;
      else if (c != ' ' && c != '\t')
        is_joined = false;
      ++i;
    }
  }
  return {};
}

}  // namespace shearfront::detail
