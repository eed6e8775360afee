// SPDX-License-Identifier: BSD-3-Clause
// Prints tables of docs/evidence/accuracy.md:
//   shearfront_accuracy_tables paper                   Tables 1 and 2 of Buerger, Martinez & Villada (2023)
//   beside ours shearfront_accuracy_tables events SCENE            event times seen by methods that know none
//   shearfront_accuracy_tables rounding SCENE T...     the exact engine against 50 digits, as JSON: [error,
//   ...]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/observed_events.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using Times = std::vector<std::optional<double>>;

/// t_c, t_0, t_1, t^_c, t* of two layers.
Times times_of(const Timeline<double>& timeline) {
  return {timeline.interfaces.at(0).first, timeline.t0, timeline.t1, timeline.interfaces.at(0).last,
          timeline.t_star};
}

// --- paper ----------------------------------------------------------------------------------------------

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
struct Error {
  double l1 = 0, seconds = 0;
};
struct PaperErrors {
  double step;
  std::array<Error, 2> tracking, engquist_osher;
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

void print_events_row(std::string_view delta, std::string_view who, const Times& times, int digits) {
  fmt::print("{:<7} {:<26}", delta, who);
  for (const auto& t : times) fmt::print(" {:<9}", fmt::format("{:.{}f}", *t, digits));
  fmt::print("\n");
}

Times tracked_times(const Scene<double>& scene, GridKind grid, double resolution) {
  SolverRequest request;
  request.timeline = true;
  const auto result = solve<FrontTrackingSolver>(scene, request, {.resolution = resolution, .grid = grid});
  return times_of(*result.timeline);
}

/// Errors and median seconds of a solver at both times.
template <class Solver>
std::array<Error, 2> ours(const Scene<double>& scene, const typename Solver::Options& options) {
  const ExactSolution<double> exact(scene);
  std::array<Error, 2> errors{};
  for (std::size_t i = 0; i < kTimes.size(); ++i) {
    SolverRequest request;
    request.times = {kTimes[i]};
    request.profiles = true;
    std::vector<double> seconds;
    for (int k = 0; k < 5; ++k) {
      const auto begin = std::chrono::steady_clock::now();
      const SolverResult result = solve<Solver>(scene, request, options);
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      errors[i].l1 = errors_against(exact, result.profiles.at(0), kTimes[i]).l1;
    }
    std::sort(seconds.begin(), seconds.end());
    errors[i].seconds = seconds[seconds.size() / 2];
  }
  return errors;
}

void print_errors_row(double step, std::string_view who, const std::array<Error, 2>& errors) {
  fmt::print("{:<9} {:<33}", step, who);
  for (const Error& e : errors) fmt::print(" {:<9.2e} {:<11}", e.l1, fmt::format("{:.3g} s", e.seconds));
  fmt::print("\n");
}

void print_paper() {
  const Scene<double> scene = example_1();
  fmt::print("Buerger, Martinez & Villada (2023), Example 1, and this program\n\nTable 1: event times\n\n");
  fmt::print("{:<7} {:<26} {:<9} {:<9} {:<9} {:<9} {:<9}\n", "delta", "front tracking", "t_c", "t_0", "t_1",
             "t^_c", "t*");
  for (const PaperEvents& row : kTable1) {
    const std::string delta = fmt::format("{}", row.delta);
    print_events_row(delta, "paper", Times(row.times.begin(), row.times.end()), 4);
    print_events_row(delta, "singular-mapping, 4 delta",
                     tracked_times(scene, GridKind::singular_mapping, 4 * row.delta), 4);
    print_events_row(delta, "levels, 4 delta", tracked_times(scene, GridKind::levels, 4 * row.delta), 6);
  }
  print_events_row("", "exact", times_of(exact_timeline(scene)), 6);
  fmt::print("\nTable 2: L1 errors and times at t = 0.5 and t = 6\n\n");
  fmt::print("{:<9} {:<33} {:<9} {:<11} {:<9} {}\n", "delta, dz", "method", "L1(0.5)", "time", "L1(6)",
             "time");
  for (const PaperErrors& row : kTable2) {
    const FrontTrackingSolver::Options levels{.resolution = 4 * row.step};
    FrontTrackingSolver::Options singular = levels, linear = levels;
    singular.grid = GridKind::singular_mapping;
    linear.reconstruct = Reconstruction::linear;
    print_errors_row(row.step, "paper, front tracking", row.tracking);
    print_errors_row(row.step, "singular-mapping, 4 delta", ours<FrontTrackingSolver>(scene, singular));
    print_errors_row(row.step, "levels, 4 delta", ours<FrontTrackingSolver>(scene, levels));
    print_errors_row(row.step, "levels, 4 delta, linear", ours<FrontTrackingSolver>(scene, linear));
  }
  for (const PaperErrors& row : kTable2) {
    EngquistOsherSolver::Options options;
    options.cells = static_cast<std::uint64_t>(std::lround(1 / row.step));
    print_errors_row(row.step, "paper, Engquist-Osher as printed", row.engquist_osher);
    print_errors_row(row.step, "Engquist-Osher, consistent", ours<EngquistOsherSolver>(scene, options));
  }
}

// --- events ---------------------------------------------------------------------------------------------

std::vector<double> equally_spaced(double start, double stop, std::size_t n) {
  std::vector<double> xs;
  for (std::size_t i = 0; i < n; ++i)
    xs.push_back(start + (stop - start) * static_cast<double>(i) / static_cast<double>(n - 1));
  return xs;
}

/// More times in the intervals that hold an event.
std::vector<double> refined(const std::vector<double>& times, const Times& events) {
  constexpr std::size_t kMoreTimes = 16;
  std::vector<double> all = times;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const bool is_hit = std::any_of(events.begin(), events.end(),
                                    [&](const auto& t) { return t && *t >= times[i] && *t <= times[i + 1]; });
    if (!is_hit) continue;
    const auto more = equally_spaced(times[i], times[i + 1], kMoreTimes + 2);
    all.insert(all.end(), more.begin() + 1, more.end() - 1);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Profiles are observed from 0 to the horizon, at 65 times first, then twice at 16 more in every interval
/// where something is seen to happen.
template <class Solver>
Times observed_times(const Scene<double>& scene, const typename Solver::Options& options, double horizon) {
  constexpr std::size_t kFirstTimes = 65;
  SolverRequest request;
  request.times = equally_spaced(0, horizon, kFirstTimes);
  request.profiles = true;
  Times events;
  for (int pass = 0; pass < 3; ++pass) {
    if (pass > 0) request.times = refined(request.times, events);
    SolverResult result = solve<Solver>(scene, request, options);
    events = times_of(support::observed_events(scene, {request.times, std::move(result.profiles)}));
  }
  return events;
}

void print_relative_errors(std::string_view method, double resolution, const Times& times,
                           const Times& exact) {
  fmt::print("| {} | {} |", method, resolution);
  for (std::size_t i = 0; i < times.size(); ++i)
    fmt::print(" {} |", times[i] ? fmt::format("{:+.1e}", *times[i] / *exact[i] - 1) : "not seen");
  fmt::print("\n");
}

void print_events(const char* path) {
  const auto scene = read_scene<double>(path);
  const Times exact = times_of(exact_timeline(scene));
  fmt::print(
      "| method | resolution | t_c | t_0 | t_1 | t^_c | t\\* |\n| --- | --- | --- | --- | --- | --- | --- "
      "|\n");
  for (const double resolution : {0.1, 0.01, 0.001})
    print_relative_errors("front-tracking", resolution, tracked_times(scene, GridKind::levels, resolution),
                          exact);
  const auto print_grid = [&]<class Solver>() {
    for (const std::uint64_t cells : {100U, 400U, 1600U, 6400U}) {
      typename Solver::Options options;
      options.cells = cells;
      print_relative_errors(Solver::kName, static_cast<double>(cells),
                            observed_times<Solver>(scene, options, 1.25 * *exact.back()), exact);
    }
  };
  print_grid.operator()<EngquistOsherSolver>();
  print_grid.operator()<GodunovSolver>();
  print_grid.operator()<MusclSolver>();
}

// --- rounding -------------------------------------------------------------------------------------------

/// int |phi - phi with 50 digits| dz by means over some of 1000 heights: 50 digits take milliseconds each
/// where there are hundreds of layers.
double rounding_error(const Scene<double>& scene, double t) {
  constexpr std::size_t kHeights = 1000, kLeast = 10, kWork = 20'000;
  const ExactSolution<double> exact(scene);
  const ExactSolution<Real110> precise(scene_cast<Real110>(scene));
  const std::size_t most = std::clamp(kWork / std::max<std::size_t>(precise.n_layers(), 1), kLeast, kHeights);
  const std::size_t stride = (kHeights + most - 1) / most;
  const double height = scene.top() - scene.bottom();
  double sum = 0, n = 0;
  for (std::size_t i = stride / 2; i < kHeights; i += stride, ++n) {
    const double z = scene.bottom() + height * ((static_cast<double>(i) + 0.5) / kHeights);
    sum += std::abs(to_double(Real110(precise.phi(Real110(z), Real110(t)) - exact.phi(z, t))));
  }
  return sum / n * height;
}

void print_rounding(const char* path, const std::vector<std::string_view>& times) {
  const auto scene = read_scene<double>(path);
  std::string all;
  for (const std::string_view t : times)
    all += fmt::format("{}{}", all.empty() ? "" : ", ", rounding_error(scene, std::stod(std::string(t))));
  fmt::print("[{}]\n", all);
}

}  // namespace
}  // namespace shearfront

int main(int argc, char** argv) {
  using namespace shearfront;
  const std::string_view part = argc > 1 ? argv[1] : "";
  if (part == "paper" && argc == 2) {
    print_paper();
  } else if (part == "events" && argc == 3) {
    print_events(argv[2]);
  } else if (part == "rounding" && argc > 3) {
    print_rounding(argv[2], {argv + 3, argv + argc});
  } else {
    fmt::print(stderr, "usage: shearfront_accuracy_tables paper | events SCENE | rounding SCENE T...\n");
    return 2;
  }
}
