// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/numeric/number_text.hpp"

/// Pieces of JSON. Numbers are written as text here, because a JSON library would round those with more
/// digits than a double has.
namespace shearfront::detail {

/// The shortest text that reads back to the same double, or `digits` > 17 digits; null if it is not finite.
template <Real S>
[[nodiscard]] std::string json_number(const S& x, int digits = 0) {
  constexpr int kDoubleDigits = 17;
  if (!is_finite(x)) return "null";
  if (digits <= kDoubleDigits) return number_text(to_double(x));
  std::string text = number_text(x, digits);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

template <Real S>
[[nodiscard]] std::string json_number(const std::optional<S>& x, int digits = 0) {
  return x ? json_number(*x, digits) : "null";
}

[[nodiscard]] inline std::string json_text(std::string_view s) {
  return nlohmann::json(s).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// [a, b, c] of pieces of JSON.
[[nodiscard]] inline std::string json_array(const std::vector<std::string>& pieces,
                                            std::string_view separator = ", ") {
  std::string all = "[";
  for (const std::string& piece : pieces) {
    if (all.size() > 1) all += separator;
    all += piece;
  }
  return all + "]";
}

}  // namespace shearfront::detail
