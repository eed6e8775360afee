// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/observation_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "shearfront/io/detail/unit.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::size_t kMostColumns = 1000;  // keeps the comparison of names with each other short
constexpr std::size_t kLongestName = 40;    // in messages

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

/// What separates the columns of a header in which no usual separator does.
std::string_view other_separator(std::string_view header) {
  if (header.find(';') != std::string_view::npos) return "semicolons";
  if (header.find('\t') != std::string_view::npos) return "tabs";
  return trimmed(header).find(' ') != std::string_view::npos && header.find('[') == std::string_view::npos &&
                 header.find('(') == std::string_view::npos
             ? "blanks"
             : "";
}

}  // namespace

ObservationColumns::ObservationColumns(const TextSource& source, std::size_t offset,
                                       const std::vector<CsvField>& fields,
                                       const std::vector<CsvField>& units, const ObservationFormat& format,
                                       TableLayout layout, const Target& target, ComplaintReport& report)
    : file_(source.name()), report_(&report), layout_(layout) {
  factors_.fill(1);
  if (fields.size() > kMostColumns && layout == TableLayout::rows) {
    report.add(source.position(offset), {"header", fmt::format("({} columns)", fields.size()),
                                         fmt::format("must have at most {}", kMostColumns)});
    return;
  }
  for (const CsvField& field : fields) {
    headings_.push_back(heading_of(without_doubled_quotes(field.text)));
    positions_.push_back(source.position(offset + field.offset));
  }
  for (std::size_t i = 0; i < std::min(units.size(), headings_.size()); ++i)
    if (headings_[i].unit.empty()) headings_[i].unit = without_brackets(units[i].text);
  const auto separator = fields.size() == 1 ? other_separator(fields[0].text) : std::string_view();
  if (!separator.empty()) {
    refuse_header(fmt::format("must separate the columns by commas, semicolons or tabs, not by {}",
                              format.separator ? fmt::format("{}, where the format says otherwise", separator)
                                               : std::string(separator)));
  } else if (layout != TableLayout::rows) {
    read_wide(format);
    check_units(target);
  } else if (std::all_of(fields.begin(), fields.end(), is_number_or_missing)) {
    refuse_header(
        "missing; the first line that is no comment must name the columns, such as t,z,phi (lines that start "
        "with # are comments)");
  } else {
    read_known(match(headings_, format), format);
    read_unknown();
    find_missing();
    check_units(target);
  }
}

void ObservationColumns::read_wide(const ObservationFormat& format) {
  const bool by_height = layout_ == TableLayout::heights;
  const Column first = by_height ? Column::t : Column::z, other = by_height ? Column::z : Column::t;
  at_[index(first)] = 0;
  // "t [s]\z [mm]": both names in the corner.
  const std::string& corner = headings_[0].text;
  const std::size_t stroke = corner.find_first_of("\\/|");
  if (stroke != std::string::npos) {
    const std::array<Heading, 2> both{heading_of(trimmed(std::string_view(corner).substr(0, stroke))),
                                      heading_of(trimmed(std::string_view(corner).substr(stroke + 1)))};
    const std::size_t of_first = both[0].name == name_of(other) ? 1 : 0;
    column_units_[index(first)] = both[of_first].unit;
    column_units_[index(other)] = both[1 - of_first].unit;
  } else {
    column_units_[index(first)] = headings_[0].unit;
  }
  auto places = places_in(headings_, column_units_[index(other)]);
  if (!places) {
    refuse_header(fmt::format("must have one number, {}, in the name of each column but the first",
                              by_height ? "the height z" : "the time t"));
    return;
  }
  places_ = std::move(*places);
  std::size_t n_values = 0;
  for (const Column value : {Column::phi, Column::phi_large, Column::M})
    if (value == Column::phi ? !format[value].unit.empty() : !format[value].name.empty()) {
      at_[index(value)] = places_.front().field;
      ++n_values;
    }
  if (n_values == 0) at_[index(Column::phi)] = places_.front().field;
  if (has(Column::phi) && n_values > 1) at_[index(Column::phi)].reset();
  for (std::size_t c = 0; c < kColumnNames.size(); ++c)
    if (!format.columns[c].unit.empty()) column_units_[c] = format.columns[c].unit;
}

