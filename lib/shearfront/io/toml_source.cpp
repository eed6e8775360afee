// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/toml_source.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "shearfront/io/detail/deep_key.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

toml::table parse(const TextSource& text) {
  if (const auto deep = first_deep_key(text.text())) {
    ComplaintReport report(text.name());
    report.add(text.position(*deep),
               {"key", "", "must have at most " + std::to_string(kMostKeyNames) + " names",
                Complaint::Kind::syntax});
    report.throw_if_any();
  }
  try {
    return toml::parse(with_tame_numbers(text.text()), text.name());
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    constexpr std::string_view kPrefix = "Error while parsing ";
    if (what.starts_with(kPrefix)) what = "in " + what.substr(kPrefix.size());
    const std::size_t place = text.offset(TomlSource::position(error.source()));
    if (what.starts_with("in string: unescaped control") &&
        text.text().substr(place, 1).find_first_of("\r\n") == 0)
      what = "in string: must end with a quotation mark on the same line";
    ComplaintReport report(text.name());
    report.add(TomlSource::position(error.source()),
               {"syntax error", "", printable(what), Complaint::Kind::syntax});
    report.throw_if_any();
    throw;
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

bool is_bare(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

}  // namespace

TomlSource::TomlSource(TextSource text) : text_(std::move(text)), root_(parse(text_)) {}

Position TomlSource::position(const toml::source_region& region) {
  // The root table of an empty file has no place of its own.
  return {std::max(region.begin.line, 1U), std::max(region.begin.column, 1U)};
}

Position TomlSource::shown_position(const toml::node& node, const toml::node* around) {
  const bool starts_line = !around || !around->is_array() || position(*around).line != position(node).line;
  return position(starts_line ? node : *around);
}

std::string_view TomlSource::literal(const toml::node& node) const {
  const std::string_view text = text_.text();
  const std::size_t begin = text_.offset(position(node));
  const std::size_t end = std::min(text.find_first_of(" \t\r\n,]}#", begin), text.size());
  return text.substr(begin, end - begin);
}

std::string TomlSource::shown(const toml::node& node) const {
  switch (node.type()) {
    case toml::node_type::string:
      return quoted_text(node.as_string()->get());
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return printable(literal(node), 60);
    case toml::node_type::array:
      return "(an array)";
    case toml::node_type::table:
      return "(a table)";
    default:
      return "(a date or time)";
  }
}

TomlSource::Found TomlSource::find(std::string_view path) const {
  const toml::node* node = &root_;
  const toml::node* around = nullptr;
  while (!path.empty()) {
    if (path[0] == '[') {
      const std::size_t end = path.find(']');
      std::size_t index = 0;
      std::from_chars(path.data() + 1, path.data() + end, index);
      const toml::array* array = node->as_array();
      const toml::node* next = array ? array->get(index) : nullptr;
      if (!next) return {node, around, false};
      around = std::exchange(node, next);
      path.remove_prefix(end + 1);
    } else {
      if (path[0] == '.') path.remove_prefix(1);
      const std::size_t end = std::min(path.find_first_of(".["), path.size());
      const toml::table* table = node->as_table();
      const toml::node* next = table ? table->get(path.substr(0, end)) : nullptr;
      if (!next) return {node, around, false};
      around = std::exchange(node, next);
      path.remove_prefix(end);
    }
  }
  return {node, around, true};
}

std::string TableReader::path(std::string_view key) const {
  constexpr std::size_t kLongestShown = 60;
  const std::string shown = is_bare(key) ? printable(key, kLongestShown) : quoted_text(key);
  return path_.empty() ? shown : path_ + "." + shown;
}

void TableReader::add(const toml::node& node, const std::string& key, std::string_view constraint,
                      const toml::node* around, Complaint::Kind kind) {
  report_->add(TomlSource::position(node), TomlSource::shown_position(node, around),
               {key, source_->shown(node), std::string(constraint), kind});
}

bool TableReader::is_array_of_tables(const toml::array& array) {
  return !array.empty() &&
         std::all_of(array.begin(), array.end(), [](const auto& e) { return e.is_table(); });
}

const toml::node* TableReader::request(std::string_view key, Need need, std::string_view what) {
  known_.emplace_back(key);
  const toml::node* node = table_->get(key);
  if (!node && need == Need::required) {
    report_->add(position(), {path(key), "", "missing; " + std::string(what), Complaint::Kind::missing});
    report_->spoil(path(key));
  }
  return node;
}

void TableReader::wrong_type(const toml::node& node, const std::string& key, std::string_view what,
                             const toml::node* around) {
  report_->spoil(key);
  const toml::array* array = node.as_array();
  if (array && is_array_of_tables(*array))
    report_->add(TomlSource::position(*array->get(0)),
                 {key, "(an array of tables)", std::string(what), Complaint::Kind::wrong_type});
  else
    add(node, key, what, around, Complaint::Kind::wrong_type);
}

std::optional<TableReader> TableReader::table(std::string_view key, Need need, std::string_view what) {
  const toml::node* node = request(key, need, what);
  if (!node) return std::nullopt;
  if (const toml::table* table = node->as_table()) return TableReader(*source_, *report_, path(key), *table);
  wrong_type(*node, path(key), what);
  return std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key, Need need, std::string_view what) {
  const toml::node* node = request(key, need, what);
  std::vector<TableReader> all;
  if (!node) return all;
  if (const toml::table* table = node->as_table()) {
    all.emplace_back(*source_, *report_, path(key), *table);
  } else if (const toml::array* array = node->as_array(); array && is_array_of_tables(*array)) {
    for (const toml::node& element : *array)
      all.emplace_back(*source_, *report_, path(key) + "[" + std::to_string(all.size()) + "]",
                       *element.as_table());
  } else {
    wrong_type(*node, path(key), what);
  }
  return all;
}

std::optional<std::string> TableReader::text(std::string_view key, Need need, std::string_view what) {
  const toml::node* node = request(key, need, what);
  if (!node) return std::nullopt;
  if (const auto* text = node->as_string()) return text->get();
  wrong_type(*node, path(key), what);
  return std::nullopt;
}

std::optional<std::string> TableReader::choice(std::string_view key, Need need,
                                               const std::vector<std::string>& names) {
  const std::string what = "must be one of: " + listed(names);
  std::optional<std::string> name = text(key, need, what);
  if (!name || std::find(names.begin(), names.end(), *name) != names.end()) return name;
  const auto meant = nearest_name(*name, names);
  add(*node(key), path(key), meant ? what + " (did you mean " + *meant + "?)" : what);
  report_->spoil(path(key));
  return std::nullopt;
}

std::optional<bool> TableReader::boolean(std::string_view key, Need need) {
  constexpr std::string_view kWhat = "must be true or false";
  const toml::node* node = request(key, need, kWhat);
  if (!node) return std::nullopt;
  if (const auto* value = node->as_boolean()) return value->get();
  wrong_type(*node, path(key), kWhat);
  return std::nullopt;
}

std::optional<unsigned long long> TableReader::count(std::string_view key, Need need, unsigned long long low,
                                                     unsigned long long high) {
  const std::string what =
      "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const toml::node* node = request(key, need, what);
  if (!node) return std::nullopt;
  std::optional<unsigned long long> n;
  std::string literal(source_->literal(*node));
  std::erase(literal, '_');
  if (parse_decimal(literal))
    n = parse_count(literal);
  else if (const auto* integer = node->as_integer(); integer && integer->get() >= 0)  // 0x1f
    n = static_cast<unsigned long long>(integer->get());
  if (node->is_number() && n && *n >= low && *n <= high) return n;
  wrong_type(*node, path(key), what);
  return std::nullopt;
}

std::vector<std::string> TableReader::texts(std::string_view key, Need need, std::string_view what) {
  std::vector<std::string> all;
  const toml::node* node = request(key, need, what);
  if (!node) return all;
  const toml::array* array = node->as_array();
  if (!array || is_array_of_tables(*array)) {
    wrong_type(*node, path(key), what);
    return all;
  }
  for (const toml::node& element : *array) {
    const auto* text = element.as_string();
    if (!text) wrong_type(element, path(key) + "[" + std::to_string(all.size()) + "]", "must be text", array);
    all.push_back(text ? text->get() : "");
  }
  return all;
}

void TableReader::finish() {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    std::string what =
        "unknown " + std::string(node.is_table() ? "table" : "key") + "; must be one of: " + listed(known_);
    if (const auto meant = nearest_name(key.str(), known_)) what += " (did you mean " + *meant + "?)";
    report_->add(TomlSource::position(key.source()), {path(key.str()), "", what, Complaint::Kind::unknown});
  }
}

}  // namespace shearfront::detail
