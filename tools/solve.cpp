// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "bed_course.hpp"
#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/prediction_file.hpp"
#include "cli/progress.hpp"
#include "cli/scene.hpp"
#include "plot/pictures.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "slab.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kDefaultDepths = 101;
constexpr double kMostSamples = 1e8;  // times x depths

struct SolveArguments {
  PictureOptions pictures;
  SceneArgument scene;
  std::string times, positions, depths, quantity, output, fronts, plot, map, contours, riemann;
  bool json = false;
  MethodArguments method;
};

/// What is solved, by what.
struct Task {
  Scene<double> scene;
  Method method;
  std::vector<double> times;
  std::vector<Method> others = {};  ///< in the picture of profiles
  Contours contours = {};           ///< of the map
};

SolvedQuantity quantity_of(const SolveArguments& arguments) {
  if (arguments.quantity.empty()) return SolvedQuantity::concentration;
  const std::vector<std::string> names(kSolvedQuantityNames.begin(), kSolvedQuantityNames.end());
  return static_cast<SolvedQuantity>(choice_option("--quantity", arguments.quantity, names));
}

/// --contours: a list of states, or none.
Contours contours_of(const SolveArguments& arguments, const Scene<double>& scene) {
  if (arguments.contours.empty()) return {};
  if (arguments.map.empty()) refuse("--contours", arguments.contours, "needs --map");
  if (arguments.contours == "none") return {false, {}};
  const StateRange<double> range = states_of(scene);
  return {false, list_option("--contours", arguments.contours, {range.lowest, range.highest},
                             fmt::format("none, or states between {} and {}", number_text(range.lowest),
                                         number_text(range.highest)),
                             Steady::refused)};
}

void check_arguments(const SolveArguments& arguments, const Method& method) {
  check_picture_name("--riemann", arguments.riemann);
  if (!arguments.riemann.empty()) {
    for (const auto& [option, value] :
         {std::pair("--times", arguments.times), std::pair("--map", arguments.map),
          std::pair("--plot", arguments.plot), std::pair("--fronts", arguments.fronts)})
      if (!value.empty()) refuse(option, value, "must not be given with --riemann, which is of one moment");
    check_outputs(arguments.scene.file(), {{"--riemann", arguments.riemann}});
    arguments.pictures.apply();
    check_picture_target(arguments.riemann);
    return;
  }
  if (arguments.times.empty())
    throw InputError("--times", "", "missing; must be a list such as 0.5,6 or 0:10:21 or steady");
  if (!arguments.fronts.empty() && !method.guarantees().has_fronts)
    refuse("--fronts", arguments.fronts,
           fmt::format("needs --method {}; {} has no fronts",
                       fmt::join(Method::names(&Guarantees::has_fronts), "|"), method.name()));
  arguments.pictures.apply();
  check_picture_name("--plot", arguments.plot);
  check_picture_name("--map", arguments.map);
  // Without -o the samples go to standard output.
  const bool to_stdout = arguments.output.empty();
  check_outputs(arguments.scene.file(),
                {{to_stdout ? "" : "-o", to_stdout ? "-" : std::string_view(arguments.output)},
                 {"--fronts", arguments.fronts},
                 {"--plot", arguments.plot},
                 {"--map", arguments.map}});
  if (quantity_of(arguments) == SolvedQuantity::concentration) return;
  if (!arguments.depths.empty())
    refuse("--heights", arguments.depths, "must not be given: " + arguments.quantity + " has no depth");
  if (!arguments.map.empty())
    refuse("--map", arguments.map, "must not be given with --quantity " + arguments.quantity);
  if (!arguments.fronts.empty())
    refuse("--fronts", arguments.fronts, "must not be given with --quantity " + arguments.quantity);
}

bool has_steady(const std::vector<double>& times) {
  return std::any_of(times.begin(), times.end(), [](double t) { return !std::isfinite(t); });
}

/// When the bed comes to rest: t* of the method, or of the first that knows it here. Errors: InputError if there is none.
double steady_time(const SolveArguments& arguments, const Scene<double>& scene, const Method& method) {
  std::optional<double> t_star;
  try {
    t_star = (method.guarantees().has_timeline ? event_times(scene, method) : event_times(scene)).t_star;
  } catch (const InputError& error) {
    refuse(
        "--times", arguments.times,
        "needs the time of the steady state, which is not known here: " + error.complaints().front().text());
  }
  if (!t_star)
    refuse("--times", arguments.times, "needs the time of the steady state, which never comes here");
  return *t_star;
}

