// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "shearfront/io/results.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kBlock = 1 << 16;  // rows are handed on in blocks of this many bytes

std::string field(double x) { return std::isfinite(x) ? number_text(x) : std::string(); }

void hand_on(OutputFile& file, std::string& rows, std::size_t least) {
  if (rows.size() < least) return;
  file.write(rows);
  rows.clear();
}

}  // namespace

void write_samples_csv(OutputFile& file, const std::vector<double>& times, const std::vector<double>& depths,
                       const std::vector<Sample>& samples) {
  std::string rows = "t,z,phi,M\n";
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

void write_time_table_csv(OutputFile& file, const TimeTable& table) {
  std::string rows = "t";
  for (const std::string& column : table.columns) rows += "," + column;
  rows += '\n';
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    rows += field(table.times[i]);
    for (const double x : table.rows[i]) (rows += ',') += field(x);
    rows += '\n';
    hand_on(file, rows, kBlock);
  }
  hand_on(file, rows, 0);
}

void write_fronts_csv(OutputFile& file, const std::vector<FrontSegment<double>>& fronts) {
  std::string rows = "layer,t_begin,z_begin,t_end,z_end,phi_below,phi_above\n";
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
