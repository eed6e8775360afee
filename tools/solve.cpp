// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/progress.hpp"
#include "plot/pictures.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "bed_course.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kDefaultDepths = 101;
constexpr double kMostSamples = 1e8;  // times x depths

struct SolveArguments {
  std::string scene, times, depths, quantity, output, fronts, plot, map;
  bool json = false;
  MethodArguments method;
};

std::vector<double> depths_of(const SolveArguments& arguments, const Scene<double>& scene) {
  if (arguments.depths.empty()) return equally_spaced(scene.bottom(), scene.top(), kDefaultDepths);
  const std::string inside =
      fmt::format("inside the domain [{}, {}]", number_text(scene.bottom()), number_text(scene.top()));
  return list_option("--depths", arguments.depths, {scene.bottom(), scene.top()}, inside, Steady::refused);
}

SolverRequest request_of(const SolveArguments& arguments, const Scene<double>& scene) {
  SolverRequest request;
  request.times = list_option("--times", arguments.times, {0}, ">= 0", Steady::allowed);
  request.heights = depths_of(arguments, scene);
  const double n = static_cast<double>(request.times.size()) * static_cast<double>(request.heights.size());
  if (n > kMostSamples) refuse("--times", arguments.times, "must give at most 1e8 pairs of time and depth");
  request.fronts = !arguments.fronts.empty();
  // The event times are marked in the picture of fronts; the steady time stands for "steady" in the output.
  request.timeline =
      guarantees_of(arguments.method.method()).has_timeline && scene.has_walls() &&
      (request.fronts || !std::isfinite(*std::max_element(request.times.begin(), request.times.end())));
  return request;
}

void check_arguments(const SolveArguments& arguments) {
  if (arguments.times.empty())
    throw InputError("--times", "", "missing; must be a list such as 0.5,6 or 0:10:21 or steady");
  const std::string_view method = arguments.method.method();
  if (!arguments.fronts.empty() && !guarantees_of(method).has_fronts)
    refuse("--fronts", arguments.fronts,
           fmt::format("needs --method {}; {} has no fronts", fmt::join(methods_with_fronts(), "|"), method));
  check_picture_name("--plot", arguments.plot);
  check_picture_name("--map", arguments.map);
  // Without -o the samples go to standard output.
  const bool to_stdout = arguments.output.empty();
  check_outputs(arguments.scene,
                {{to_stdout ? "" : "-o", to_stdout ? "-" : std::string_view(arguments.output)},
                 {"--fronts", arguments.fronts},
                 {"--plot", arguments.plot},
                 {"--map", arguments.map}});
}

/// The last of the times that are printed.
double last_time(const std::vector<double>& times) {
  double last = 0;
  for (const double t : times)
    if (std::isfinite(t)) last = std::max(last, t);
  return last;
}

int draw(const SolveArguments& arguments, const Scene<double>& scene, const SolverRequest& request,
         const SolverResult& result, const std::vector<double>& times, const SolverOptions& options) {
  if (arguments.plot.empty()) return kDone;
  if (request.fronts)
    return draw_fronts(arguments.plot, scene, result.fronts, result.timeline.value_or(Timeline<double>{}),
                       options.resolution);
  return draw_profiles(arguments.plot, scene, arguments.method.method(), times, options);
}

SolvedQuantity quantity_of(const SolveArguments& arguments) {
  if (arguments.quantity.empty()) return SolvedQuantity::concentration;
  const std::vector<std::string> names(kSolvedQuantityNames.begin(), kSolvedQuantityNames.end());
  return static_cast<SolvedQuantity>(choice_option("--quantity", arguments.quantity, names));
}