void ObservationColumns::read_known(const HeaderMatch& found, const ObservationFormat& format) {
  for (std::size_t c = 0; c < kColumnNames.size(); ++c) {
    const std::vector<std::size_t>& fields = found.fields[c];
    const ObservationFormat::ColumnFormat& asked = format.columns[c];
    if (fields.empty()) {
      if (!asked.name.empty())
        refuse_header(fmt::format("must have a column {}, which is said to hold {}; it has {}",
                                  quoted_text(asked.name), kColumnNames[c], names()));
      continue;
    }
    at_[c] = fields[0];
    for (std::size_t i = 1; i < fields.size(); ++i) refuse(fields[i], "must not occur twice");
    column_units_[c] = asked.unit.empty() ? headings_[fields[0]].unit : asked.unit;
  }
  std::vector<Column> values;
  for (const Column column : {Column::phi, Column::phi_large, Column::M, Column::H})
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
    if (std::find(at_.begin(), at_.end(), i) != at_.end()) continue;
    if (std::find(kColumnNames.begin(), kColumnNames.end(), name) != kColumnNames.end() &&
        has(static_cast<Column>(std::find(kColumnNames.begin(), kColumnNames.end(), name) -
                                kColumnNames.begin())))
      continue;  // twice, and refused
    bool is_refused = false;
    for (const Column optional : {Column::width, Column::sigma}) {
      if (has(optional) || !resembles(name, name_of(optional))) continue;
      refuse(i, fmt::format("unknown column; must be called {0} if it is meant, and less like {0} if not",
                            name_of(optional)));
      is_refused = true;
      break;
    }
    if (is_refused || (name.empty() && i + 1 == headings_.size() && headings_.size() > 1)) continue;
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
    const auto is_large = [](const Heading& h) { return h.name == name_of(Column::phi_large); };
    if (column == Column::phi && std::any_of(headings_.begin(), headings_.end(), is_large))
      constraint +=
          "; phi_large is the concentration of the large grains if phi_large = \"phi_large\" is said in "
          "[columns] or --columns";
    else if (const auto meant = misspelt(column))
      constraint += "; rename " + *meant + " if that is meant";
    else if (const std::string unused = unused_names(); !unused.empty())
      constraint += fmt::format("; say in [columns] or --columns if it is {}", unused);
    refuse_header(std::move(constraint));
  }
}

void ObservationColumns::check_units(const Target& target) {
  const auto agree = [&](Column column, Column as) {
    if (!has(column) || !has(as)) return;
    if (unit(column).empty()) column_units_[index(column)] = unit(as);
    if (unit_factor(unit(column), unit(as))) return;
    refuse(field(column), fmt::format("must have the unit of {}, {}", name_of(as),
                                      unit(as).empty() ? std::string("which has none")
                                                       : "[" + printable(unit(as), kLongestName) + "]"));
  };
  agree(Column::width, Column::z);
  agree(Column::sigma, value());
  const auto own = [&](Column column, const std::string& scene) {
    return scene.empty() || unit(column).empty() ? unit(column) : scene;
  };
  const std::string t = own(Column::t, target.t), z = own(Column::z, target.z);
  const bool is_length = value() == Column::M || value() == Column::H;
  std::string of_value = unit(value());
  const auto kind = unit_of(of_value);
  if (is_length) {
    const std::string& of_heights = z.empty() ? target.z : z;
    const bool is_any = value() == Column::M && !target.are_parts;  // vehicles, say
    if (kind && unit_factor(of_value, of_heights))
      of_value = of_heights;
    else if (!of_value.empty() && !is_any &&
             (!of_heights.empty() || (kind && kind->kind != UnitKind::length)))
      refuse(field(value()),
             of_heights.empty()
                 ? std::string("must be in a unit of length")
                 : fmt::format("must be in a unit that can be converted to [{}], that of heights",
                               printable(of_heights, kLongestName)));
  } else if (target.are_parts && !of_value.empty() && (!kind || kind->kind != UnitKind::fraction)) {
    refuse(
        has(value()) ? field(value()) : 0,
        "must be a fraction of 1 or in percent; units of [columns] or --units phi=1 say so where the header "
        "does not");
  } else if (kind && kind->kind == UnitKind::fraction) {
    if (!target.are_parts && kind->size != 1)
      refuse(field(value()), "must be in the unit of the flux, whose states are no fractions of 1");
    if (kind->size != 1 && !unit(value()).empty()) of_value = "1";
  }
  convert(Column::t, t);
  convert(Column::z, z);
  convert(Column::width, z);
  convert(value(), of_value);
  convert(Column::sigma, of_value);
  const auto as_scene = [](const std::string& own_unit, const std::string& scene) {
    return own_unit.empty() ? scene : own_unit;
  };
  units_ = {as_scene(t, target.t), has(Column::z) ? as_scene(z, target.z) : z,
            of_value == "1" ? "" : of_value};
}

