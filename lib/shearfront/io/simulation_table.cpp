// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/simulation_table.hpp"

#include <array>
#include <utility>

#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {
namespace {

/// The first three lines and their offsets.
struct FirstLines {
  std::array<std::string_view, 3> lines;
  std::array<std::size_t, 3> offsets{};
};
FirstLines first_lines(std::string_view text) {
  FirstLines first;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < 3 && begin < text.size(); ++i) {
    first.offsets[i] = begin;
    first.lines[i] = line_at(text, begin);
    begin += first.lines[i].size() + 1;
  }
  return first;
}

/// Whether a number stands in the first line from there on that is neither empty nor a comment: a step stands below the
/// header of LAMMPS; below comments that were copied from such a file to another one stands a header.
bool has_number_below(std::string_view text, std::size_t from) {
  for (std::size_t begin = from; begin < text.size();) {
    const std::string_view line = line_at(text, begin), content = trimmed(line);
    if (!content.empty() && content[0] != '#') return content[0] >= '0' && content[0] <= '9';
    begin += line.size() + 1;
  }
  return true;
}

/// One number, or two; nothing for anything else.
std::optional<double> time_in(std::string_view line) {
  std::vector<CsvField> fields;
  (void)split_csv(line, fields, ' ');
  if (fields.size() > 2) return std::nullopt;
  const auto first = parse_number(fields.front().text), last = parse_number(fields.back().text);
  if (!first || !last) return std::nullopt;
  return fields.size() == 1 ? *first : (*first + *last) / 2;
}

/// "7-9:momentum" is three columns, "6:density" one.
std::pair<std::string_view, std::size_t> name_and_width(std::string_view field) {
  const std::size_t colon = field.find(':');
  if (colon == std::string_view::npos) return {field, 1};
  const std::string_view range = field.substr(0, colon);
  const std::size_t dash = range.find('-');
  const auto from = parse_count(range.substr(0, dash));
  const auto to = dash == std::string_view::npos ? from : parse_count(range.substr(dash + 1));
  constexpr unsigned long long kWidest = 100;
  if (!from || !to || *to < *from || *to - *from >= kWidest) return {field, 1};
  return {field.substr(colon + 1), static_cast<std::size_t>(*to - *from + 1)};
}

}  // namespace

SimulationHeader simulation_header(std::string_view text) {
  const FirstLines first = first_lines(text);
  const auto content = [&](std::size_t i) { return trimmed(first.lines[i]); };
  if (content(0).starts_with('#') && content(1).starts_with('#') && content(2).starts_with('#') &&
      trimmed(content(2).substr(1)).starts_with("Chunk ") && has_number_below(text, first.offsets[2]))
    return {SimulationCode::lammps, first.offsets[2]};
  if (content(0).starts_with("CG ") && content(1).starts_with("time "))
    return {SimulationCode::mercury_cg, first.offsets[1]};
  if (content(1).starts_with("w ") && time_in(content(2)) && !content(0).empty())
    return {SimulationCode::mercury_statistics, first.offsets[0]};
  return {};
}

ObservationFormat format_of(SimulationCode code, ObservationFormat format) {
  const auto usual = [&](Column column, std::string_view name) {
    if (format[column].name.empty()) format[column].name = name;
  };
  if (code == SimulationCode::lammps) {
    usual(Column::t, "Timestep");
    usual(Column::z, "Coord1");
  } else if (code != SimulationCode::none) {
    usual(Column::t, "time");
    usual(Column::z, "z");
    if (format[Column::M].name.empty() && format[Column::phi_large].name.empty())
      usual(Column::phi, code == SimulationCode::mercury_cg ? "volumeFraction" : "Nu");
  }
  return format;
}

std::string_view text_of(SimulationCode code) {
  return code == SimulationCode::lammps ? "averages over chunks"
         : code == SimulationCode::none ? ""
                                        : "coarse-grained averages";
}

std::string_view SimulationRows::constraint() const {
  return code_ == SimulationCode::lammps ? "must be a step, a number of chunks and their count"
                                         : "must be a time, or its beginning and end";
}

SimulationRows::Line SimulationRows::take(std::string_view line) {
  if (code_ == SimulationCode::lammps) {
    if (n_left_ > 0) return --n_left_, Line::row;
    std::vector<CsvField> fields;
    (void)split_csv(line, fields, ' ');
    const auto n = fields.size() >= 2 ? parse_count(fields[1].text) : std::nullopt;
    if (!n || fields.size() > 3) return Line::bad;
    time_ = fields[0].text;
    n_left_ = *n;
    return Line::not_a_row;
  }
  if (code_ != SimulationCode::mercury_statistics) return Line::row;
  if (trimmed(line).starts_with("w ")) return Line::not_a_row;
  if (const auto time = time_in(line)) {
    time_ = number_text(*time);
    return Line::not_a_row;
  }
  return time_.empty() ? Line::bad : Line::row;
}

void SimulationRows::complete(std::vector<CsvField>& fields, bool is_header) const {
  if (code_ == SimulationCode::lammps) {
    if (is_header && !fields.empty() && fields[0].text == "#")
      fields[0].text = "Timestep";
    else
      fields.insert(fields.begin(), {is_header ? std::string_view("Timestep") : time_, 0});
  } else if (code_ == SimulationCode::mercury_statistics) {
    fields.insert(fields.begin(), {is_header ? std::string_view("time") : time_, 0});
    if (is_header) fields.insert(fields.begin() + 1, {{"x", 0}, {"y", 0}, {"z", 0}});
  } else if (code_ == SimulationCode::mercury_cg && is_header) {
    std::vector<CsvField> all;
    for (const CsvField& field : fields) {
      const auto [name, width] = name_and_width(field.text);
      all.push_back({name, field.offset});
      all.insert(all.end(), width - 1, {"", field.offset});  // further components have no name
    }
    fields = std::move(all);
  }
}

}  // namespace shearfront::detail
