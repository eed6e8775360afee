// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

/// JSON as this project writes it. What is not a finite number is null.
namespace shearfront::detail {

/// Members stay in the order in which they are added.
using Json = nlohmann::ordered_json;

template <class T>
[[nodiscard]] Json json_or_null(const std::optional<T>& x) {
  return x ? Json(*x) : Json();
}

/// A number by its text, with more digits than a double has.
[[nodiscard]] Json json_digits(const std::string& text);

/// One line for numbers and rows of them, several for tables and what contains one; numbers with the shortest text
/// that reads back to the same number, bytes that are no UTF-8 replaced.
[[nodiscard]] std::string json_text(const Json& value);
/// A whole file: one line per member at least.
[[nodiscard]] std::string json_document(const Json& object);

}  // namespace shearfront::detail
