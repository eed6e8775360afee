// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/observation_columns.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

/// A comment of several lines stays a comment.
void add_comment(std::string& text, std::string_view comment) {
  for (;;) {
    const std::size_t end = comment.find('\n');
    const std::string_view line = comment.substr(0, end);
    text += line.empty() ? "#" : "# ";
    text += line;
    text += '\n';
    if (end == std::string_view::npos) return;
    comment.remove_prefix(end + 1);
  }
}

}  // namespace

std::string observations_text(const Observations& observations) {
  const bool is_bin = observations.quantity == Quantity::bin, has_sigma = observations.has_sigma();
  const ObservationUnits& units = observations.units;
  std::string text;
  for (const std::string& comment : observations.comments) add_comment(text, comment);
  const auto heading = [&](std::string_view name, const std::string& unit) {
    text += (name == "t" || name == "x" ? "" : ",") + detail::csv_field(detail::heading_text(name, unit));
  };
  heading(units.is_chute ? "x" : "t", units.t);
  const bool has_place = observations.quantity != Quantity::bed_height;
  if (has_place) heading("z", units.z);
  heading(!has_place ? "H" : observations.quantity == Quantity::cumulative ? "M" : "phi", units.value);
  if (is_bin) heading("width", units.z);
  if (has_sigma) heading("sigma", units.value);
  text += '\n';
  for (const Observation& o : observations.rows) {
    text += number_text(o.t);
    if (has_place) (text += ',') += number_text(o.z);
    (text += ',') += number_text(o.value);
    if (is_bin) (text += ',') += number_text(o.width);
    if (has_sigma) (text += ',') += number_text(o.sigma);
    text += '\n';
  }
  return text;
}

void write_observations(OutputFile& file, const Observations& observations) {
  file.write(observations_text(observations));
}

}  // namespace shearfront
