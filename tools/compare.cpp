// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "cli/scene.hpp"
#include "cli/table.hpp"
#include "compare/comparison.hpp"
#include "plot/picture.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/io/detail/json.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/chute.hpp"

namespace shearfront::tools {
namespace {

constexpr Bounds kPositive{0, HUGE_VAL, true};

struct CompareArguments {
  PictureOptions pictures;
  SceneArgument scene;
  std::string output, plot;
  std::optional<std::string> times, methods, cells, resolutions, budget, repeat;
  bool json = false;
};

/// Ascending, each once.
std::vector<double> ascending_option(std::string_view option, const std::string& value, Bounds bounds,
                                     const std::string& constraint) {
  auto numbers = list_option(option, value, bounds, constraint, Steady::refused);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

std::vector<double> times_of(const CompareArguments& arguments) {
  constexpr std::size_t kMostTimes = 9;  // panels that can be read
  if (!arguments.times) throw InputError("--times", "", "missing; must be a list such as 0.5,6 or 1:5:3");
  const auto times = ascending_option("--times", *arguments.times, kPositive, "> 0");
  if (times.size() > kMostTimes)
    refuse("--times", *arguments.times, fmt::format("must give at most {} times", kMostTimes));
  return times;
}

/// Coarse to fine. Those who give a budget get longer lists by default.
std::vector<double> resolutions_of(const CompareArguments& arguments, std::string_view refinement) {
  constexpr double kMostCells = 1e8;
  const bool is_long = arguments.budget.has_value();
  if (refinement == "cells") {
    std::vector<double> cells;
    for (double n = 100; n <= (is_long ? 2e6 : 3200); n *= 2) cells.push_back(n);
    if (arguments.cells)
      cells = ascending_option("--cells", *arguments.cells, {1, kMostCells}, ">= 1 and <= 1e+08");
    for (const double n : cells)
      if (n != std::floor(n)) refuse("--cells", *arguments.cells, "must hold whole numbers only");
    return cells;
  }
  std::vector<double> steps{1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 0.003, 0.01, 0.03, 0.1};
  if (!is_long) steps.erase(steps.begin(), steps.begin() + 2);
  if (arguments.resolutions)
    steps = ascending_option("--resolutions", *arguments.resolutions, {0, 1, true}, "> 0 and <= 1");
  return {steps.rbegin(), steps.rend()};
}

ComparisonLimits limits_of(const CompareArguments& arguments) {
  constexpr unsigned long long kMostRepeats = 10'000;
  ComparisonLimits limits;
  if (arguments.budget) limits.budget_s = number_option("--budget", *arguments.budget, kPositive, "> 0");
  if (arguments.repeat) limits.repeats = count_option("--repeat", *arguments.repeat, 1, kMostRepeats);
  return limits;
}

/// Where a(z) has no closed form, and in smooth beds of other fluxes, the exact engine solves pieces that stand for the bed.
void note_pieces(const Scene<double>& scene, const ExactSolution<double>& exact,
                 const std::vector<double>& times) {
  if (exact.is_exact()) return;
  double worst = 0;
  constexpr int kHeights = 100;
  for (const double t : times)
    for (int i = 1; i < kHeights; ++i) {
      const double z = scene.bottom() + (scene.top() - scene.bottom()) * i / kHeights;
      worst = std::max(worst, exact.at(z, t).M_error);
    }
  const std::string whose =
      fmt::format("whose own error of M is about {:.1e} of the height; differences below that mean nothing",
                  worst / (scene.top() - scene.bottom()));
  note(exact.form().is_exact()
           ? fmt::format("the start is smooth: errors are measured against a search in {} parts of it, {}",
                         exact.form().n_start_parts(), whose)
           : fmt::format("the bed varies smoothly: errors are measured against {} pieces of it, {}",
                         exact.n_layers(), whose));
}

/// Says which methods ended early and why. Returns whether there is any result.
bool report_ends(const std::vector<Course>& courses, bool has_budget) {
  bool has_runs = false;
  for (const Course& course : courses) {
    has_runs = has_runs || !course.runs.empty();
    if (course.ended.empty() || (course.ended == kBudgetSpent && has_budget)) continue;
    const std::string last =
        course.runs.empty() ? "its start" : "resolution " + number_text(course.runs.back().resolution);
    note(fmt::format("t = {}, {}: ended at {}: {}", number_text(course.t), course.method.name, last,
                     printable(course.ended)));
  }
  return has_runs;
}

/// A table per time; courses come by time.
std::string text_of(const std::vector<Course>& courses, const SceneUnits& units) {
  std::string all;
  for (auto course = courses.begin(); course != courses.end();) {
    const double t = course->t;
    TextTable table({"method", "resolution", "L1 error", "order", "work", "per unit", "time"});
    for (; course != courses.end() && course->t == t; ++course)
      for (const ComparedRun& run : course->runs)
        table.add(
            {course->method.name, number_text(run.resolution),
             run.l1_error == 0 ? "0" : fmt::format("{:.2e}", run.l1_error),
             run.order ? fmt::format("{:.2f}", *run.order) : "", std::to_string(run.work),
             run.work > 0 ? fmt::format("{:.3g} ns", 1e9 * run.wall_s / static_cast<double>(run.work)) : "",
             fmt::format("{:.3g} s", run.wall_s)});
    const std::string unit = units.t.empty() ? "" : " " + printable(units.t);
    all += fmt::format("\n{} = {}{}\n\n{}", units.symbol(), number_text(t), unit, table.text());
  }
  return all;
}

std::string csv_of(const std::vector<Course>& courses, const SceneUnits& units) {
  std::string rows = csv_header({"method", "resolution", "t", "l1_error", "wall_s", "work"}, units);
  for (const Course& course : courses)
    for (const ComparedRun& run : course.runs)
      rows +=
          fmt::format("{},{},{},{},{},{}\n", course.method.name, number_text(run.resolution),
                      number_text(course.t), number_text(run.l1_error), number_text(run.wall_s), run.work);
  return rows;
}

/// {"scene","times":[{"t","methods":[{"method","ended","runs":[{"resolution","l1_error","order","wall_s",
/// "work"}]}]}]}; of a chute "distances" and "x".
std::string json_of(const std::string& scene, const std::vector<Course>& courses, const SceneUnits& units) {
  using detail::Json;
  const std::string along = units.symbol(), places = units.is_chute ? "distances" : "times";
  Json all{{"scene", scene}, {places, Json::array()}};
  for (const Course& course : courses) {
    Json& times = all[places];
    if (times.empty() || times.back()[along] != course.t)
      times.push_back({{along, course.t}, {"methods", Json::array()}});
    Json runs = Json::array();
    for (const ComparedRun& run : course.runs)
      runs.push_back({{"resolution", run.resolution},
                      {"l1_error", run.l1_error},
                      {"order", detail::json_or_null(run.order)},
                      {"wall_s", run.wall_s},
                      {"work", run.work}});
    times.back()["methods"].push_back(
        {{"method", course.method.name}, {"ended", course.ended}, {"runs", runs}});
  }
  return detail::json_document(all);
}

int draw(const std::string& path, const std::string& scene, const std::vector<Course>& courses,
         const SceneUnits& units) {
  std::vector<double> times;
  std::vector<std::string> methods;  // those with any run
  for (const Course& course : courses) {
    if (times.empty() || times.back() != course.t) times.push_back(course.t);
    if (!course.runs.empty() &&
        std::find(methods.begin(), methods.end(), course.method.name) == methods.end())
      methods.push_back(course.method.name);
  }
  Picture picture(path, "comparison");
  picture.set("title", scene);
  picture.set("times", times);
  picture.set("along", units.symbol());
  picture.set("unit_t", without_markup(units.t));
  picture.set("methods", fmt::format("{}", fmt::join(methods, " ")));
  picture.add_file("comparison.csv", [&](OutputFile& file) { file.write(csv_of(courses, {})); });
  return picture.draw();
}

int compare(CompareArguments& arguments) {
  const std::vector<double> times = times_of(arguments);
  const auto methods = compared_methods("--methods", arguments.methods);
  const auto cells = resolutions_of(arguments, "cells"), steps = resolutions_of(arguments, "resolution");
  ComparisonLimits limits = limits_of(arguments);
  arguments.pictures.apply();
  check_picture_name("--plot", arguments.plot);
  const bool is_csv = arguments.output == "-";  // instead of the table
  if (is_csv && arguments.json)
    refuse("-o", arguments.output, "must not be standard output, which --json takes");
  check_outputs(arguments.scene.file(),
                {{"", is_csv ? "" : "-"}, {"-o", arguments.output}, {"--plot", arguments.plot}});
  const Scene<double> read = arguments.scene.read();
  // Errors in a steady chute are those in the bed it amounts to.
  const Scene<double> scene = read.is_chute() ? SteadyChute<double>(read).bed() : read;
  if (scene.is_slab())
    throw InputError(printable(arguments.scene.file()), "",
                     "has no exact solution to compare with: phi depends on x (table slab)");
  if (const std::string reason = exact::refusal(scene); !reason.empty())
    throw InputError(printable(arguments.scene.file()), "",
                     "has no exact solution to compare with: " + reason);
  std::optional<OutputFile> output;
  if (!arguments.output.empty()) output.emplace(arguments.output);
  check_picture_target(arguments.plot);

  std::optional<InterruptGuard> guard(std::in_place);
  const ExactSolution<double> exact(scene);
  note_pieces(scene, exact, times);
  const std::vector<Course> courses = with_progress([&](const Progress& progress) {
    limits.progress = progress;
    std::vector<Course> all;
    for (const double t : times)
      for (const ComparedMethod& method : methods) {
        const bool has_cells = method.method.has_option("cells");
        all.push_back(compare_method(scene, exact, t, method, has_cells ? cells : steps, limits));
      }
    return all;
  });
  const bool is_interrupted = InterruptGuard::is_interrupted();
  guard.reset();  // what follows ends at once
  if (!report_ends(courses, arguments.budget.has_value())) return kNoResult;
  if (output) {
    output->write(csv_of(courses, read.spec().units));
    output->commit();
  }
  const bool has_picture = !arguments.plot.empty() && !is_interrupted;
  if (is_interrupted && !arguments.plot.empty()) note("interrupted: no --plot");
  if (is_csv) return has_picture ? draw(arguments.plot, scene.name(), courses, read.spec().units) : kDone;
  OutputFile out("-");
  out.write(arguments.json ? json_of(scene.name(), courses, read.spec().units)
                           : printable(scene.name(), 100) + "\n" + text_of(courses, read.spec().units));
  out.commit();
  return has_picture ? draw(arguments.plot, scene.name(), courses, read.spec().units) : kDone;
}

}  // namespace

Command add_compare(CLI::App& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* app = program.add_subcommand("compare", "Speed against error: every method, from coarse to fine");
  std::vector<std::string> names;
  for (const ComparedMethod& method : compared_methods()) names.push_back(method.name);
  arguments->scene.add_to(*app);
  app->add_option("--times", arguments->times, "times > 0: 0.5,6 or start:stop:count")->type_name("LIST");
  app->add_option("--methods", arguments->methods, fmt::format("of {}", fmt::join(names, ", ")))
      ->type_name("LIST");
  app->add_option("--cells", arguments->cells,
                  "finite volumes: numbers of cells, default 100 to 3200 doubling")
      ->type_name("LIST");
  app->add_option("--resolutions", arguments->resolutions,
                  "front tracking: steps of phi, default 0.1 to 1e-5 in half decades")
      ->type_name("LIST");
  app->add_option("--budget", arguments->budget,
                  "seconds per method and time, default 5; resolutions by default go on as long as it lasts")
      ->type_name("S");
  app->add_option("--repeat", arguments->repeat,
                  "runs per resolution, of which the median time counts; default at least 3 and 20 ms in all")
      ->type_name("N");
  app->add_option("-o", arguments->output, "all rows as CSV; - instead of the table")->type_name("FILE");
  app->add_option("--plot", arguments->plot, "picture of error against time: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  arguments->pictures.add_to(*app);
  app->add_flag("--json", arguments->json, "print JSON");
  app->footer("Ctrl-C ends the comparison with what is done; a second one ends the program.");
  return {app, "SCENE", [arguments] { return compare(*arguments); }};
}

}  // namespace shearfront::tools
