// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/table_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "shearfront/io/detail/unit.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::size_t kMostLines = 200;  // of text before the header, and of rows for the decimal mark

/// "mm", "mm/s", "1/s".
bool is_unit(std::string_view text) {
  const std::size_t stroke = text.find('/');
  if (stroke == std::string_view::npos) return unit_of(text).has_value();
  return unit_of(trimmed(text.substr(0, stroke))) && unit_of(trimmed(text.substr(stroke + 1)));
}

}  // namespace

std::vector<std::size_t> lines_of_content(std::string_view text, std::size_t from) {
  std::vector<std::size_t> lines;
  for (std::size_t begin = from; begin < text.size() && lines.size() < kMostLines;) {
    const std::string_view line = line_at(text, begin), content = trimmed(line);
    if (!content.empty() && content[0] != '#') lines.push_back(begin);
    begin += line.size() + 1;
  }
  return lines;
}

std::string_view without_brackets(std::string_view text) {
  const bool is_square = text.starts_with('[') && text.ends_with(']');
  const bool is_round = text.starts_with('(') && text.ends_with(')');
  return is_square || is_round ? trimmed(text.substr(1, text.size() - 2)) : text;
}

Heading heading_of(std::string_view field) {
  const std::size_t open = field.find_first_of("[(");
  if (open == std::string_view::npos || field.back() != (field[open] == '[' ? ']' : ')'))
    return {std::string(trimmed(field)), "", std::string(field)};
  return {std::string(trimmed(field.substr(0, open))),
          std::string(trimmed(field.substr(open + 1, field.size() - open - 2))), std::string(field)};
}

std::string heading_text(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

std::vector<Heading> headings_of(const std::vector<CsvField>& fields) {
  std::vector<Heading> headings;
  for (const CsvField& field : fields) headings.push_back(heading_of(without_doubled_quotes(field.text)));
  return headings;
}

bool is_units_row(const std::vector<CsvField>& fields) {
  bool has_unit = false;
  for (const CsvField& field : fields) {
    if (field.text.empty()) continue;
    if (shearfront::parse_number(field.text)) return false;
    const bool is_bracketed = (field.text.starts_with('[') && field.text.ends_with(']')) ||
                              (field.text.starts_with('(') && field.text.ends_with(')'));
    if (!is_bracketed && !is_unit(field.text)) return false;
    has_unit = true;
  }
  return has_unit;
}

char decimal_below(std::string_view text, std::size_t from, char separator) {
  std::vector<CsvField> fields;
  bool has_comma = false;
  for (const std::size_t line : lines_of_content(text, from)) {
    if (split_csv(line_at(text, line), fields, separator)) continue;
    for (const CsvField& field : fields) {
      if (field.text.find('.') != std::string_view::npos && shearfront::parse_number(field.text)) return '.';
      has_comma =
          has_comma || (field.text.find(',') != std::string_view::npos && number_with_mark(field.text, ','));
    }
  }
  return has_comma ? ',' : '.';
}

std::string_view line_at(std::string_view text, std::size_t offset) {
  return text.substr(offset, std::min(text.find('\n', offset), text.size()) - offset);
}

std::optional<double> number_with_mark(std::string_view text, char decimal) {
  if (decimal == '.') return shearfront::parse_number(text);
  if (text.find('.') != std::string_view::npos) return std::nullopt;
  std::string with_point(text);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  return shearfront::parse_number(with_point);
}

}  // namespace shearfront::detail
