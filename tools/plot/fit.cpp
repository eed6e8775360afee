// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/fit_text.hpp"
#include "plot/pictures.hpp"
#include "shearfront/fit/rate_band.hpp"
#include "shearfront/fit/residual_rows.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kMostProfiles = 6;                        // more times than this are shown as maps
constexpr std::size_t kDrawnHeights = 2001, kDrawnTimes = 401;  // finer than a panel can show

void set_common(Picture& picture, const std::string& title, const fit::FitSpec& spec,
                const fit::Estimate& estimate) {
  const Observations& data = spec.observations;
  const bool is_cumulative = data.quantity == Quantity::cumulative;
  const StateRange<double> states =
      is_cumulative ? StateRange<double>{0, std::max(estimate.scene->mass(), 1e-300)} : states_of(spec.scene);
  picture.set("title", printable(title, 120));
  picture.set("subtitle", described(spec.forward.method, *estimate.scene));
  constexpr std::size_t kMostEstimates = 7;
  std::string estimates;
  for (const fit::ParameterEstimate& p : estimate.parameters)
    estimates +=
        fmt::format("{}{}={:.4g}{}", estimates.empty() ? "" : " ", p.name.substr(p.name.find('.') + 1),
                    p.estimate, p.std_error ? fmt::format("±{:.2g}", *p.std_error) : "");
  picture.set("estimates", estimate.parameters.size() > kMostEstimates ? "" : estimates);
  picture.set("symbol", is_cumulative ? "{/:Italic M}" : "{/:Italic φ}");
  picture.set("along", spec.scene.spec().units.symbol());
  picture.set("unit_t", without_markup(data.units.t));
  picture.set("unit_z", without_markup(data.units.z));
  picture.set("unit_value", without_markup(data.units.value));
  picture.set("z_low", spec.scene.bottom());
  picture.set("z_high", spec.scene.top());
  picture.set("value_low", states.lowest);
  picture.set("value_high", states.highest);
  picture.set("has_sigma", data.has_sigma());
  const double width = data.rows.front().width;
  const auto is_as_wide = [&](const Observation& o) { return o.width == width; };
  picture.set("bin_width", std::all_of(data.rows.begin(), data.rows.end(), is_as_wide) ? width : 0);
  picture.add_file("residuals.csv", [&](OutputFile& file) { write_residuals_csv(file, data, estimate); });
}

void add_profiles(Picture& picture, const fit::FitSpec& spec, const fit::Estimate& estimate,
                  const std::vector<double>& times) {
  SolverRequest request;
  request.times = times;
  request.heights = equally_spaced(spec.scene.bottom(), spec.scene.top(), kDrawnHeights);
  SolverResult result = solve(*estimate.scene, spec.forward.method, request);
  if (!result.summary.usable())
    result.samples.assign(times.size() * kDrawnHeights, {std::nan(""), std::nan("")});
  picture.set("times", times);
  picture.set("fitted", spec.observations.quantity == Quantity::cumulative ? "M" : "phi");
  picture.add_file("fitted.csv", [&](OutputFile& file) {
    write_samples_csv(file, times, request.heights, result.samples);
  });
}

void add_bed_heights(Picture& picture, const fit::FitSpec& spec, const fit::Estimate& estimate) {
  double t_end = 0;
  for (const Observation& o : spec.observations.rows) t_end = std::max(t_end, o.t);
  if (!(t_end > 0)) t_end = 1;
  const BedCourse course = bed_course(SolvedQuantity::bed_height, *estimate.scene, spec.forward.method,
                                      equally_spaced(0, t_end, kDrawnTimes));
  picture.add_file("fitted.csv", [&](OutputFile& file) { write_time_table_csv(file, course.table); });
}

/// Cells around the distinct ones of some coordinates: edges midway between neighbours, the outermost cells
/// symmetric but inside [low, high]. Neighbouring cells are joined until at most kMostCells are left.
struct CellAxis {
  static constexpr std::size_t kMostCells = 120;  // more of them are narrower than a printed dot
  std::vector<double> edges;
  std::size_t n_distinct = 0;

