// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace shearfront::tools {

/// Keys in the order in which they are written. Numbers that are not finite become null.
using Json = nlohmann::ordered_json;

template <class T>
[[nodiscard]] Json json_or_null(const std::optional<T>& x) {
  return x ? Json(*x) : Json(nullptr);
}

/// Texts that are no UTF-8 lose what is none.
[[nodiscard]] inline std::string json_text(const Json& json, int indent = 2) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace shearfront::tools
