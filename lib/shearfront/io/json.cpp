// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/json.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {
namespace {

constexpr auto kReplace = Json::error_handler_t::replace;

/// Levels of containers: 0 of a number, 2 of [[1, 2]].
int depth(const Json& value) {
  int below = -1;
  if (value.is_structured())
    for (const Json& child : value) below = std::max(below, depth(child));
  return value.is_structured() ? std::max(below, 0) + 1 : 0;
}

std::string scalar_text(const Json& value) {
  if (value.is_binary()) return {value.get_binary().begin(), value.get_binary().end()};
  if (!value.is_number_float()) return value.dump(-1, ' ', false, kReplace);
  const auto x = value.get<double>();
  return std::isfinite(x) ? number_text(x) : "null";
}

/// Lines but the first begin with `indent` blanks.
std::string indented_text(const Json& value, std::size_t indent) {
  if (!value.is_structured()) return scalar_text(value);
  const bool is_broken = indent == 0 || depth(value) > (value.is_array() ? 1 : 2);
  const std::string line = is_broken ? "\n" + std::string(indent, ' ') : "";
  std::string text = value.is_array() ? "[" : "{", separator;
  for (const auto& [key, child] : value.items()) {
    text += separator + line + (is_broken ? "  " : "");
    if (value.is_object()) text += Json(key).dump(-1, ' ', false, kReplace) + ": ";
    text += indented_text(child, indent + 2);
    separator = is_broken ? "," : ", ";
  }
  return text + line + (value.is_array() ? "]" : "}");
}

}  // namespace

Json json_digits(const std::string& text) { return Json::binary({text.begin(), text.end()}); }

std::string json_text(const Json& value) { return indented_text(value, 2); }

std::string json_document(const Json& object) { return indented_text(object, 0) + "\n"; }

}  // namespace shearfront::detail