  CellAxis(const std::vector<Observation>& rows, double Observation::*coordinate, double low, double high) {
    std::vector<double> all, x;
    for (const Observation& o : rows) all.push_back(o.*coordinate);
    std::sort(all.begin(), all.end());
    const double same = 1e-9 * (all.back() - all.front());
    for (const double c : all)
      if (x.empty() || c - x.back() > same) x.push_back(c);
    n_distinct = x.size();
    if (x.size() == 1) {
      edges = {low, high};
      return;
    }
    const std::size_t stride = (x.size() + kMostCells - 1) / kMostCells, last = x.size() - 1;
    edges = {std::max(low, x[0] - (x[1] - x[0]) / 2)};
    for (std::size_t i = stride; i < x.size(); i += stride) edges.push_back((x[i - 1] + x[i]) / 2);
    edges.push_back(std::min(high, x[last] + (x[last] - x[last - 1]) / 2));
  }
  [[nodiscard]] std::size_t cell_of(double x) const {
    const auto inner = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
    return static_cast<std::size_t>(inner - edges.begin()) - 1;
  }
};

struct Cell {
  double t_low = 0, t_high = 0, z_low = HUGE_VAL, z_high = -HUGE_VAL, observed = 0, predicted = 0, n = 0;
};

void add_maps(Picture& picture, const fit::FitSpec& spec, const fit::Estimate& estimate) {
  constexpr double kGridShare = 0.5;  // data that fill less than this of times x heights are no grid
  constexpr std::size_t kLeastHeights = 3;
  const std::vector<Observation>& data = spec.observations.rows;
  const CellAxis times(data, &Observation::t, 0, std::numeric_limits<double>::infinity());
  const CellAxis heights(data, &Observation::z, spec.scene.bottom(), spec.scene.top());
  const double n_places = static_cast<double>(times.n_distinct) * static_cast<double>(heights.n_distinct);
  const bool are_cells =
      static_cast<double>(data.size()) >= kGridShare * n_places && heights.n_distinct >= kLeastHeights;
  std::map<std::pair<std::size_t, std::size_t>, Cell> cells;
  for (std::size_t k = 0; k < data.size(); ++k) {
    const Observation& o = data[k];
    const std::size_t i = are_cells ? times.cell_of(o.t) : k, j = are_cells ? heights.cell_of(o.z) : 0;
    Cell& cell = cells[{i, j}];
    const double reach = !are_cells ? 0 : o.width > 0 ? o.width / 2 : HUGE_VAL;  // a bin ends at its edges
    cell.t_low = are_cells ? times.edges[i] : o.t;
    cell.t_high = are_cells ? times.edges[i + 1] : o.t;
    cell.z_low = std::min(cell.z_low, std::max(are_cells ? heights.edges[j] : o.z, o.z - reach));
    cell.z_high = std::max(cell.z_high, std::min(are_cells ? heights.edges[j + 1] : o.z, o.z + reach));
    cell.observed += o.value;
    cell.predicted += estimate.predicted[k];
    cell.n += 1;
  }
  picture.set("are_cells", are_cells);
  picture.set("have_gaps", are_cells && cells.size() < (times.edges.size() - 1) * (heights.edges.size() - 1));
  picture.add_file("cells.csv", [&](OutputFile& file) {
    std::string rows = "t,z,t_low,t_high,z_low,z_high,observed,predicted\n";
    for (const auto& [place, c] : cells)
      rows += csv_row({(c.t_low + c.t_high) / 2, (c.z_low + c.z_high) / 2, c.t_low, c.t_high, c.z_low,
                       c.z_high, c.observed / c.n, c.predicted / c.n});
    file.write(rows);
  });
}

void add_curve(Picture& picture, std::string_view file_name, const std::vector<fit::RateRow>& rows) {
  picture.add_file(file_name, [&](OutputFile& file) {
    file.write("z,a\n");
    for (const fit::RateRow& row : rows) file.write(csv_row({row.z, row.a}));
  });
}

