// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include "report.hpp"
#include "shearfront/io/observations_csv.hpp"

/// Property of the reader of observations: any bytes give observations that keep what the header promises and
/// read back from their own text to the bit, or a FileError that can be shown as it is.
namespace {

using namespace shearfront;
using fuzz::require;

void check_promises(const Observations& data, double bottom, double top, Replicates replicates) {
  require(!data.rows.empty(), "at least one row");
  std::set<std::array<double, 3>> places;
  for (const Observation& o : data.rows) {
    require(std::isfinite(o.t) && o.t >= 0, "t >= 0");
    require(std::isfinite(o.z) && o.z >= bottom && o.z <= top, "z inside the domain");
    require(std::isfinite(o.value), "a finite value");
    require(places.insert({o.t, o.z, o.width}).second || replicates == Replicates::kept, "no place twice");
    require(data.has_sigma() ? o.sigma > 0 && std::isfinite(o.sigma) : std::isnan(o.sigma),
            "sigma everywhere or nowhere");
    if (data.quantity != Quantity::bin) {
      require(o.width == 0, "no width without bins");
      continue;
    }
    require(o.width > 0 && is_bin_inside(o.z, o.width, bottom, top), "bins inside the domain");
    const BinEdges edges = bin_edges(o.z, o.width, bottom, top);
    require(edges.width() > 0 && std::isfinite(edges.width()), "bins with an inside");
  }
}

void check_round_trip(const Observations& data, double bottom, double top) {
  const std::string text = observations_text(data);
  const Observations again = parse_observations(text, "again.csv", bottom, top);
  require(observations_text(again) == text, "the same text again");
  require(
      again.rows.size() == data.rows.size() && again.comments == data.comments && again.units == data.units,
      "the same rows, comments and units again");
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    const Observation &a = data.rows[i], &b = again.rows[i];
    require(a.t == b.t && a.z == b.z && a.value == b.value && a.width == b.width, "the same numbers again");
  }
}

void check(const std::string& text, double bottom, double top) {
  try {
    const Observations data = parse_observations(text, "fuzz.csv", bottom, top);
    check_promises(data, bottom, top, Replicates::refused);
    check_round_trip(data, bottom, top);
  } catch (const FileError& error) {
    require(!std::string(error.what()).starts_with("again.csv:"), "own text is accepted");
    fuzz::check_report(error, "fuzz.csv");
  }
}

/// A laboratory's words about its file, drawn from the bytes: every separator, layout and way with replicates.
ObservationFormat format_of(const std::string& text) {
  std::size_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  const auto draw = [&](std::size_t n) {
    hash = hash * 6364136223846793005U + 1442695040888963407U;
    return (hash >> 33) % n;
  };
  ObservationFormat format;
  if (draw(2) == 0) format.separator = ",;\t"[draw(3)];
  if (draw(2) == 0) format.decimal = ".,"[draw(2)];
  if (draw(2) == 0) format.layout = static_cast<TableLayout>(draw(kTableLayoutNames.size()));
  format.replicates = static_cast<Replicates>(draw(kReplicatesNames.size()));
  if (draw(3) == 0) format.missing = {"x", "0.5"};
  if (draw(3) == 0) format.width = 0.01;
  if (draw(3) == 0) format.time_step = 0.5;
  if (draw(3) == 0) format[Column::phi].unit = "%";
  if (draw(4) == 0) format[Column::z] = {"height", "mm"};
  if (draw(4) == 0) format[Column::t].name = "time";
  return format;
}

void check_in_words(const std::string& text) {
  const ObservationFormat format = format_of(text);
  try {
    const Observations data = parse_observations(text, "fuzz.csv", 0, 1, format);
    check_promises(data, 0, 1, format.replicates);
    if (format.replicates != Replicates::kept) check_round_trip(data, 0, 1);
  } catch (const FileError& error) {
    require(!std::string(error.what()).starts_with("again.csv:"), "own text is accepted");
    fuzz::check_report(error, "fuzz.csv");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check(text, 0, 1);
  check(text, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
  check_in_words(text);
  return 0;
}
