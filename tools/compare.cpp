// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/json.hpp"
#include "cli/progress.hpp"
#include "cli/table.hpp"
#include "compare/comparison.hpp"
#include "plot/picture.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

struct CompareArguments {
  std::string scene, output, plot;
  std::optional<std::string> times, methods, cells, resolutions, budget, repeat;
  bool json = false;
};

std::vector<double> sorted(std::vector<double> numbers, bool is_descending = false) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  if (is_descending) std::reverse(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<double> times_of(const CompareArguments& arguments) {
  constexpr std::size_t kMostTimes = 9;  // panels that can be read
  if (!arguments.times) throw InputError("--times", "", "missing; must be a list such as 0.5,6 or 1:5:3");
  const Bounds positive{0, HUGE_VAL, true};
  const auto times = sorted(list_option("--times", *arguments.times, positive, "> 0", Steady::refused));
  if (times.size() > kMostTimes)
    refuse("--times", *arguments.times, fmt::format("must give at most {} times", kMostTimes));
  return times;
}

/// Whole numbers, ascending.
std::vector<double> counts_option(std::string_view option, const std::string& value, double most) {
  const std::string constraint = fmt::format(">= 1 and <= {}", number_text(most));
  const auto counts = list_option(option, value, {1, most}, constraint, Steady::refused);
  for (const double n : counts)
    if (n != std::floor(n)) refuse(option, value, "must hold whole numbers only");
  return sorted(counts);
}

/// Coarse to fine. Those who give a budget get longer lists by default.
std::vector<double> resolutions_of(const CompareArguments& arguments, Refinement refinement) {
  constexpr double kMostCells = 1e8, kPoints = 1000;
  const bool is_long = arguments.budget.has_value();
  if (refinement == "cells") {
    if (arguments.cells) return counts_option("--cells", *arguments.cells, kMostCells);
    std::vector<double> cells;
    for (double n = 100; n <= (is_long ? 2e6 : 3200); n *= 2) cells.push_back(n);
    return cells;
  }
  if (refinement != "resolution") return {kPoints};
  if (arguments.resolutions)
    return sorted(
        list_option("--resolutions", *arguments.resolutions, {0, 1, true}, "> 0 and <= 1", Steady::refused),
        true);
  std::vector<double> resolutions{0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6};
  if (!is_long) resolutions.resize(resolutions.size() - 2);
  return resolutions;
}

ComparisonLimits limits_of(const CompareArguments& arguments, ProgressLine& line) {
  constexpr unsigned long long kMostRepeats = 10'000;
  ComparisonLimits limits;
  if (arguments.budget)
    limits.budget_s = number_option("--budget", *arguments.budget, {0, HUGE_VAL, true}, "> 0");
  if (arguments.repeat) limits.repeats = count_option("--repeat", *arguments.repeat, 1, kMostRepeats);
  limits.is_stopped = InterruptGuard::is_interrupted;
  limits.progress = [show = line.callback()](double t, std::uint64_t work) {
    if (show) show(t, work);
    return !InterruptGuard::is_interrupted();
  };
  return limits;
}

/// For tabulated a(z), and smooth beds of other fluxes, the exact engine solves a staircase.
void note_staircase(const Scene<double>& scene, const ExactSolution<double>& exact,
                    const std::vector<double>& times) {
  if (exact.is_exact()) return;
  double worst = 0;
  constexpr int kHeights = 100;
  for (const double t : times)
    for (int i = 1; i < kHeights; ++i) {
      const double z = scene.bottom() + (scene.top() - scene.bottom()) * i / kHeights;
      worst = std::max(worst, exact.at(z, t).M_error);
    }
  note(
      fmt::format("{}: errors are measured against a staircase of {} layers, whose own error of M "
                  "is about {:.1e}; differences below that mean nothing",
                  scene.is_plain() ? "a(z) is a table" : "the bed varies smoothly", exact.n_layers(), worst));
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

template <class Visit>
void for_each_run(const std::vector<Course>& courses, double t, Visit&& visit) {
  for (const Course& course : courses)
    for (std::size_t i = 0; course.t == t && i < course.runs.size(); ++i) visit(course, i);
}

std::string text_of(const std::vector<Course>& courses, const std::vector<double>& times) {
  std::string all;
  for (const double t : times) {
    TextTable table({"method", "resolution", "L1 error", "order", "work", "per unit", "time"});
    for_each_run(courses, t, [&](const Course& course, std::size_t i) {
      const ComparedRun& run = course.runs[i];
      const auto order = course.order(i);
      const double per_unit = 1e9 * run.wall_s / static_cast<double>(run.work);
      table.add({course.method.name, number_text(run.resolution),
                 run.l1_error == 0 ? "0" : fmt::format("{:.2e}", run.l1_error),
                 order ? fmt::format("{:.2f}", *order) : "", std::to_string(run.work),
                 run.work > 0 ? fmt::format("{:.3g} ns", per_unit) : "",
                 fmt::format("{:.3g} s", run.wall_s)});
    });
    all += fmt::format("\nt = {}\n\n{}", number_text(t), table.text());
  }
  return all;
}

std::string csv_of(const std::vector<Course>& courses, const std::vector<double>& times) {
  std::string rows = "method,resolution,t,l1_error,wall_s,work\n";
  for (const double t : times)
    for_each_run(courses, t, [&](const Course& course, std::size_t i) {
      const ComparedRun& run = course.runs[i];
      rows += fmt::format("{},{},{},{},{},{}\n", course.method.name, number_text(run.resolution),
                          number_text(t), number_text(run.l1_error), number_text(run.wall_s), run.work);
    });
  return rows;
}

/// {"scene","times":[{"t","methods":[{"method","ended","runs":[{"resolution","l1_error","order","wall_s",
/// "work"}]}]}]}
std::string json_of(const std::string& scene, const std::vector<Course>& courses,
                    const std::vector<double>& times) {
  Json all{{"scene", scene}, {"times", Json::array()}};
  for (const double t : times) {
    Json methods = Json::array();
    for (const Course& course : courses) {
      if (course.t != t) continue;
      Json runs = Json::array();
      for (std::size_t i = 0; i < course.runs.size(); ++i) {
        const ComparedRun& run = course.runs[i];
        runs.push_back({{"resolution", run.resolution},
                        {"l1_error", run.l1_error},
                        {"order", json_or_null(course.order(i))},
                        {"wall_s", run.wall_s},
                        {"work", run.work}});
      }
      methods.push_back({{"method", course.method.name}, {"ended", course.ended}, {"runs", runs}});
    }
    all["times"].push_back({{"t", t}, {"methods", methods}});
  }
  return json_text(all) + "\n";
}

int draw(const std::string& path, const std::string& scene, const std::vector<Course>& courses,
         const std::vector<double>& times) {
  std::string methods;  // those with any run
  for (const Course& course : courses)
    if (!course.runs.empty() &&
        (" " + methods + " ").find(" " + course.method.name + " ") == std::string::npos)
      methods += (methods.empty() ? "" : " ") + course.method.name;
  Picture picture(path, "comparison");
  picture.set("title", scene);
  picture.set("times", times);
  picture.set("methods", methods);
  picture.add_file("comparison.csv", [&](OutputFile& file) { file.write(csv_of(courses, times)); });
  return picture.draw();
}

int compare(const CompareArguments& arguments) {
  const std::vector<double> times = times_of(arguments);
  const auto methods = compared_methods("--methods", arguments.methods);
  for (const Refinement refinement : {"cells", "resolution"}) (void)resolutions_of(arguments, refinement);
  ProgressLine line;
  const ComparisonLimits limits = limits_of(arguments, line);
  check_picture_name("--plot", arguments.plot);
  check_outputs(arguments.scene, {{"", "-"}, {"-o", arguments.output}, {"--plot", arguments.plot}});
  const auto scene = read_scene<double>(arguments.scene);
  if (const std::string reason = exact::refusal(scene); !reason.empty())
    throw InputError(printable(arguments.scene), "", "has no exact solution to compare with: " + reason);
  std::optional<OutputFile> output;
  if (!arguments.output.empty()) output.emplace(arguments.output);
  check_picture_target(arguments.plot);

  const InterruptGuard guard;
  const ExactSolution<double> exact(scene);
  note_staircase(scene, exact, times);
  std::vector<Course> courses;
  for (const double t : times)
    for (const ComparedMethod& method : methods)
      courses.push_back(compare_method(scene, exact, t, method,
                                       resolutions_of(arguments, refinement_of(method.method)), limits));
  if (!report_ends(courses, arguments.budget.has_value())) return kNoResult;
  if (output) {
    output->write(csv_of(courses, times));
    output->commit();
  }
  OutputFile out("-");
  out.write(arguments.json ? json_of(scene.name(), courses, times)
                           : printable(scene.name(), 100) + "\n" + text_of(courses, times));
  out.commit();
  return arguments.plot.empty() ? kDone : draw(arguments.plot, scene.name(), courses, times);
}

}  // namespace

Command add_compare(CLI::App& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* app = program.add_subcommand("compare", "Speed against error: every method, from coarse to fine");
  std::vector<std::string> names;
  for (const ComparedMethod& method : compared_methods()) names.push_back(method.name);
  app->add_option("SCENE", arguments->scene, "scene file")->type_name("")->required();
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
  app->add_option("-o", arguments->output, "all rows as CSV")->type_name("FILE");
  app->add_option("--plot", arguments->plot, "picture of error against time: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_flag("--json", arguments->json, "print JSON");
  app->footer("Ctrl-C ends the comparison with what is done; a second one ends the program.");
  return {app, "SCENE", [arguments] { return compare(*arguments); }};
}

}  // namespace shearfront::tools
