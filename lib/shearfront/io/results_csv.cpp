// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/observation_columns.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kBlock = 1 << 16;  // rows are handed on in blocks of this many bytes

std::string field(double x) { return std::isfinite(x) ? number_text(x) : std::string(); }

/// What a column is measured in: times and heights by their first letter, M and H and a slab's x as heights.
std::string_view unit_of_column(std::string_view name, const SceneUnits& units) {
  const std::string_view quantity = name.substr(0, name.find('_'));
  if (quantity == "t") return units.t;
  return quantity == "z" || quantity == "x" || quantity == "M" || quantity == "H" || quantity == "width"
             ? std::string_view(units.z)
             : std::string_view();
}

void hand_on(OutputFile& file, std::string& rows, std::size_t least) {
  if (rows.size() < least) return;
  file.write(rows);
  rows.clear();
}

}  // namespace

std::string csv_header(const std::vector<std::string>& names, const SceneUnits& units) {
  std::string line;
  for (const std::string& name : names) {
    if (!line.empty()) line += ',';
    const bool is_time = name == "t" || name.starts_with("t_");
    const std::string shown = is_time ? units.symbol() + name.substr(1) : name;
    line += detail::csv_field(detail::heading_text(shown, unit_of_column(name, units)));
  }
  return line + '\n';
}

void write_samples_csv(OutputFile& file, const std::vector<double>& times, const std::vector<double>& depths,
                       const std::vector<Sample>& samples, const SceneUnits& units) {
  std::string rows = csv_header({"t", "z", "phi", "M"}, units);
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t j = 0; j < depths.size(); ++j) {
      const Sample& sample = samples[i * depths.size() + j];
      rows += field(times[i]);
      for (const double x : {depths[j], sample.phi, sample.M}) (rows += ',') += field(x);
      rows += '\n';
      hand_on(file, rows, kBlock);
    }
  }
  hand_on(file, rows, 0);
}

void write_slab_csv(OutputFile& file, const SlabSamples& samples, const SceneUnits& units) {
  std::string rows = csv_header({"t", "x", "z", "phi"}, units);
  const std::size_t n = samples.z.size();
  for (std::size_t i = 0; i < samples.times.size(); ++i)
    for (std::size_t k = 0; k < samples.x.size(); ++k)
      for (std::size_t j = 0; j < n; ++j) {
        rows += field(samples.times[i]);
        for (const double number : {samples.x[k], samples.z[j], samples.phi[i][k * n + j]})
          (rows += ',') += field(number);
        rows += '\n';
        hand_on(file, rows, kBlock);
      }
  hand_on(file, rows, 0);
}

void write_time_table_csv(OutputFile& file, const TimeTable& table, const SceneUnits& units) {
  std::vector<std::string> names{"t"};
  names.insert(names.end(), table.columns.begin(), table.columns.end());
  std::string rows = csv_header(names, units);
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    rows += field(table.times[i]);
    for (const double x : table.rows[i]) (rows += ',') += field(x);
    rows += '\n';
    hand_on(file, rows, kBlock);
  }
  hand_on(file, rows, 0);
}

void write_fronts_csv(OutputFile& file, const std::vector<FrontSegment<double>>& fronts,
                      const SceneUnits& units) {
  std::string rows =
      csv_header({"layer", "t_begin", "z_begin", "t_end", "z_end", "phi_below", "phi_above"}, units);
  for (const FrontSegment<double>& f : fronts) {
    rows += std::to_string(f.layer);
    for (const double x : {f.t_begin, f.z_begin, f.t_end, f.z_end, f.phi_below, f.phi_above})
      (rows += ',') += field(x);
    rows += '\n';
    hand_on(file, rows, kBlock);
  }
  hand_on(file, rows, 0);
}

}  // namespace shearfront
