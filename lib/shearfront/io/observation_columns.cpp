// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/observation_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::size_t kMostColumns = 1000;  // keeps the comparison of names with each other short
constexpr std::size_t kLongestName = 40;    // in messages

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// "Phi", "phi_small" and "phy" resemble phi; "phi" does not. Names of one letter are resembled by "t_s" and
/// "T", not by every other letter.
bool resembles(std::string_view name, std::string_view known) {
  if (name == known) return false;
  const std::string lower = lower_case(name), target = lower_case(known);
  const bool goes_on = lower.starts_with(target) && lower.size() > target.size() &&
                       !(lower[target.size()] >= 'a' && lower[target.size()] <= 'z');
  return lower == target || goes_on || nearest_name(lower, {target}).has_value();
}

bool is_number_or_missing(const CsvField& field) {
  return field.text.empty() || field.text == "NA" || parse_number(field.text).has_value();
}

/// What separates the columns of a header that has no commas.
std::string_view other_separator(std::string_view header) {
  if (header.find(';') != std::string_view::npos) return "semicolons";
  if (header.find('\t') != std::string_view::npos) return "tabs";
  return trimmed(header).find(' ') != std::string_view::npos && header.find('[') == std::string_view::npos &&
                 header.find('(') == std::string_view::npos
             ? "blanks"
             : "";
}

}  // namespace

Heading heading_of(std::string_view field) {
  const std::size_t open = field.find_first_of("[(");
  if (open == std::string_view::npos || field.back() != (field[open] == '[' ? ']' : ')'))
    return {std::string(trimmed(field)), ""};
  return {std::string(trimmed(field.substr(0, open))),
          std::string(trimmed(field.substr(open + 1, field.size() - open - 2)))};
}

std::string heading_text(std::string_view name, std::string_view unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

ObservationColumns::ObservationColumns(const TextSource& source, std::size_t offset,
                                       const std::vector<CsvField>& fields, ComplaintReport& report)
    : file_(source.name()), report_(&report) {
  if (fields.size() > kMostColumns) {
    report.add(source.position(offset), {"header", fmt::format("({} columns)", fields.size()),
                                         fmt::format("must have at most {}", kMostColumns)});
    return;
  }
  for (const CsvField& field : fields) {
    headings_.push_back(heading_of(without_doubled_quotes(field.text)));
    positions_.push_back(source.position(offset + field.offset));
  }
  const auto separator = fields.size() == 1 ? other_separator(fields[0].text) : std::string_view();
  if (!separator.empty()) {
    refuse_header(fmt::format("must separate the columns by commas, not by {}", separator));
  } else if (std::all_of(fields.begin(), fields.end(), is_number_or_missing)) {
    refuse_header(
        "missing; the first line that is no comment must name the columns, such as t,z,phi (lines that start "
        "with # are comments)");
  } else {
    read_known();
    read_unknown();
    find_missing();
    check_units();
  }
}

void ObservationColumns::read_known() {
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    const auto known = std::find(kColumnNames.begin(), kColumnNames.end(), headings_[i].name);
    if (known == kColumnNames.end()) continue;
    auto& at = at_[static_cast<std::size_t>(known - kColumnNames.begin())];
    if (at)
      refuse(i, "must not occur twice");
    else
      at = i;
  }
  std::vector<Column> values;
  for (const Column column : {Column::phi, Column::M, Column::H})
    if (has(column)) values.push_back(column);
  std::sort(values.begin(), values.end(), [&](Column a, Column b) { return field(a) < field(b); });
  if (values.size() > 1)
    refuse(field(values[1]),
           fmt::format("must not stand beside {}: a file has one quantity, remove or rename one of them",
                       name_of(values[0])));
  else if (has(Column::H) && (has(Column::z) || has(Column::width)))
    refuse(field(has(Column::z) ? Column::z : Column::width),
           "must not stand beside H: the height of the bed has no place in it");
  else if (has(Column::M) && has(Column::width))
    refuse(field(Column::width), "must not stand beside M: only concentrations are averaged over bins");
}

/// A column that was meant to be sigma or width changes the result when it is not used; others do not.
void ObservationColumns::read_unknown() {
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    const std::string& name = headings_[i].name;
    if (std::find(kColumnNames.begin(), kColumnNames.end(), name) != kColumnNames.end()) continue;
    bool is_refused = false;
    for (const Column optional : {Column::width, Column::sigma}) {
      if (has(optional) || !resembles(name, name_of(optional))) continue;
      refuse(i, fmt::format("unknown column; must be called {0} if it is meant, and less like {0} if not",
                            name_of(optional)));
      is_refused = true;
      break;
    }
    if (is_refused) continue;
    notes_.push_back(fmt::format("{}:{}:{}: {}", printable(file_), positions_[i].line, positions_[i].column,
                                 name.empty() ? std::string("column without a name is not used")
                                              : "column " + quoted_text(name) + " is not used"));
  }
}

void ObservationColumns::find_missing() {
  for (const Column column : {Column::t, Column::z, Column::phi}) {
    if (has(column) || (column == Column::phi && value() != Column::phi)) continue;
    if (column == Column::z && has(Column::H)) continue;
    std::string constraint =
        column == Column::t ? "must have a column t (time)"
        : column == Column::z
            ? "must have a column z (height)"
            : "must have a column phi (concentration), M (cumulative) or H (height of the bed)";
    if (const auto meant = misspelt(column)) constraint += "; rename " + *meant + " if that is meant";
    refuse_header(std::move(constraint));
  }
}

void ObservationColumns::check_units() {
  const auto same = [&](Column column, Column as) {
    if (!has(column) || !has(as) || unit(column).empty() || unit(column) == unit(as)) return;
    refuse(field(column), fmt::format("must have the unit of {}, {}", name_of(as),
                                      unit(as).empty() ? std::string("which has none")
                                                       : "[" + printable(unit(as), kLongestName) + "]"));
  };
  same(Column::width, Column::z);
  same(Column::sigma, value());
  if (has(Column::phi) &&
      (unit(Column::phi) == "percent" || unit(Column::phi).find('%') != std::string::npos))
    refuse(field(Column::phi), "must be a fraction, 1 where all grains are small, not in percent");
}

std::string ObservationColumns::unit(Column column) const {
  return has(column) ? headings_[field(column)].unit : std::string();
}

std::optional<std::string> ObservationColumns::misspelt(Column column) const {
  for (const Heading& heading : headings_)
    if (std::find(kColumnNames.begin(), kColumnNames.end(), heading.name) == kColumnNames.end() &&
        resembles(heading.name, name_of(column)))
      return printable(heading.name, kLongestName);
  return std::nullopt;
}

void ObservationColumns::refuse(std::size_t i, std::string constraint) {
  report_->add(positions_[i], {fmt::format("column[{}]", i),
                               quoted_text(heading_text(headings_[i].name, headings_[i].unit), kLongestName),
                               std::move(constraint)});
}

void ObservationColumns::refuse_header(std::string constraint) {
  report_->add(positions_[0], {"header", "", std::move(constraint)});
}

Quantity ObservationColumns::quantity() const {
  if (has(Column::H)) return Quantity::bed_height;
  if (has(Column::M)) return Quantity::cumulative;
  return has(Column::width) ? Quantity::bin : Quantity::point;
}

ObservationUnits ObservationColumns::units() const {
  return {unit(Column::t), unit(Column::z), unit(value())};
}

std::string ObservationColumns::names() const {
  std::string all;
  for (const Heading& heading : headings_)
    all += (all.empty() ? "" : ", ") + printable(heading.name, kLongestName);
  return all;
}

}  // namespace shearfront::detail