/// --times, in which 0:steady:5 goes up to t*.
std::vector<double> times_of(const SolveArguments& arguments, const Scene<double>& scene,
                             const Method& method) {
  constexpr std::string_view kSteady = ":steady:";
  std::string text = arguments.times;
  if (text.find(kSteady) != std::string::npos) {
    const std::string stop = ":" + number_text(steady_time(arguments, scene, method)) + ":";
    for (std::size_t at = text.find(kSteady); at != std::string::npos; at = text.find(kSteady, at))
      text.replace(at, kSteady.size(), stop);
  }
  return list_option("--times", text, {0}, ">= 0", Steady::allowed);
}

std::vector<double> depths_of(const SolveArguments& arguments, const Scene<double>& scene) {
  if (arguments.depths.empty()) return equally_spaced(scene.bottom(), scene.top(), kDefaultDepths);
  const std::string inside =
      fmt::format("inside the domain [{}, {}]", number_text(scene.bottom()), number_text(scene.top()));
  return list_option("--heights", arguments.depths, {scene.bottom(), scene.top()}, inside, Steady::refused);
}

SolverRequest request_of(const SolveArguments& arguments, const Task& task) {
  SolverRequest request;
  request.times = task.times;
  request.heights = depths_of(arguments, task.scene);
  const double n = static_cast<double>(request.times.size()) * static_cast<double>(request.heights.size());
  if (n > kMostSamples) refuse("--times", arguments.times, "must give at most 1e8 pairs of time and depth");
  if (!arguments.map.empty() && !(last_time(request.times) > 0) && !has_steady(request.times))
    refuse("--map", arguments.map, "needs a time > 0 to draw up to among --times");
  request.fronts = !arguments.fronts.empty();
  // The event times are marked in the picture of fronts; the steady time stands for "steady" in the output.
  request.timeline = task.method.guarantees().has_timeline && task.scene.has_walls() &&
                     (request.fronts || has_steady(request.times));
  return request;
}

/// Says how large a file of fronts becomes before it is written.
void note_size(std::size_t n_fronts) {
  constexpr double kBytes = 90, kMuch = 1e8;  // of a row
  const double size = kBytes * static_cast<double>(n_fronts);
  if (size > kMuch)
    note(fmt::format("--fronts: {} fronts, about {:.0f} MB; a coarser --resolution has fewer", n_fronts,
                     size / 1e6));
}

/// Columns H_lower, H_upper beside H, empty where there is no band.
void add_bands(TimeTable& table, const std::vector<fit::PredictedNumber>& numbers) {
  std::vector<std::string> names;
  for (const std::string& name : table.columns)
    for (const char* end : {"", "_lower", "_upper"}) names.push_back(name + end);
  auto number = numbers.begin();
  for (std::vector<double>& row : table.rows) {
    std::vector<double> wider;
    for (const double x : row) {
      const auto& band = (number++)->band;
      wider.insert(wider.end(), {x, band ? band->low : HUGE_VAL, band ? band->high : HUGE_VAL});
    }
    row = std::move(wider);
  }
  table.columns = std::move(names);
}

/// Numbers of the whole bed instead of concentrations.
int solve_bed(const SolveArguments& arguments, const Task& task) {
  const bool is_mixed_flow =
      task.scene.is_chute() && quantity_of(arguments) == SolvedQuantity::mixing;  // of what passes
  if (const std::string reason = BedHeight::refusal(task.scene); !reason.empty() && !is_mixed_flow)
    refuse("--quantity", arguments.quantity, "must suit the scene: " + reason);
  if (static_cast<double>(task.times.size()) > kMostSamples)
    refuse("--times", arguments.times, "must give at most 1e8 times");
  OutputFile output(arguments.output.empty() ? "-" : arguments.output);
  check_picture_target(arguments.plot);
  note_before_run(arguments.method, task.method, task.scene);
  BedCourse course = with_progress(
      [&](const Progress& progress) {
        return bed_course(quantity_of(arguments), task.scene, task.method, task.times, progress);
      },
      last_time(task.times));
  if (!course.summary.usable()) return report_unusable(course.summary);
  note_remark(course.summary);
  const TimeTable without_bands = course.table;  // what is drawn
  if (const fit::DrawnScenes* draws = arguments.scene.draws()) {
    const bool is_mixing = quantity_of(arguments) == SolvedQuantity::mixing;
    const fit::PredictedNumbers predicted = fit::predict_bed(
        task.scene, *draws, task.method,
        is_mixing ? fit::mixing_function() : fit::bed_height_function(task.scene), task.times);
    note_draws(*draws, predicted.n_failed);
    note_bands(*draws, predicted.n_by_draws, predicted.numbers.size());
    add_bands(course.table, predicted.numbers);
  }
  const auto& lowest = course.lowest;
  NamedNumbers lowest_numbers{"lowest", {}};
  if (lowest) lowest_numbers.numbers = {{"t", lowest->t}, {"H", lowest->height}};
  if (arguments.json)
    write_time_table_json(output, task.scene.name(), task.method.name(), course.table, lowest_numbers,
                          course.summary, task.scene.spec().units);
  else
    write_time_table_csv(output, course.table, task.scene.spec().units);
  output.commit();
  if (lowest && !arguments.json)
    note(fmt::format("the bed is lowest at t = {}: H = {}", number_text(lowest->t, 7),
                     number_text(lowest->height, 10)));
  course.table = without_bands;
  return arguments.plot.empty() ? kDone : draw_bed_course(arguments.plot, task.scene, task.method, course);
}

