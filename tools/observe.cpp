// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/observe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <boost/version.hpp>
#include <memory>
#include <utility>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/progress.hpp"
#include "cli/scene.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solution/bed_height.hpp"

namespace shearfront::tools {
namespace {

constexpr double kMostRows = 1e7;
constexpr unsigned long long kLargestSeed = 9'223'372'036'854'775'807;  // what parse_count() reads
constexpr double kLargestSigma = 1e100;                                 // far from overflow with any value

struct ObserveArguments {
  SceneArgument scene;
  std::string times, depths, quantity = "point", width, noise, seed, output;
  bool truncate = false;
  MethodArguments method;
};

/// What the arguments say once they are checked, defaults filled in.
struct Experiment {
  ObservationPlan plan;
  double sigma = 0;
  unsigned long long seed = 1;
};

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity q : {Quantity::point, Quantity::bin, Quantity::cumulative, Quantity::bed_height})
    names.emplace_back(name_of(q));
  return names;  // in the order of Quantity
}

double width_of(const ObserveArguments& arguments, const ObservationPlan& plan) {
  if (plan.quantity != Quantity::bin) {
    if (!arguments.width.empty()) refuse("--width", arguments.width, "needs --quantity bin");
    return 0;
  }
  if (!arguments.width.empty())
    return number_option("--width", arguments.width, {0, std::numeric_limits<double>::max(), true}, "> 0");
  const auto spacing = equal_spacing(plan.depths);
  if (!spacing)
    throw InputError("--width", "", "missing; must be given where the depths are not equally spaced");
  return *spacing;
}

/// The first complaint about the plan as one of the option it comes from.
void check_plan(const ObserveArguments& arguments, const ObservationPlan& plan, const Scene<double>& scene) {
  const Complaints complaints = find_complaints(plan, scene.bottom(), scene.top());
  if (complaints.empty()) return;
  const Complaint& complaint = complaints.front();
  const std::string key = complaint.key.substr(0, complaint.key.find('['));
  if (key == "width") refuse("--width", complaint.value, complaint.constraint);
  refuse(key == "times" ? "--times" : "--heights", key == "times" ? arguments.times : arguments.depths,
         fmt::format("{} (here {})", complaint.constraint, complaint.value));
}

void check_arguments(const ObserveArguments& arguments) {
  constexpr std::string_view kLists = "missing; must be a list such as 0.5,6 or 0:10:21";
  if (arguments.times.empty()) throw InputError("--times", "", std::string(kLists));
  const bool has_depths = arguments.quantity != name_of(Quantity::bed_height);
  if (has_depths && arguments.depths.empty()) throw InputError("--heights", "", std::string(kLists));
  if (!has_depths && !arguments.depths.empty())
    refuse("--heights", arguments.depths, "must not be given: the height of the bed has no depth");
  if (arguments.noise.empty() && !arguments.seed.empty()) refuse("--seed", arguments.seed, "needs --noise");
  if (arguments.noise.empty() && arguments.truncate) throw InputError("--truncate", "", "needs --noise");
  check_outputs(arguments.scene.file(), {{"-o", arguments.output}});
}

Experiment experiment_of(const ObserveArguments& arguments, const Scene<double>& scene) {
  Experiment experiment;
  ObservationPlan& plan = experiment.plan;
  plan.quantity = static_cast<Quantity>(choice_option("--quantity", arguments.quantity, quantity_names()));
  if (!arguments.noise.empty())
    experiment.sigma =
        number_option("--noise", arguments.noise, {0, kLargestSigma}, ">= 0 (a standard deviation)");
  if (!arguments.seed.empty()) experiment.seed = count_option("--seed", arguments.seed, 0, kLargestSeed);
  const std::string inside =
      fmt::format("inside the domain [{}, {}]", number_text(scene.bottom()), number_text(scene.top()));
  plan.times = list_option("--times", arguments.times, {0}, ">= 0", Steady::refused);
  if (plan.quantity == Quantity::bed_height) {
    if (const std::string reason = BedHeight::refusal(scene); !reason.empty())
      refuse("--quantity", arguments.quantity, "must suit the scene: " + reason);
  } else {
    plan.depths =
        list_option("--heights", arguments.depths, {scene.bottom(), scene.top()}, inside, Steady::refused);
  }
  if (static_cast<double>(plan.times.size()) * static_cast<double>(plan.depths.size()) > kMostRows)
    refuse("--times", arguments.times, "must give at most 1e7 pairs of time and depth");
  plan.width = width_of(arguments, plan);
  check_plan(arguments, plan, scene);
  return experiment;
}

/// A word of a command line for a POSIX shell.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kSafe =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,:/@%";
  if (!text.empty() && text.find_first_not_of(kSafe) == std::string::npos) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// The scene with its changes.
std::string scene_words(const SceneArgument& scene) {
  std::string words = shell_word(scene.file());
  for (const std::string& change : scene.set()) words += " --set " + shell_word(change);
  return words;
}