/// Numbers of the whole bed instead of concentrations.
int solve_bed(const SolveArguments& arguments, SolvedQuantity quantity) {
  if (!arguments.depths.empty())
    refuse("--depths", arguments.depths, "must not be given: " + arguments.quantity + " has no depth");
  if (!arguments.map.empty())
    refuse("--map", arguments.map, "must not be given with --quantity " + arguments.quantity);
  if (!arguments.fronts.empty())
    refuse("--fronts", arguments.fronts, "must not be given with --quantity " + arguments.quantity);
  SolverOptions options = arguments.method.options();
  const auto scene = read_scene<double>(arguments.scene);
  if (const std::string reason = refusal_of_course(scene); !reason.empty())
    refuse("--quantity", arguments.quantity, "must suit the scene: " + reason);
  const std::vector<double> times = list_option("--times", arguments.times, {0}, ">= 0", Steady::allowed);
  if (static_cast<double>(times.size()) > kMostSamples)
    refuse("--times", arguments.times, "must give at most 1e8 times");
  OutputFile output(arguments.output.empty() ? "-" : arguments.output);
  check_picture_target(arguments.plot);
  note_unused_layers(arguments.method, scene);

  ProgressLine progress;
  options.progress = progress.callback();
  const BedCourse course = bed_course(quantity, arguments.method.method(), scene, times, options);
  if (!course.summary.usable()) return report_unusable(course.summary);
  std::string extra;
  if (course.lowest)
    extra = fmt::format(R"("lowest": {{"t": {}, "H": {}}})", number_text(course.lowest->t),
                        number_text(course.lowest->height));
  if (arguments.json)
    write_time_table_json(output, scene.name(), arguments.method.method(), course.table, extra,
                          course.summary);
  else
    write_time_table_csv(output, course.table);
  output.commit();
  if (course.lowest && !arguments.json)
    note(fmt::format("the bed is lowest at t = {}: H = {}", number_text(course.lowest->t, 7),
                     number_text(course.lowest->height, 10)));
  if (arguments.plot.empty()) return kDone;
  return draw_bed_course(arguments.plot, scene, arguments.method.method(), course, options);
}

int solve(const SolveArguments& arguments) {
  check_arguments(arguments);
  if (const SolvedQuantity quantity = quantity_of(arguments); quantity != SolvedQuantity::concentration)
    return solve_bed(arguments, quantity);
  SolverOptions options = arguments.method.options();
  const auto scene = read_scene<double>(arguments.scene);
  const SolverRequest request = request_of(arguments, scene);
  if (!arguments.map.empty() && !(last_time(request.times) > 0))
    refuse("--map", arguments.map, "needs a time > 0 to draw up to among --times");
  OutputFile output(arguments.output.empty() ? "-" : arguments.output);
  std::optional<OutputFile> fronts;
  if (request.fronts) fronts.emplace(arguments.fronts);
  check_picture_target(arguments.plot);
  check_picture_target(arguments.map);
  note_unused_layers(arguments.method, scene);

  ProgressLine progress;
  options.progress = progress.callback();
  const SolverResult result = solve_with(arguments.method.method(), scene, request, options);
  if (!result.summary.usable()) return report_unusable(result.summary);

  std::vector<double> times = request.times;  // as printed
  for (double& t : times)
    if (!std::isfinite(t) && result.timeline && result.timeline->t_star) t = *result.timeline->t_star;
  if (arguments.json)
    write_samples_json(output, scene.name(), arguments.method.method(), times, request.heights, result.samples,
                       result.summary);
  else
    write_samples_csv(output, times, request.heights, result.samples);
  if (fronts) write_fronts_csv(*fronts, result.fronts);
  if (fronts) fronts->commit();
  output.commit();
  const int drawn = draw(arguments, scene, request, result, times, options);
  if (arguments.map.empty() || drawn != kDone) return drawn;
  return draw_map(arguments.map, scene, arguments.method.method(), last_time(times), options);
}

}  // namespace

Command add_solve(CLI::App& program) {
  const auto arguments = std::make_shared<SolveArguments>();
  CLI::App* app =
      program.add_subcommand("solve", "Concentration phi and cumulative M at given times and depths");
  app->add_option("SCENE", arguments->scene, "scene file")->type_name("")->required();
  app->add_option("--times", arguments->times, "times: 0.5,6 or start:stop:count or steady, also mixed")
      ->type_name("LIST");
  app->add_option("--depths", arguments->depths, "heights z: as --times; default 101 over the whole domain")
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
  app->add_option("--map", arguments->map,
                  "picture of phi over time and height, up to the last time: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_flag("--json", arguments->json, "write JSON instead of CSV");
  return {app, "SCENE", [arguments] { return solve(*arguments); }};
}

}  // namespace shearfront::tools