/// With --verbose: what half as many cells change. A tolerance is that of time steps; cells make an error of their own.
void note_cells(const Task& task, const SolverRequest& request, const SolverResult& result) {
  if (!ProgressLine::is_verbose() || !task.method.has_option("cells") || result.profiles.empty()) return;
  if (task.method.has_option("cell-tolerance") && number_of(task.method, "cell-tolerance") > 0) return;
  const std::size_t n = result.profiles.front().below().size();
  if (n < 8) return;
  Method half = task.method;
  half.set("cells", std::uint64_t{n / 2});
  const SolverResult coarse = with_progress(
      [&](const Progress& progress) { return shearfront::solve(task.scene, half, request, progress); },
      last_time(request.times));
  if (!coarse.summary.usable()) return;
  double phi = 0, M = 0;
  for (std::size_t i = 0; i < result.samples.size(); ++i) {
    phi = std::max(phi, std::abs(result.samples[i].phi - coarse.samples[i].phi));
    M = std::max(M, std::abs(result.samples[i].M - coarse.samples[i].M));
  }
  note(fmt::format(
      "half as many cells change phi by up to {} and M by up to {} at these places: the {} cells are "
      "off by about as much or less",
      number_text(phi, 2), number_text(M, 2), n));
}

int solve_concentration(const SolveArguments& arguments, const Task& task) {
  SolverRequest request = request_of(arguments, task);
  request.profiles = request.profiles || (ProgressLine::is_verbose() && task.method.has_option("cells"));
  OutputFile output(arguments.output.empty() ? "-" : arguments.output);
  std::optional<OutputFile> fronts;
  if (request.fronts) fronts.emplace(arguments.fronts);
  check_picture_target(arguments.plot);
  check_picture_target(arguments.map);
  note_before_run(arguments.method, task.method, task.scene);
  const SolverResult result = with_progress(
      [&](const Progress& progress) { return shearfront::solve(task.scene, task.method, request, progress); },
      last_time(request.times));
  if (!result.summary.usable()) return report_unusable(result.summary);
  note_remark(result.summary);
  if (!arguments.json) note_approximation(task.method, result.summary);
  note_cells(task, request, result);

  std::vector<double> times = request.times;  // as printed
  for (double& t : times)
    if (!std::isfinite(t)) t = steady_time_of(result).value_or(t);
  if (const fit::DrawnScenes* draws = arguments.scene.draws()) {
    const fit::PredictedSamples samples =
        fit::predict_samples(task.scene, *draws, task.method, request.times, request.heights);
    note_draws(*draws, samples.n_failed);
    note_bands(*draws, samples.n_by_draws, 2 * samples.phi.size());
    if (arguments.json)
      write_samples_json(output, task.scene.name(), task.method.name(), times, request.heights,
                         result.samples, result.summary, task.scene.spec().units, sample_bands(samples));
    else
      write_sample_bands_csv(output, times, request.heights, samples, task.scene.spec().units);
  } else if (arguments.json)
    write_samples_json(output, task.scene.name(), task.method.name(), times, request.heights, result.samples,
                       result.summary, task.scene.spec().units);
  else
    write_samples_csv(output, times, request.heights, result.samples, task.scene.spec().units);
  if (has_steady(times))
    note(fmt::format("{} has no time of the steady state{}: it goes to the state of rest, and t is empty",
                     task.method.name(),
                     task.method.has_option("cells") ? " that a march of some seconds comes to" : ""));
  else if (has_steady(request.times) && result.summary.rest_time)
    note(fmt::format("{} had come to rest at t = {}, which stands for steady", task.method.name(),
                     number_text(*result.summary.rest_time, 6)));
  if (fronts) note_size(result.fronts.size());
  if (fronts) write_fronts_csv(*fronts, result.fronts, task.scene.spec().units);
  if (fronts) fronts->commit();
  output.commit();
  int code = kDone;
  if (!arguments.plot.empty())
    code = request.fronts ? draw_fronts(arguments.plot, task.scene, task.method, result.fronts,
                                        result.timeline.value_or(Timeline<double>{}))
                          : draw_profiles(arguments.plot, task.scene, task.method, times, task.others);
  if (arguments.map.empty() || code != kDone) return code;
  const double t_end = last_time(times);
  return draw_map(arguments.map, task.scene, task.method,
                  t_end > 0 ? t_end : steady_time(arguments, task.scene, task.method), task.contours);
}