void add_rate(Picture& picture, const fit::FitSpec& spec, const fit::Estimate& estimate) {
  const fit::RateBand band = fit::rate_band(fit::Parameters(spec.scene, spec.unknown), estimate);
  picture.set("is_rate_unknown", band.is_unknown);
  const bool is_scaled = estimate.scene->scale() != 1 || spec.scene.scale() != 1;
  picture.set("band_name", band.n_replicates > 0 ? "95 % by bootstrap" : "95 % band");
  picture.set("rate_symbol", is_scaled ? "{/:Italic s} {/:Italic a}" : "{/:Italic a}");
  // The shortest texts that read back: equal ends of a band are equal texts.
  picture.add_file("rate.csv", [&](OutputFile& file) {
    file.write("z,a,lower,upper\n");
    for (const fit::RateRow& row : band.rows)
      file.write(
          csv_row({row.z, row.a, row.band ? row.band->low : HUGE_VAL, row.band ? row.band->high : HUGE_VAL}));
  });
  add_curve(picture, "start.csv", band.start);
  picture.add_file("interfaces.csv", [&](OutputFile& file) {
    file.write("z_lower,z_upper,a_lower,a_upper\n");
    for (const fit::InterfaceBand& at : band.interfaces)
      file.write(csv_row({at.z.low, at.z.high, at.a.low, at.a.high}));
  });
}

void add_search(Picture& picture, const fit::Estimate& estimate) {
  const std::vector<fit::SearchStep>& steps = estimate.steps;
  picture.set("has_search", !steps.empty());
  picture.add_file("search.csv", [&](OutputFile& file) {
    file.write("evaluations,misfit,stage\n");
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto row = [&](std::size_t evaluations) {
        file.write(fmt::format("{},{:.9g},{}\n", evaluations, steps[i].misfit, steps[i].stage));
      };
      row(steps[i].evaluations);
      const bool is_last = i + 1 == steps.size();
      if (!is_last && steps[i + 1].stage == steps[i].stage) continue;
      const std::size_t end = is_last ? estimate.evaluations : steps[i + 1].evaluations - 1;
      if (end > steps[i].evaluations) row(end);
    }
  });
}

}  // namespace

int draw_fit(const std::string& path, const fit::FitSpec& spec, const fit::Estimate& estimate,
             const std::string& title, const std::optional<Scene<double>>& truth,
             const std::vector<OtherModel>& others) {
  if (!estimate.usable()) {
    note(fmt::format("no picture {}: the fit has no usable estimate", printable(path)));
    return kNoResult;
  }
  std::vector<double> times;
  for (const fit::MeasuredProfile& profile : fit::measured_profiles(spec.observations))
    times.push_back(profile.t);
  const bool are_heights = spec.observations.quantity == Quantity::bed_height;
  const bool are_profiles = !are_heights && times.size() <= kMostProfiles;
  Picture picture(path, "fit");
  picture.set("data", are_heights ? "heights" : are_profiles ? "profiles" : "maps");
  set_common(picture, title, spec, estimate);
  if (are_heights)
    add_bed_heights(picture, spec, estimate);
  else if (are_profiles)
    add_profiles(picture, spec, estimate, times);
  else
    add_maps(picture, spec, estimate);
  add_rate(picture, spec, estimate);
  picture.set("has_truth", truth.has_value());
  if (truth) add_curve(picture, "truth.csv", fit::rate_rows(*truth));
  picture.set("n_models", static_cast<double>(others.size()));
  picture.set("model_name_0", spec.name);
  for (std::size_t i = 0; i < others.size(); ++i) {
    picture.set(fmt::format("model_name_{}", i + 1), without_markup(others[i].name));
    add_curve(picture, fmt::format("model{}.csv", i + 1), fit::rate_rows(others[i].scene));
  }
  add_search(picture, estimate);
  if (!others.empty()) picture.set("has_search", false);
  return picture.draw();
}

}  // namespace shearfront::tools
