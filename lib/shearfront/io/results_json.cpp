// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/json.hpp"
#include "shearfront/io/results.hpp"

namespace shearfront {
namespace {

using detail::Json;
using detail::json_digits;
using detail::json_text;

Json to_json(const Summary& s) {
  Json all = {{"collisions", s.collisions}, {"fronts_max", s.fronts_max},
              {"levels", s.levels},         {"cell_updates", s.cell_updates},
              {"wall_s", s.wall_s},         {"status", name_of(s.status)},
              {"message", s.message}};
  if (!s.remark.empty()) all["remark"] = s.remark;
  if (s.rest_time) all["rest_time"] = *s.rest_time;
  return all;
}

Json units_json(const SceneUnits& units) { return {{"z", units.z}, {units.symbol(), units.t}}; }
/// "times", or the distances of a chute.
std::string places_key(const SceneUnits& units) { return units.is_chute ? "distances" : "times"; }
/// "t_star", or "x_star".
std::string event_key(const SceneUnits& units, const std::string& index) { return units.symbol() + index; }

Json document(std::string_view scene, std::string_view method, const SceneUnits& units) {
  Json all;
  all["scene"] = scene;
  all["method"] = method;
  if (units.are_given()) all["units"] = units_json(units);
  return all;
}

/// Pairs of numbers, too.
std::string in_one_line(const Json& row) {
  if (row.empty() || !row.front().is_array()) return json_text(row);
  std::string text;
  for (const Json& entry : row) text += (text.empty() ? "[" : ", ") + json_text(entry);
  return text + "]";
}

/// One array per time, of what entry(k) says of the k-th of n numbers; of large results never more than a row in memory.
template <class EntryOf>
void write_matrix(OutputFile& file, std::string_view name, std::size_t n, std::size_t n_times,
                  const EntryOf& entry, const std::string& indent, const char* end) {
  const std::size_t n_depths = n_times == 0 ? 0 : n / n_times;
  file.write(indent + json_text(name) + ": [");
  for (std::size_t i = 0; i < n_times; ++i) {
    Json row = Json::array();
    for (std::size_t j = 0; j < n_depths; ++j) row.push_back(entry(i * n_depths + j));
    file.write((i == 0 ? "\n  " : ",\n  ") + indent + in_one_line(row));
  }
  file.write("\n" + indent + "]" + end);
}

Json ends_json(const ResultBand& band) {
  return band.ends ? Json::array({band.ends->first, band.ends->second}) : Json();
}
Json error_json(const ResultBand& band) { return detail::json_or_null(band.std_error); }

/// "ci95" or "std_error" of phi and M.
void write_bands(OutputFile& file, std::string_view name, const SampleBands& bands, std::size_t n_times,
                 Json (*entry)(const ResultBand&)) {
  file.write("  " + json_text(name) + ": {\n");
  const auto write = [&](const char* key, const std::vector<ResultBand>& all, const char* end) {
    write_matrix(
        file, key, all.size(), n_times, [&](std::size_t k) { return entry(all[k]); }, "    ", end);
  };
  write("phi", bands.phi, ",\n");
  write("M", bands.M, "\n  },\n");
}

}  // namespace

void write_samples_json(OutputFile& file, std::string_view scene, std::string_view method,
                        const std::vector<double>& times, const std::vector<double>& depths,
                        const std::vector<Sample>& samples, const Summary& summary, const SceneUnits& units,
                        const SampleBands& bands) {
  const std::string in_units =
      units.are_given() ? ",\n  \"units\": " + json_text(units_json(units)) : std::string();
  file.write("{\n  \"scene\": " + json_text(scene) + ",\n  \"method\": " + json_text(method) + in_units +
             ",\n  " + json_text(places_key(units)) + ": " + json_text(times) +
             ",\n  \"depths\": " + json_text(depths) + ",\n");
  const std::size_t n = samples.size(), n_times = times.size();
  write_matrix(
      file, "phi", n, n_times, [&](std::size_t k) { return samples[k].phi; }, "  ", ",\n");
  write_matrix(
      file, "M", n, n_times, [&](std::size_t k) { return samples[k].M; }, "  ", ",\n");
  if (!bands.phi.empty()) {
    write_bands(file, "ci95", bands, n_times, ends_json);
    write_bands(file, "std_error", bands, n_times, error_json);
  }
  file.write("  \"summary\": " + json_text(to_json(summary)) + "\n}\n");
}

void write_slab_json(OutputFile& file, std::string_view scene, std::string_view method,
                     const SlabSamples& samples, const Summary& summary, const SceneUnits& units) {
  Json all = document(scene, method, units);
  all["times"] = samples.times;
  all["positions"] = samples.x;
  all["depths"] = samples.z;
  Json& phi = all["phi"] = Json::array();
  const auto n = static_cast<std::ptrdiff_t>(samples.z.size());
  for (const std::vector<double>& at_time : samples.phi) {
    Json frame = Json::array();
    for (auto column = at_time.begin(); column != at_time.end(); column += n)
      frame.push_back(std::vector<double>(column, column + n));
    phi.push_back(std::move(frame));
  }
  all["summary"] = to_json(summary);
  file.write(detail::json_document(all));
}

void write_time_table_json(OutputFile& file, std::string_view scene, std::string_view method,
                           const TimeTable& table, const NamedNumbers& extra, const Summary& summary,
                           const SceneUnits& units) {
  Json all = document(scene, method, units);
  all[places_key(units)] = table.times;
  for (std::size_t j = 0; j < table.columns.size(); ++j) {
    Json& column = all[table.columns[j]] = Json::array();
    for (const std::vector<double>& row : table.rows) column.push_back(row[j]);
  }
  for (const auto& [name, number] : extra.numbers) all[extra.name][name] = number;
  all["summary"] = to_json(summary);
  file.write(detail::json_document(all));
}

void write_events_json(OutputFile& file, std::string_view scene, std::string_view method,
                       const TimelineText& timeline, const Summary& summary, const EventBands& bands,
                       const SceneUnits& units) {
  const auto time = [](const std::optional<std::string>& t) { return t ? json_digits(*t) : Json(); };
  Json all = document(scene, method, units);
  all["mass"] = json_digits(timeline.mass);
  all["steady_height"] = json_digits(timeline.steady_height);
  all[event_key(units, "0")] = time(timeline.t0);
  all[event_key(units, "1")] = time(timeline.t1);
  all[event_key(units, "_star")] = time(timeline.t_star);
  Json& interfaces = all["interfaces"] = Json::array();
  for (const auto& at : timeline.interfaces)
    interfaces.push_back({{"z", json_digits(at.z)}, {"first", time(at.first)}, {"last", time(at.last)}});
  if (bands.t_star.ends) {
    const auto add = [&](const char* name, const auto& number) {
      Json& part = all[name];
      part = {{event_key(units, "0"), number(bands.t0)},
              {event_key(units, "1"), number(bands.t1)},
              {event_key(units, "_star"), number(bands.t_star)},
              {"interfaces", Json::array()}};
      for (const auto& at : bands.interfaces)
        part["interfaces"].push_back({{"first", number(at.first)}, {"last", number(at.last)}});
    };
    add("ci95", ends_json);
    add("std_error", error_json);
  }
  all["summary"] = to_json(summary);
  file.write(detail::json_document(all));
}

}  // namespace shearfront