int solve_scene(SolveArguments& arguments) {
  std::vector<Method> methods = arguments.method.methods();
  const Method method = methods.front();
  methods.erase(methods.begin());
  if (!methods.empty() && (arguments.plot.empty() || !arguments.fronts.empty()))
    refuse("--method", fmt::format("{},{}", method.name(), methods.front().name()),
           "must be one, unless --plot draws the profiles of several");
  check_arguments(arguments, method);
  const auto scene = arguments.scene.read();
  if (!arguments.riemann.empty()) return draw_riemann(arguments.riemann, scene);
  const Task task{scene, method, times_of(arguments, scene, method), std::move(methods),
                  contours_of(arguments, scene)};
  if (!arguments.positions.empty() && !scene.is_slab())
    refuse("--positions", arguments.positions, "must not be given: the scene has no table slab");
  if (scene.is_slab() && quantity_of(arguments) == SolvedQuantity::concentration && arguments.plot.empty()) {
    return solve_slab({task.scene, task.method, task.times, depths_of(arguments, task.scene),
                       arguments.positions, arguments.output, arguments.map, arguments.json});
  }
  const bool is_of_bed = quantity_of(arguments) != SolvedQuantity::concentration;
  return is_of_bed ? solve_bed(arguments, task) : solve_concentration(arguments, task);
}

}  // namespace

Command add_solve(CLI::App& program) {
  const auto arguments = std::make_shared<SolveArguments>();
  CLI::App* app =
      program.add_subcommand("solve", "Concentration phi and cumulative M at given times and depths");
  arguments->scene.add_to(*app);
  app->add_option("--times", arguments->times, "times: 0.5,6 or start:stop:count or steady, also mixed")
      ->type_name("LIST");
  app->add_option("--heights,--depths", arguments->depths,
                  "heights z: as --times; default 101 over the whole domain")
      ->type_name("LIST");
  app->add_option("--positions", arguments->positions,
                  "places x along a slab: as --times; default the middles of its cells")
      ->type_name("LIST");
  app->add_option("--quantity", arguments->quantity,
                  "phi and M at depths, or of the whole bed: entropy and mixing parameter, height; default "
                  "concentration")
      ->type_name(fmt::format("{}", fmt::join(kSolvedQuantityNames, "|")));
  arguments->method.add_to(*app);
  app->add_option("-o", arguments->output, "result file, CSV (JSON with --json); default standard output")
      ->type_name("FILE");
  app->add_option("--fronts", arguments->fronts, "fronts as CSV (front tracking)")->type_name("FILE");
  app->add_option("--plot", arguments->plot,
                  "picture of the profiles, with --fronts of the (t, z) plane: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_option(
         "--map", arguments->map,
         "picture of phi over time and height, up to the last time, of a slab over x and z at the times: "
         "FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_option("--contours", arguments->contours,
                  "of --map: states such as 0.25,0.5 or none; default round ones")
      ->type_name("LIST");
  app->add_option("--riemann", arguments->riemann,
                  "picture of the waves from the interface of two layers in the plane of phi and flux: "
                  "FILE.svg, .png or .pdf")
      ->type_name("FILE");
  arguments->pictures.add_to(*app);
  app->add_flag("--json", arguments->json, "write JSON instead of CSV");
  return {app, "SCENE", [arguments] { return solve_scene(*arguments); }};
}

}  // namespace shearfront::tools