void ObservationColumns::convert(Column column, const std::string& to) {
  const bool is_place = layout_ != TableLayout::rows && (column == Column::t || column == Column::z);
  if (!report_->is_empty()) return;
  if ((!has(column) && !is_place) || unit(column).empty()) return;
  if (const auto factor = unit_factor(unit(column), to))
    factors_[index(column)] = *factor;
  else
    refuse(has(column) ? field(column) : 1,
           fmt::format("must be in a unit that can be converted to [{}], that of the scene",
                       printable(to, kLongestName)));
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

Column ObservationColumns::value() const {
  for (const Column column : {Column::H, Column::M, Column::phi_large})
    if (has(column)) return column;
  return Column::phi;
}

Quantity ObservationColumns::quantity() const {
  if (has(Column::H)) return Quantity::bed_height;
  if (has(Column::M)) return Quantity::cumulative;
  return has(Column::width) ? Quantity::bin : Quantity::point;
}

std::string ObservationColumns::names() const {
  std::string all;
  for (const Heading& heading : headings_)
    all += (all.empty() ? "" : ", ") + printable(heading.name, kLongestName);
  return all;
}

std::string ObservationColumns::unused_names() const {
  std::string all;
  for (std::size_t i = 0; i < headings_.size(); ++i)
    if (std::find(at_.begin(), at_.end(), i) == at_.end() && !headings_[i].name.empty())
      all += (all.empty() ? "" : " or ") + quoted_text(headings_[i].name, kLongestName);
  return all;
}

std::string ObservationColumns::understood() const {
  std::string text;
  const auto in_unit = [&](Column column) {
    const std::string& from = unit(column);
    if (from.empty()) return std::string();
    if (factor(column) == 1) return fmt::format(" in {}", printable(from, kLongestName));
    const bool is_place = column == Column::t || column == Column::z || column == Column::width;
    const std::string to = column == Column::t ? units_.t : is_place ? units_.z : units_.value;
    return fmt::format(" in {}, times {}{}", printable(from, kLongestName), number_text(factor(column)),
                       to.empty() ? "" : " to " + printable(to, kLongestName));
  };
  for (std::size_t c = 0; c < kColumnNames.size(); ++c) {
    const auto column = static_cast<Column>(c);
    const bool is_place =
        layout_ != TableLayout::rows && !has(column) && (column == Column::t || column == Column::z);
    if (!has(column) && !is_place) continue;
    const bool is_value = layout_ != TableLayout::rows && column == value();
    std::string_view what = is_place || is_value ? std::string_view() : headings_[field(column)].text;
    text += fmt::format(
        "{}{} from {}{}", text.empty() ? "" : "; ",
        column == Column::phi_large ? std::string_view("1 - phi") : name_of(column),
        is_place   ? fmt::format("the names of {} columns, {} to {}", places_.size(),
                                 number_text(places_.front().place), number_text(places_.back().place))
        : is_value ? std::string("those columns")
                   : quoted_text(what),
        in_unit(column));
  }
  return text;
}

bool ObservationColumns::is_plain() const {
  if (layout_ != TableLayout::rows || has(Column::phi_large)) return false;
  for (std::size_t c = 0; c < kColumnNames.size(); ++c) {
    if (!at_[c]) continue;
    const std::string& name = headings_[*at_[c]].name;
    const bool is_distance =
        static_cast<Column>(c) == Column::t && name == "x";  // only a chute takes x for t
    if ((name != kColumnNames[c] && !is_distance) || factors_[c] != 1) return false;
  }
  return true;
}

}  // namespace shearfront::detail
