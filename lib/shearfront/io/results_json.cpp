// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "shearfront/io/detail/json_text.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
namespace {

using detail::json_number;
using detail::json_text;

std::string summary_text(const Summary& s) {
  return fmt::format(
      R"({{"collisions": {}, "fronts_max": {}, "levels": {}, "cell_updates": {}, "wall_s": {}, "status": {}, "message": {}}})",
      s.collisions, s.fronts_max, s.levels, s.cell_updates, json_number(s.wall_s),
      json_text(name_of(s.status)), json_text(s.message));
}

#ifndef SHEARFRONT_DIGITS
std::string array(const std::vector<double>& xs) {
  std::string all = "[";
  for (const double x : xs) {
    if (all.size() > 1) all += ", ";
    all += json_number(x);
  }
  return all + "]";
}

/// One array per time, of one entry of the samples.
void write_matrix(OutputFile& file, std::string_view name, const std::vector<Sample>& samples,
                  std::size_t n_times, double Sample::*entry) {
  const std::size_t n_depths = n_times == 0 ? 0 : samples.size() / n_times;
  file.write(fmt::format("  {}: [", json_text(name)));
  std::vector<double> row(n_depths);
  for (std::size_t i = 0; i < n_times; ++i) {
    for (std::size_t j = 0; j < n_depths; ++j) row[j] = samples[i * n_depths + j].*entry;
    file.write((i == 0 ? "\n    " : ",\n    ") + array(row));
  }
  file.write("\n  ],\n");
}

#endif
}  // namespace

#ifndef SHEARFRONT_DIGITS
void write_samples_json(OutputFile& file, std::string_view scene, std::string_view method,
                        const std::vector<double>& times, const std::vector<double>& depths,
                        const std::vector<Sample>& samples, const Summary& summary) {
  file.write(fmt::format("{{\n  \"scene\": {},\n  \"method\": {},\n  \"times\": {},\n  \"depths\": {},\n",
                         json_text(scene), json_text(method), array(times), array(depths)));
  write_matrix(file, "phi", samples, times.size(), &Sample::phi);
  write_matrix(file, "M", samples, times.size(), &Sample::M);
  file.write(fmt::format("  \"summary\": {}\n}}\n", summary_text(summary)));
}

void write_time_table_json(OutputFile& file, std::string_view scene, std::string_view method,
                           const TimeTable& table, std::string_view extra, const Summary& summary) {
  file.write(fmt::format("{{\n  \"scene\": {},\n  \"method\": {},\n  \"times\": {},\n", json_text(scene),
                         json_text(method), array(table.times)));
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    std::vector<double> column;
    for (const std::vector<double>& row : table.rows) column.push_back(row[j]);
    file.write(fmt::format("  {}: {},\n", json_text(table.columns[j]), array(column)));
  }
  if (!extra.empty()) file.write(fmt::format("  {},\n", extra));
  file.write(fmt::format("  \"summary\": {}\n}}\n", summary_text(summary)));
}
#endif

template <Real S>
void write_events_json(OutputFile& file, std::string_view scene, std::string_view method,
                       const Timeline<S>& timeline, const Summary& summary, int digits) {
  file.write(
      fmt::format("{{\n  \"scene\": {},\n  \"method\": {},\n  \"mass\": {},\n  \"steady_height\": {},\n",
                  json_text(scene), json_text(method), json_number(timeline.mass, digits),
                  json_number(timeline.steady_height, digits)));
  file.write(fmt::format("  \"t0\": {},\n  \"t1\": {},\n  \"t_star\": {},\n  \"interfaces\": [",
                         json_number(timeline.t0, digits), json_number(timeline.t1, digits),
                         json_number(timeline.t_star, digits)));
  const char* separator = "\n";
  for (const auto& interface : timeline.interfaces) {
    file.write(fmt::format("{}    {{\"z\": {}, \"first\": {}, \"last\": {}}}", separator,
                           json_number(interface.z, digits), json_number(interface.first, digits),
                           json_number(interface.last, digits)));
    separator = ",\n";
  }
  file.write(fmt::format("{}],\n  \"summary\": {}\n}}\n", timeline.interfaces.empty() ? "" : "\n  ",
                         summary_text(summary)));
}

template void write_events_json(OutputFile&, std::string_view, std::string_view,
                                const Timeline<Instantiated>&, const Summary&, int);

}  // namespace shearfront
