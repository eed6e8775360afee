// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "compare/observed.hpp"
#include "compare/paper.hpp"
#include "compare/race.hpp"
#include "compare/report.hpp"
#include "plot/error_time.hpp"
#include "plot/pictures.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

constexpr double kDefaultBudget = 5;
constexpr std::size_t kMostTimes = 9;  // panels that can be read
constexpr double kMostCells = 1e8, kMostPoints = 1e7;

struct CompareArguments {
  std::string scene, output, plot;
  std::optional<std::string> times, methods, cells, resolutions, points, budget, repeat;
  bool json = false, events = false, paper = false;
};

std::vector<double> times_of(const CompareArguments& arguments) {
  if (!arguments.times) throw InputError("--times", "", "missing; must be a list such as 0.5,6 or 1:5:3");
  Bounds positive;
  positive.low = 0, positive.low_excluded = true;
  auto times = list_option("--times", *arguments.times, positive, "> 0", Steady::refused);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (times.size() > kMostTimes)
    refuse("--times", *arguments.times, fmt::format("must give at most {} times", kMostTimes));
  return times;
}

/// A ladder of whole numbers, ascending.
std::vector<double> counts_option(std::string_view option, const std::string& value, double most) {
  const std::string constraint = fmt::format(">= 1 and <= {}", number_text(most));
  auto counts = list_option(option, value, {1, most}, constraint, Steady::refused);
  for (const double n : counts)
    if (n != std::floor(n)) refuse(option, value, "must hold whole numbers only");
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

Ladders ladders_of(const CompareArguments& arguments) {
  Ladders ladders = default_ladders(arguments.budget.has_value());
  if (arguments.cells) ladders.cells = counts_option("--cells", *arguments.cells, kMostCells);
  if (arguments.points) ladders.points = counts_option("--points", *arguments.points, kMostPoints);
  if (arguments.resolutions) {
    auto& r = ladders.resolutions;
    r = list_option("--resolutions", *arguments.resolutions, {0, 1, true}, "> 0 and <= 1", Steady::refused);
    std::sort(r.rbegin(), r.rend());
    r.erase(std::unique(r.begin(), r.end()), r.end());
  }
  return ladders;
}

RaceLimits limits_of(const CompareArguments& arguments, ProgressLine& line) {
  RaceLimits limits;
  limits.budget_s = kDefaultBudget;
  constexpr unsigned long long kMostRepeats = 10'000;
  Bounds positive;
  positive.low = 0, positive.low_excluded = true;
  if (arguments.budget) limits.budget_s = number_option("--budget", *arguments.budget, positive, "> 0");
  if (arguments.repeat)
    limits.repeats = static_cast<std::size_t>(count_option("--repeat", *arguments.repeat, 1, kMostRepeats));
  limits.is_stopped = InterruptGuard::is_interrupted;
  limits.progress = [show = line.callback()](double t, std::uint64_t work) {
    if (show) show(t, work);
    return !InterruptGuard::is_interrupted();
  };
  return limits;
}

int compare_with_paper(const CompareArguments& arguments) {
  if (!arguments.scene.empty() || arguments.times || arguments.methods || arguments.cells ||
      arguments.resolutions || arguments.points || arguments.budget || !arguments.output.empty() ||
      !arguments.plot.empty() || arguments.json || arguments.events)
    throw InputError("--paper", "",
                     "prints a comparison of its own; takes no SCENE and no option other than --repeat");
  ProgressLine line;
  const RaceLimits limits = limits_of(arguments, line);
  const InterruptGuard guard;
  OutputFile out("-");
  out.write(paper_text(limits));
  out.commit();
  if (InterruptGuard::is_interrupted()) note("interrupted: rows without numbers were not computed");
  return kDone;
}

void check_scene(const Scene<double>& scene, const std::string& path) {
  if (const std::string reason = exact::refusal(scene); !reason.empty())
    throw InputError(printable(path), "", "has no exact solution to compare with: " + reason);
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

/// Says which ladders ended early and why. Returns whether there is any result.
bool report_ends(const std::vector<Panel>& panels, bool has_budget) {
  bool has_rungs = false;
  for (const Panel& panel : panels)
    for (const Course& course : panel.courses) {
      has_rungs = has_rungs || !course.rungs.empty();
      const bool is_asked = course.ended == kBudgetSpent && has_budget;
      if (course.ended.empty() || is_asked) continue;
      const std::string last =
          course.rungs.empty() ? "its start" : "resolution " + number_text(course.rungs.back().resolution);
      note(fmt::format("t = {}, {}: ended at {}: {}", number_text(panel.t), course.contestant.name, last,
                       printable(course.ended)));
    }
  return has_rungs;
}

void print(const CompareArguments& arguments, const Scene<double>& scene, const std::vector<Panel>& panels,
           const ObservedEvents* events) {
  OutputFile out("-");
  if (arguments.json)
    out.write(race_json(scene.name(), panels, events));
  else
    out.write(fmt::format("{}\n{}{}", printable(scene.name(), 100), race_text(panels),
                          events ? events_text(*events) : ""));
  out.commit();
}

int compare(const CompareArguments& arguments) {
  if (arguments.paper) return compare_with_paper(arguments);
  if (arguments.scene.empty())
    throw InputError("SCENE", "", "missing; usage: shearfront compare SCENE --times LIST [options]");
  const std::vector<double> times = times_of(arguments);
  const auto contestants = contestants_of("--methods", arguments.methods ? &*arguments.methods : nullptr);
  const Ladders ladders = ladders_of(arguments);
  ProgressLine line;
  const RaceLimits limits = limits_of(arguments, line);
  check_picture_name("--plot", arguments.plot);
  check_outputs(arguments.scene, {{"", "-"}, {"-o", arguments.output}, {"--plot", arguments.plot}});
  const auto scene = with_remarks(read_scene<double>(arguments.scene));
  check_scene(scene, arguments.scene);
  std::optional<OutputFile> output;
  if (!arguments.output.empty()) output.emplace(arguments.output);
  check_picture_target(arguments.plot);

  const InterruptGuard guard;
  const ExactSolution<double> exact(scene);
  note_staircase(scene, exact, times);
  std::vector<Panel> panels;
  for (const double t : times)
    if (!InterruptGuard::is_interrupted())
      panels.push_back(race(scene, exact, t, contestants, ladders, limits));
  std::optional<ObservedEvents> events;
  if (arguments.events) events = observe_events(scene, contestants, ladders, limits);
  if (!report_ends(panels, arguments.budget.has_value())) return kNoResult;
  if (output) {
    output->write(race_csv(panels));
    output->commit();
  }
  print(arguments, scene, panels, events ? &*events : nullptr);
  return arguments.plot.empty() ? kDone : draw_error_time(arguments.plot, scene.name(), panels);
}

}  // namespace

Command add_compare(CLI::App& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* app = program.add_subcommand("compare", "Speed against error: every method, from coarse to fine");
  std::vector<std::string> names;
  for (const Contestant& c : all_contestants()) names.push_back(c.name);
  app->add_option("SCENE", arguments->scene, "scene file")->type_name("");
  app->add_option("--times", arguments->times, "times > 0: 0.5,6 or start:stop:count")->type_name("LIST");
  app->add_option("--methods", arguments->methods, fmt::format("of {}", fmt::join(names, ", ")))
      ->type_name("LIST");
  app->add_option("--cells", arguments->cells,
                  "finite volumes: numbers of cells, default 100 to 3200 doubling")
      ->type_name("LIST");
  app->add_option("--resolutions", arguments->resolutions,
                  "front tracking: steps of phi, default 0.1 to 1e-5 in half decades")
      ->type_name("LIST");
  app->add_option("--points", arguments->points, "exact: numbers of heights, default 1000")
      ->type_name("LIST");
  app->add_option("--budget", arguments->budget,
                  "seconds per method and time, default 5; ladders by default go on as long as it lasts")
      ->type_name("S");
  app->add_option("--repeat", arguments->repeat,
                  "runs per rung, of which the median time counts; default at least 3 and 20 ms in all")
      ->type_name("N");
  app->add_flag("--events", arguments->events, "also the errors of the event times");
  app->add_flag("--paper", arguments->paper,
                "Tables 1 and 2 of Buerger, Martinez & Villada (2023) beside ours");
  app->add_option("-o", arguments->output, "all rows as CSV")->type_name("FILE");
  app->add_option("--plot", arguments->plot, "picture of error against time: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_flag("--json", arguments->json, "print JSON");
  app->footer("Ctrl-C ends the comparison with what is done; a second one ends the program.");
  return {app, "SCENE", [arguments] { return compare(*arguments); }};
}

}  // namespace shearfront::tools
