// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shearfront/io/output_file.hpp"
#include "shearfront/scene/scene_spec.hpp"
#include "shearfront/solution/field.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/solver/solver.hpp"

/// Results as CSV and JSON (docs/reference/formats). With the units of the scene headers read "t [s],z [mm],phi,M [mm]" and JSON
/// has "units":{"z","t"}. Doubles are written with the shortest text that reads back to the
/// same number; what is not a finite number is null in JSON and empty in CSV. Errors: FileError from the
/// file.
namespace shearfront {

/// "t [s],z [mm],phi": names of columns with their units; of t (x in a chute), z, x, M, H, width and what begins with t_, z_, M_.
[[nodiscard]] std::string csv_header(const std::vector<std::string>& names, const SceneUnits& units);

/// Header t,z,phi,M and one row per time and depth; samples as in SolverResult.
void write_samples_csv(OutputFile& file, const std::vector<double>& times, const std::vector<double>& depths,
                       const std::vector<Sample>& samples, const SceneUnits& units = {});

/// phi of a slab: phi[i][k * z.size() + j] belongs to times[i], x[k], z[j].
struct SlabSamples {
  std::vector<double> times, x, z;
  std::vector<std::vector<double>> phi;
};
/// Header t,x,z,phi, one row per time and place, z running fastest; x in the unit of z.
void write_slab_csv(OutputFile& file, const SlabSamples& samples, const SceneUnits& units = {});
/// {"scene","method","times","positions","depths","phi":[[[..]]],"summary"}, by time, position and depth.
void write_slab_json(OutputFile& file, std::string_view scene, std::string_view method,
                     const SlabSamples& samples, const Summary& summary, const SceneUnits& units = {});

/// Header layer,t_begin,z_begin,t_end,z_end,phi_below,phi_above and one row per front.
void write_fronts_csv(OutputFile& file, const std::vector<FrontSegment<double>>& fronts,
                      const SceneUnits& units = {});

/// Where a number lies with 95 %, infinity: never; and its standard error, where that is by derivatives.
struct ResultBand {
  std::optional<std::pair<double, double>> ends;
  std::optional<double> std_error;
};
/// Bands of samples, in their order.
struct SampleBands {
  std::vector<ResultBand> phi, M;
};

/// {"scene","method","times","depths","phi":[[..]],"M":[[..]],"summary"}, one inner array per time. With bands also
/// "ci95":{"phi":[[[low,high],..]],"M"} and "std_error":{"phi":[[..]],"M"}; null: by draws.
void write_samples_json(OutputFile& file, std::string_view scene, std::string_view method,
                        const std::vector<double>& times, const std::vector<double>& depths,
                        const std::vector<Sample>& samples, const Summary& summary,
                        const SceneUnits& units = {}, const SampleBands& bands = {});

/// What belongs to a whole bed, as a function of time: one row per time, with the names of its columns.
struct TimeTable {
  std::vector<std::string> columns;  ///< names, without t
  std::vector<double> times;
  std::vector<std::vector<double>> rows;
};

/// Header t and the columns, one row per time.
void write_time_table_csv(OutputFile& file, const TimeTable& table, const SceneUnits& units = {});

/// {"scene","method","times", one array per column, `extra`:{its numbers by name} if there are any, "summary"}.
struct NamedNumbers {
  std::string name;
  std::vector<std::pair<std::string, double>> numbers;
};
void write_time_table_json(OutputFile& file, std::string_view scene, std::string_view method,
                           const TimeTable& table, const NamedNumbers& extra, const Summary& summary,
                           const SceneUnits& units = {});

/// Between which event times lie with 95 %.
struct EventBands {
  struct InterfaceBands {
    ResultBand first, last;
  };
  ResultBand t0, t1, t_star;
  std::vector<InterfaceBands> interfaces;
};

/// {"scene","method","mass","steady_height","t0","t1","t_star","interfaces":[{"z","first","last"}],"summary"}.
/// A time that never comes is null; numbers have the digits that they have in `timeline`. With bands also
/// "ci95":{"t0":[low,high],"t1","t_star","interfaces":[{"first","last"}]} and, as numbers, "std_error"; null: by draws.
void write_events_json(OutputFile& file, std::string_view scene, std::string_view method,
                       const TimelineText& timeline, const Summary& summary, const EventBands& bands = {},
                       const SceneUnits& units = {});

}  // namespace shearfront
