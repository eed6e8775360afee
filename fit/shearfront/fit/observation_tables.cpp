// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/observation_tables.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace shearfront::fit {
namespace {

using detail::TableReader;
using Need = TableReader::Need;

/// Which column of the observations is which: phi = "conc".
void read_columns(TableReader& table, ObservationFormat& format) {
  for (std::size_t c = 0; c < kColumnNames.size(); ++c)
    if (auto name = table.text(kColumnNames[c], Need::optional, "must be the name of a column"))
      format.columns[c].name = std::move(*name);
  table.finish();
}

/// How the file of observations is written, where it is not to be found out.
void read_dialect(TableReader& table, const std::function<void(Complaint)>& refuse,
                  ObservationFormat& format) {
  const auto is_one = [&](const char* key, const std::vector<std::string>& names) -> std::optional<char> {
    const auto name = table.choice(key, Need::optional, names);
    return name ? std::optional(*name == "tab" ? '\t' : (*name)[0]) : std::nullopt;
  };
  format.separator = is_one("separator", {",", ";", "tab"});
  format.decimal = is_one("decimal", {".", ","});
  if (table.node("missing"))
    format.missing = table.texts("missing", Need::optional, "must be an array of words");
  if (const auto i = table.place("layout", Need::optional, kTableLayoutNames))
    format.layout = static_cast<TableLayout>(*i);
  if (const auto i = table.place("replicates", Need::optional, kReplicatesNames))
    format.replicates = static_cast<shearfront::Replicates>(*i);
  const auto positive = [&](std::string_view key, std::optional<double>& value) {
    if (!table.node(key)) return;
    table.number(key, Need::optional, value.emplace());
    if (table.is_good(key) && !(*value > 0 && std::isfinite(*value)))
      refuse({table.path(key), "", "must be > 0"});
  };
  positive("width", format.width);
  positive("time_step", format.time_step);
  if (auto units = table.table("units", Need::optional, "must be a table of units of columns")) {
    for (std::size_t c = 0; c < kColumnNames.size(); ++c)
      if (auto unit = units->text(kColumnNames[c], Need::optional, "must be the name of a unit"))
        format.columns[c].unit = std::move(*unit);
    units->finish();
  }
  table.finish();
}

}  // namespace

void read_observation_format(TableReader& root, const std::function<void(Complaint)>& refuse,
                             ObservationFormat& format) {
  if (auto table = root.table("columns", Need::optional, "must be a table of names of columns"))
    read_columns(*table, format);
  if (auto table = root.table("format", Need::optional, "must be a table with separator, decimal, ..."))
    read_dialect(*table, refuse, format);
}

}  // namespace shearfront::fit