std::string command_line(const ObserveArguments& arguments, const Method& method,
                         const Experiment& experiment) {
  std::string line = fmt::format("shearfront observe {} --times {}{} --quantity {}",
                                 scene_words(arguments.scene), shell_word(arguments.times),
                                 arguments.depths.empty() ? "" : " --depths " + shell_word(arguments.depths),
                                 arguments.quantity);
  if (experiment.plan.width > 0) line += " --width " + number_text(experiment.plan.width);
  line += " " + settings(method);
  if (experiment.sigma > 0)
    line += fmt::format(" --noise {} --seed {}{}", number_text(experiment.sigma), experiment.seed,
                        arguments.truncate ? " --truncate" : "");
  return line;
}

/// All that is needed to make the file again, without what does not change it (the name of the file).
std::vector<std::string> recipe(const ObserveArguments& arguments, const Method& method,
                                const Experiment& experiment, const std::string& scene) {
  std::vector<std::string> lines{
      "Synthetic observations, no measurements; made with shearfront " SHEARFRONT_VERSION " by",
      "  " + command_line(arguments, method, experiment)};
  if (experiment.sigma > 0)
    lines.push_back(fmt::format("Normal noise of standard deviation {} (Boost " BOOST_LIB_VERSION
                                ": mt19937_64, normal_distribution){}",
                                number_text(experiment.sigma),
                                arguments.truncate ? ", then clipped to the range of the quantity" : ""));
  lines.emplace_back("The scene file:");
  for (std::size_t begin = 0; begin < scene.size();) {
    const std::size_t end = std::min(scene.find('\n', begin), scene.size());
    lines.push_back(end > begin ? "| " + scene.substr(begin, end - begin) : "|");
    begin = end + 1;
  }
  return lines;
}

int observe_scene(ObserveArguments& arguments) {
  check_arguments(arguments);
  const Method method = arguments.method.method();
  const auto scene = arguments.scene.read();
  if (scene.is_slab())
    throw InputError(printable(arguments.scene.file()), "",
                     "has a table slab: `solve --method slab` gives phi(x, z, t)");
  const Experiment experiment = experiment_of(arguments, scene);
  const SolverRequest request = request_of(experiment.plan, scene);
  OutputFile output(arguments.output.empty() ? "-" : arguments.output);
  note_before_run(arguments.method, method, scene);

  const SolverResult result =
      with_progress([&](const Progress& progress) { return solve(scene, method, request, progress); });
  if (!result.summary.usable()) return report_unusable(result.summary);
  note_remark(result.summary);

  Observations observations = observe(experiment.plan, scene, result);
  add_noise(observations, experiment.sigma, experiment.seed);
  if (arguments.truncate) clip(observations, scene);
  const SceneUnits& units = scene.spec().units;
  const bool is_height =
      observations.quantity == Quantity::cumulative || observations.quantity == Quantity::bed_height;
  observations.units = {units.t, units.z, is_height ? units.z : "", units.is_chute};
  // Files of tables may change or be left behind: then all numbers stand here.
  const std::string& text = arguments.scene.text();
  observations.comments =
      recipe(arguments, method, experiment, names_tables_in_files(text) ? scene_text(scene.spec()) : text);
  write_observations(output, observations);
  output.commit();
  return kDone;
}

}  // namespace

Command add_observe(CLI::App& program) {
  const auto arguments = std::make_shared<ObserveArguments>();
  CLI::App* app = program.add_subcommand("observe", "Synthetic observations of a scene, with noise");
  arguments->scene.add_to(*app);
  app->add_option("--times", arguments->times, "times: 0.5,6 or start:stop:count, also mixed")
      ->type_name("LIST");
  app->add_option("--heights,--depths", arguments->depths, "heights z, for bins of their middles: as --times")
      ->type_name("LIST");
  app->add_option(
         "--quantity", arguments->quantity,
         "phi at a point, its mean over a bin, M = integral of phi from the bottom, or the height of the "
         "bed; default point")
      ->type_name(fmt::format("{}", fmt::join(quantity_names(), "|")));
  app->add_option("--width", arguments->width, "width of the bins; default the spacing of the depths")
      ->type_name("W");
  arguments->method.add_to(*app);
  app->add_option("--noise", arguments->noise, "standard deviation of normal noise; default none")
      ->type_name("SIGMA");
  app->add_option("--seed", arguments->seed, "seed of the noise, a whole number; default 1")->type_name("S");
  app->add_flag(
      "--truncate", arguments->truncate,
      "clip noisy values: phi to [0, 1], M to [0, height above the bottom] (not heights of the bed)");
  app->add_option("-o", arguments->output, "result file, CSV; default standard output")->type_name("FILE");
  return {app, "SCENE", [arguments] { return observe_scene(*arguments); }};
}

}  // namespace shearfront::tools
