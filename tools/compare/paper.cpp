// SPDX-License-Identifier: BSD-3-Clause
#include "compare/paper.hpp"

#include <fmt/format.h>

#include <array>

#include "cli/method.hpp"
#include "cli/table.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

// Table 1: delta, then t_c, t_0, t_1, t^_c, t*.
struct PaperEvents {
  double delta;
  std::array<double, 5> times;
};
constexpr std::array<PaperEvents, 5> kTable1{{{0.1, {1.0502, 1.1772, 2.4998, 3.9503, 5.0000}},
                                              {0.01, {0.6788, 0.8000, 1.6145, 4.9378, 6.2500}},
                                              {0.001, {0.6842, 0.8055, 1.6286, 5.0402, 6.4935}},
                                              {0.0001, {0.6778, 0.7990, 1.6133, 5.0043, 6.4516}},
                                              {0.00005, {0.6777, 0.7989, 1.6130, 5.0055, 6.4516}}}};

// Table 2: delta (or dz), then L1 error and CPU seconds at t = 0.5 and at t = 6. (The title of the printed
// table says t = 0.6, its columns and the text t = 0.5.)
struct PaperError {
  double l1 = 0, cpu_s = 0;  // 0: interrupted before
};
struct PaperErrors {
  double step;
  std::array<PaperError, 2> tracking, engquist_osher;
};
constexpr std::array<double, 2> kTimes{0.5, 6};
constexpr std::array<PaperErrors, 4> kTable2{
    {{0.005, {{{6.52e-3, 0.7428}, {3.26e-2, 0.7251}}}, {{{8.71e-3, 0.2605}, {6.39e-2, 1.2517}}}},
     {0.0025, {{{2.80e-3, 0.7903}, {2.54e-3, 0.7587}}}, {{{5.34e-3, 0.9925}, {6.10e-2, 4.3003}}}},
     {0.0005, {{{6.87e-4, 1.1649}, {2.54e-3, 1.2494}}}, {{{1.58e-3, 18.6119}, {5.87e-2, 98.2629}}}},
     {0.00025, {{{3.69e-4, 1.5263}, {1.48e-3, 1.6092}}}, {{{9.11e-4, 69.8097}, {5.81e-2, 389.3088}}}}}};

Scene<double> example_1() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

std::vector<std::string> event_row(std::string delta, std::string_view who, const std::array<double, 5>& t,
                                   int digits) {
  std::vector<std::string> row{std::move(delta), std::string(who)};
  for (const double time : t) row.push_back(fmt::format("{:.{}f}", time, digits));
  return row;
}

std::array<double, 5> five_times(const Timeline<double>& t) {
  return {*t.interfaces.at(0).first, *t.t0, *t.t1, *t.interfaces.at(0).last, *t.t_star};
}

std::array<double, 5> tracked_times(const Scene<double>& scene, GridKind grid, double resolution) {
  FrontTrackingSolver::Options tracking;
  tracking.grid = grid;
  tracking.resolution = resolution;
  SolverRequest request;
  request.timeline = true;
  return five_times(*shearfront::solve<FrontTrackingSolver>(scene, request, tracking).timeline);
}

std::string events_table(const Scene<double>& scene) {
  TextTable table({"delta", "front tracking", "t_c", "t_0", "t_1", "t^_c", "t*"});
  for (const PaperEvents& row : kTable1) {
    const std::string delta = fmt::format("{}", row.delta);
    table.add(event_row(delta, "paper", row.times, 4));
    table.add(event_row(delta, "singular-mapping, 4 delta",
                        tracked_times(scene, GridKind::singular_mapping, 4 * row.delta), 4));
    table.add(event_row(delta, "levels, 4 delta", tracked_times(scene, GridKind::levels, 4 * row.delta), 6));
  }
  table.add(event_row("", "exact", five_times(exact_timeline(scene)), 6));
  return table.text();
}

/// One row of Table 2: errors and seconds at both times.
std::vector<std::string> error_row(std::string step, std::string who,
                                   const std::array<PaperError, 2>& errors) {
  std::vector<std::string> row{std::move(step), std::move(who)};
  for (const PaperError& e : errors) {
    const bool is_done = e.cpu_s > 0;
    row.push_back(is_done ? fmt::format("{:.2e}", e.l1) : "");
    row.push_back(is_done ? fmt::format("{:.3g} s", e.cpu_s) : "");
  }
  return row;
}

std::array<PaperError, 2> ours(const Scene<double>& scene, const Contestant& contestant, double rung,
                               const RaceLimits& limits) {
  const ExactSolution<double> exact(scene);
  Ladders ladders;
  ladders.cells = ladders.resolutions = {rung};
  std::array<PaperError, 2> errors{};
  for (std::size_t i = 0; i < kTimes.size(); ++i) {
    const Panel panel = race(scene, exact, kTimes[i], {contestant}, ladders, limits);
    if (panel.courses[0].rungs.empty()) continue;
    errors[i] = {panel.courses[0].rungs[0].l1_error, panel.courses[0].rungs[0].wall_s};
  }
  return errors;
}

std::string errors_table(const Scene<double>& scene, const RaceLimits& limits) {
  const std::string names =
      "front-tracking:singular-mapping,front-tracking,front-tracking:linear,engquist-osher";
  const auto methods = contestants_of("--methods", &names);
  const std::array<const char*, 4> labels{"singular-mapping, 4 delta", "levels, 4 delta",
                                          "levels, 4 delta, linear", "Engquist-Osher, consistent"};
  TextTable table({"delta, dz", "method", "L1(0.5)", "time", "L1(6)", "time"});
  for (const PaperErrors& row : kTable2) {
    const std::string step = fmt::format("{}", row.step);
    table.add(error_row(step, "paper, front tracking", row.tracking));
    for (std::size_t i = 0; i < 3; ++i)
      table.add(error_row(step, labels[i], ours(scene, methods[i], 4 * row.step, limits)));
  }
  for (const PaperErrors& row : kTable2) {
    const std::string step = fmt::format("{}", row.step);
    table.add(error_row(step, "paper, Engquist-Osher as printed", row.engquist_osher));
    table.add(error_row(step, labels[3], ours(scene, methods[3], 1 / row.step, limits)));
  }
  return table.text();
}

}  // namespace

std::string paper_text(const RaceLimits& limits) {
  const Scene<double> scene = example_1();
  return fmt::format(
      "Buerger, Martinez & Villada (2023), Example 1, and this program\n\n"
      "Table 1: event times\n\n{}\n"
      "Table 2: L1 errors and times at t = 0.5 and t = 6\n\n{}",
      events_table(scene), errors_table(scene, limits));
}

}  // namespace shearfront::tools
