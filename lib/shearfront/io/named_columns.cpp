// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/named_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::array kSeparators{',', ';', '\t', ' '};

std::string shown_headings(const std::vector<Heading>& headings) {
  constexpr std::size_t kMostShown = 12;
  std::string all;
  for (std::size_t i = 0; i < std::min(headings.size(), kMostShown); ++i)
    all += (all.empty() ? "" : ", ") + quoted_text(headings[i].text);
  return all + (headings.size() > kMostShown ? ", ..." : "");
}

/// The fields that have these names, one each; none unless all are there.
std::optional<std::vector<std::size_t>> fields_named(const std::vector<Heading>& headings,
                                                     const std::vector<std::string>& names) {
  std::vector<std::size_t> found;
  for (const std::string& name : names) {
    auto at =
        std::find_if(headings.begin(), headings.end(), [&](const Heading& h) { return h.text == name; });
    if (at == headings.end())
      at = std::find_if(headings.begin(), headings.end(), [&](const Heading& h) { return h.name == name; });
    if (at == headings.end()) return std::nullopt;
    found.push_back(static_cast<std::size_t>(at - headings.begin()));
  }
  return found;
}

}  // namespace

NamedColumns::NamedColumns(TextSource source, const std::vector<std::string>& names)
    : source_(std::move(source)), report_(source_.name(), kMostComplaints) {
  const auto header = find_header(names);
  if (!header) {
    refuse_header(names);
    return;
  }
  const std::string_view text = source_.text();
  std::size_t from = std::min(*header + line_at(text, *header).size() + 1, text.size());
  std::vector<CsvField> fields;
  const std::vector<std::size_t> below = lines_of_content(text, from);
  if (!below.empty() && !split_csv(line_at(text, below[0]), fields, separator_) && is_units_row(fields)) {
    has_units_row_ = true;
    for (std::size_t c = 0; c < columns_.size(); ++c)
      if (columns_[c].heading.unit.empty() && fields_[c] < fields.size())
        columns_[c].heading.unit = without_brackets(fields[fields_[c]].text);
    from = std::min(below[0] + line_at(text, below[0]).size() + 1, text.size());
  }
  decimal_ = decimal_below(text, from, separator_);
  read_rows(from);
}

std::optional<std::size_t> NamedColumns::find_header(const std::vector<std::string>& names) {
  const std::string_view text = source_.text();
  std::vector<CsvField> fields;
  for (const std::size_t line : lines_of_content(text))
    for (const char separator : kSeparators) {
      if (split_csv(line_at(text, line), fields, separator)) continue;
      const std::vector<Heading> headings = headings_of(fields);
      const auto found = fields_named(headings, names);
      if (!found) continue;
      separator_ = separator;
      fields_ = *found;
      n_fields_ = fields.size();
      for (const std::size_t i : fields_)
        columns_.push_back({headings[i], source_.position(line + fields[i].offset), {}});
      return line;
    }
  return std::nullopt;
}

void NamedColumns::refuse_header(const std::vector<std::string>& names) {
  std::string asked;
  for (const std::string& name : names) asked += (asked.empty() ? "" : " and ") + quoted_text(name);
  const std::string_view text = source_.text();
  const std::vector<std::size_t> lines = lines_of_content(text);
  Position where{1, 1};
  std::string has;
  if (!lines.empty()) {
    where = source_.position(lines[0]);
    std::vector<CsvField> fields;
    for (const char separator : kSeparators)
      if (!split_csv(line_at(text, lines[0]), fields, separator) && fields.size() > 1) {
        has = "; it has " + shown_headings(headings_of(fields));
        break;
      }
  }
  report_.add(where, {"header", "",
                      fmt::format("must have {} {}{}", names.size() == 1 ? "the column" : "the columns",
                                  asked, has)});
}

void NamedColumns::read_rows(std::size_t from) {
  const std::string_view text = source_.text();
  std::vector<CsvField> fields;
  for (std::size_t begin = from; begin < text.size();) {
    const std::string_view line = line_at(text, begin), content = trimmed(line);
    const std::size_t here = std::exchange(begin, begin + line.size() + 1);
    if (content.empty() || content[0] == '#') continue;
    const auto bad_quotes = split_csv(line, fields, separator_);
    const auto is_blank = [](const CsvField& field) { return field.text.empty(); };
    if (!bad_quotes && std::all_of(fields.begin(), fields.end(), is_blank)) continue;
    const std::string row = fmt::format("row[{}]", rows_.size());
    if (bad_quotes) {
      report_.add(source_.position(here + *bad_quotes), {row, "", "must close its quotes on the same line"});
    } else if (fields.size() != n_fields_) {
      report_.add(source_.position(here),
                  {row, fmt::format("({} field{})", fields.size(), fields.size() == 1 ? "" : "s"),
                   fmt::format("must have {}, as the header", n_fields_)});
    } else {
      for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].cells.push_back(fields[fields_[c]].text);
    }
    rows_.push_back(here);
  }
  if (rows_.empty() && report_.is_empty())
    report_.add(columns_.front().position, {"rows", "", "missing; must follow the header"});
  if (!report_.is_empty()) columns_.clear();
}

Position NamedColumns::position(std::size_t column, std::size_t row) const {
  std::vector<CsvField> fields;
  (void)split_csv(line_at(source_.text(), rows_[row]), fields, separator_);
  return source_.position(rows_[row] + fields[fields_[column]].offset);
}

bool NamedColumns::is_plain() const {
  return separator_ == ',' && decimal_ == '.' && !has_units_row_ && source_.encoding().empty();
}

std::string NamedColumns::understood() const {
  std::string text = fmt::format("{} row{}", rows_.size(), rows_.size() == 1 ? "" : "s");
  if (!source_.encoding().empty()) text += fmt::format(", {} text", source_.encoding());
  if (separator_ != ',')
    text += separator_ == ';'    ? ", separated by semicolons"
            : separator_ == '\t' ? ", separated by tabs"
                                 : ", separated by blanks";
  if (decimal_ == ',') text += ", decimal commas";
  if (has_units_row_) text += ", a row of units";
  return text;
}

}  // namespace shearfront::detail
