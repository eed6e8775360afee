// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/scene_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>

#include "shearfront/io/detail/unit.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::size_t kLongestUnitName = 40;

std::string unit_and_factor(const std::string& unit, const SceneColumns::Numbers& numbers) {
  if (unit.empty()) return "";
  std::string text = " in " + printable(unit, kLongestUnitName);
  if (numbers.numerator != numbers.denominator)
    text += ", times " + number_text(numbers.numerator / numbers.denominator);
  return text;
}

/// The decimal mark of a number becomes a point.
std::string with_decimal_point(std::string_view cell, char decimal) {
  std::string text(cell);
  if (decimal == ',') std::replace(text.begin(), text.end(), ',', '.');
  return text;
}

}  // namespace

std::optional<std::vector<SceneColumns::Numbers>> SceneColumns::read(const std::string& path,
                                                                     const std::vector<Wanted>& wanted,
                                                                     double lowest) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw_file_error(path, "must be a file of text");  // a scene never waits for a terminal
  std::vector<std::string> names;
  for (const Wanted& w : wanted) names.push_back(w.column);
  NamedColumns& file =
      *files_.emplace_back(std::make_unique<NamedColumns>(TextSource::read_decoded(path), names));
  if (file.columns().empty()) return std::nullopt;
  std::vector<Numbers> all(wanted.size());
  std::string remark = fmt::format("{}: {}", printable(file.name()), file.understood());
  bool is_plain = file.is_plain();
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    const NamedColumns::Column& column = file.columns()[c];
    const std::string& unit = column.heading.unit;
    if (!convert(column, wanted[c].meaning, all[c]))
      file.report().add(column.position,
                        {wanted[c].key, quoted_text(column.heading.text),
                         fmt::format("must be in a unit that can be converted to [{}], that of the scene",
                                     wanted[c].meaning == Meaning::time ? units_.t : units_.z)});
    const std::size_t first = wanted[c].are_breaks ? 1 : 0;
    for (std::size_t row = 0; row < column.cells.size(); ++row) {
      if (row == 0 && first == 1 && column.cells[0].empty()) continue;
      if (!number_with_mark(column.cells[row], file.decimal()))
        file.report().add(file.position(c, row),
                          {fmt::format("{}[{}]", wanted[c].key, row - std::min(row, first)),
                           column.cells[row].empty() ? "" : quoted_text(column.cells[row]),
                           column.cells[row].empty() ? "missing; must be a number" : "must be a number"});
    }
    for (std::size_t row = 0; row < column.cells.size(); ++row)
      all[c].cells.push_back(with_decimal_point(column.cells[row], file.decimal()));
    if (first == 1 && file.report().is_empty()) {
      (void)check_first_break(file, c, wanted[c], all[c], lowest);
      all[c].cells.erase(all[c].cells.begin());
    }
    origins_.push_back({wanted[c].key, &file, c, first});
    remark += fmt::format("; {} from {}{}", wanted[c].key, quoted_text(column.heading.text),
                          unit_and_factor(unit, all[c]));
    is_plain = is_plain && unit.empty();
  }
  if (!file.report().is_empty()) return std::nullopt;
  if (!is_plain) remarks_.push_back(std::move(remark));
  return all;
}

bool SceneColumns::check_first_break(NamedColumns& file, std::size_t column, const Wanted& wanted,
                                     const Numbers& numbers, double lowest) {
  if (numbers.cells.front().empty() || number_of_cell<double>(numbers.cells.front(), numbers) <= lowest)
    return true;
  file.report().add(
      file.position(column, 0),
      {wanted.key, numbers.cells.front(),
       fmt::format("the first row must begin at {} or have nothing here: its value counts from there",
                   number_text(lowest))});
  return false;
}

/// What is known is converted, what contradicts refused, everything else taken as it is.
bool SceneColumns::convert(const NamedColumns::Column& column, Meaning meaning, Numbers& numbers) const {
  const std::string& unit = column.heading.unit;
  const auto take = [&](const std::optional<std::pair<double, double>>& ratio) {
    if (ratio) std::tie(numbers.numerator, numbers.denominator) = *ratio;
    return ratio.has_value();
  };
  if (unit.empty() || meaning == Meaning::number) return true;
  if (meaning == Meaning::height || meaning == Meaning::time) {
    const std::string& own = meaning == Meaning::height ? units_.z : units_.t;
    return own.empty() || take(unit_ratio(unit, own));
  }
  if (meaning == Meaning::state) {
    const auto known = unit_of(unit);
    return !known || known->kind != UnitKind::fraction || take(unit_ratio(unit, "1"));
  }
  const std::size_t stroke = unit.find('/');
  if (stroke == std::string::npos || units_.z.empty() || units_.t.empty()) return true;
  const auto length = unit_ratio(trimmed(std::string_view(unit).substr(0, stroke)), units_.z),
             time = unit_ratio(trimmed(std::string_view(unit).substr(stroke + 1)), units_.t);
  if (length && time) (void)take(std::pair(length->first * time->second, length->second * time->first));
  return true;
}

bool SceneColumns::take(const Complaint& complaint) {
  const std::string key = complaint.key.substr(0, complaint.key.find('[', complaint.key.rfind('.')));
  const auto origin =
      std::find_if(origins_.begin(), origins_.end(), [&](const Origin& o) { return o.key == key; });
  if (origin == origins_.end()) return false;
  NamedColumns& file = *origin->file;
  const NamedColumns::Column& column = file.columns()[origin->column];
  Position where = column.position;
  if (key.size() < complaint.key.size()) {
    const auto index = parse_count(
        std::string_view(complaint.key).substr(key.size() + 1, complaint.key.size() - key.size() - 2));
    const std::size_t row = static_cast<std::size_t>(index.value_or(0)) + origin->first_row;
    if (row < column.cells.size()) where = file.position(origin->column, row);
  }
  file.report().add(where, complaint);
  return true;
}

std::vector<FileError> SceneColumns::errors() const {
  std::vector<FileError> all;
  for (const auto& file : files_)
    if (auto error = file->report().error()) all.push_back(std::move(*error));
  return all;
}

void read_units(TableReader& table, SceneUnits& units) {
  const auto read = [&](const char* key, UnitKind kind) {
    const std::string_view what = kind == UnitKind::length ? "must be the name of a unit of length"
                                                           : "must be the name of a unit of time";
    const auto name = table.text(key, TableReader::Need::optional, what);
    const auto known = unit_of(name.value_or(""));
    if (known && known->kind != kind) table.add(*table.node(key), table.path(key), what);
    return name.value_or("");
  };
  units.z = read("z", UnitKind::length);
  units.t = units.is_chute ? read("x", UnitKind::length) : read("t", UnitKind::time);
  table.finish();
}

}  // namespace shearfront::detail
