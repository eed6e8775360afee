// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/dialect.hpp"

#include <algorithm>
#include <array>
#include <utility>

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

/// Where no line has names that are known and the first no commas: the line that semicolons or tabs take apart into the most
/// fields is the one whose names are to be said.
void guess_header(std::string_view text, const std::vector<std::size_t>& lines, Dialect& found) {
  std::vector<CsvField> fields;
  if (lines.empty() || (!split_csv(line_at(text, lines[0]), fields, ',') && fields.size() > 1)) return;
  std::size_t most = 1;
  for (const std::size_t line : lines)
    for (const char separator : {';', '\t'}) {
      if (split_csv(line_at(text, line), fields, separator) || fields.size() <= most) continue;
      most = fields.size();
      found.separator = separator;
      found.header = line;
    }
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

std::vector<std::string> Dialect::remarks(std::string_view encoding, std::size_t n_preamble) const {
  std::vector<std::string> all;
  if (!encoding.empty()) all.push_back(std::string(encoding) + " text");
  if (std::string written = text(); !written.empty()) all.push_back(std::move(written));
  if (n_preamble > 0)
    all.push_back(std::to_string(n_preamble) + (n_preamble == 1 ? " line" : " lines") + " before the header");
  if (units) all.emplace_back("a row of units");
  return all;
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
  const bool is_found = (!is_asked_wide && search(is_header_of_rows)) || (!is_asked_rows && search(is_wide));
  if (!is_found && !format.separator) guess_header(text, lines, found);
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
