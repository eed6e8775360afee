// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/scene_file.hpp"

namespace shearfront {
namespace {

bool has_file(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array)
      if (has_file(element)) return true;
    return false;
  }
  const toml::table* table = node.as_table();
  if (!table) return false;
  for (const auto& [key, entry] : *table)
    if ((key.str() == "file" && entry.is_string()) || has_file(entry)) return true;
  return false;
}

}  // namespace

bool names_tables_in_files(const std::string& text) {
  return has_file(detail::TomlSource(detail::TextSource("", text)).root());
}

}  // namespace shearfront
