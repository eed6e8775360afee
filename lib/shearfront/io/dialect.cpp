// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/dialect.hpp"

#include <algorithm>
#include <array>

#include "shearfront/io/detail/observation_columns.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::size_t kMostFields = 20000;  // of a header that is looked at

/// What the corner of a wide table says its first column is.
std::optional<TableLayout> layout_of(const std::vector<Heading>& headings, const ObservationFormat& format) {
  std::string unit;
  if (headings.size() < 3 || !places_in(headings, unit)) return std::nullopt;
  const std::string& corner = headings[0].text;
  const std::size_t stroke = corner.find_first_of("\\/|");
  const Heading first = stroke == std::string::npos
                            ? headings[0]
                            : heading_of(trimmed(std::string_view(corner).substr(0, stroke)));
  const HeaderMatch found = match({first}, format);
  if (found.has(Column::t)) return TableLayout::heights;
  if (found.has(Column::z)) return TableLayout::times;
  return std::nullopt;
}

}  // namespace

std::string Dialect::text() const {
  if (is_simulated()) return std::string(text_of(code));
  std::string text = separator == ';'    ? "separated by semicolons"
                     : separator == '\t' ? "separated by tabs"
                                         : "";
  if (decimal == ',') text += text.empty() ? "decimal commas" : ", decimal commas";
  return text;
}

Dialect dialect_of(const TextSource& source, const ObservationFormat& format) {
  const std::string_view text = source.text();
  const std::vector<std::size_t> lines = lines_of_content(text);
  std::vector<char> separators{',', ';', '\t'};
  if (format.separator) separators = {*format.separator};
  Dialect found;
  found.separator = format.separator.value_or(',');
  found.layout = format.layout.value_or(TableLayout::rows);
  found.header = lines.empty() ? text.size() : lines[0];
  std::vector<CsvField> fields;
  const auto search = [&](const auto& is_header) {
    for (const std::size_t line : lines)
      for (const char separator : separators) {
        if (split_csv(line_at(text, line), fields, separator) || fields.size() > kMostFields) continue;
        if (!is_header(headings_of(fields))) continue;
        found.separator = separator;
        found.header = line;
        return true;
      }
    return false;
  };
  const auto is_header_of_rows = [&](const std::vector<Heading>& headings) {
    return match(headings, format).is_complete();
  };
  const auto is_wide = [&](const std::vector<Heading>& headings) {
    if (format.layout) {
      std::string unit;
      return headings.size() >= 3 && !headings[0].text.empty() && places_in(headings, unit).has_value();
    }
    const auto layout = layout_of(headings, format);
    if (layout) found.layout = *layout;
    return layout.has_value();
  };
  const bool is_asked_wide = format.layout && *format.layout != TableLayout::rows;
  const bool is_asked_rows = format.layout && !is_asked_wide;
  if (const SimulationHeader header = simulation_header(text); header.code != SimulationCode::none) {
    found.code = header.code;
    found.header = header.offset;
    found.separator = ' ';
    return found;
  }
  if (is_asked_wide || !search(is_header_of_rows)) {
    if (!is_asked_rows) (void)search(is_wide);
  }
  if (lines.empty()) return found;
  const std::size_t below = found.header + line_at(text, found.header).size() + 1;
  const std::vector<std::size_t> next =
      below < text.size() ? lines_of_content(text, below) : std::vector<std::size_t>();
  if (!next.empty() && !split_csv(line_at(text, next[0]), fields, found.separator) && is_units_row(fields))
    found.units = next[0];
  found.decimal =
      format.decimal.value_or(below < text.size() ? decimal_below(text, below, found.separator) : '.');
  return found;
}

}  // namespace shearfront::detail
