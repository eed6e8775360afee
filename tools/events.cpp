// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <limits>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/closed_form.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/progress.hpp"
#include "cli/table.hpp"
#include "plot/pictures.hpp"
#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

constexpr int kDoubleDigits = 17, kMostDigits = 100;
// Few enough fronts to be told apart.
constexpr const char *kPictureResolution = "0.04", *kPictureLayers = "100";

struct EventsArguments {
  std::string scene, digits, plot;
  bool json = false;
  MethodArguments method;
};

/// One row of the table. Times that never come are empty; `exact` is the time by another road.
template <Real S>
struct EventRow {
  std::string event, meaning;
  std::optional<S> time;
  std::optional<ClosedForm> form;
  std::optional<double> exact;
};

template <Real S>
std::vector<EventRow<S>> event_rows(const Timeline<S>& timeline, const ClosedForms& forms,
                                    const Timeline<double>& exact) {
  const std::size_t n = timeline.interfaces.size();
  std::vector<EventRow<S>> rows;
  const auto add = [&](std::string event, std::string meaning, const std::optional<S>& time,
                       const std::optional<ClosedForm>& form, const std::optional<double>& other) {
    rows.push_back({std::move(event), std::move(meaning), time, form, form ? form->value : other});
  };
  const auto add_interfaces = [&](const char* symbol, const char* meaning, auto&& time_of, const auto& form) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::string z = number_text(to_double(timeline.interfaces[i].z));
      add(symbol + (n == 1 ? "" : fmt::format("({})", i + 1)), meaning + z, time_of(timeline.interfaces[i]),
          form, i < exact.interfaces.size() ? time_of(exact.interfaces[i]) : std::nullopt);
    }
  };
  add_interfaces(
      "t_c", "first wave at the interface z = ", [](const auto& at) { return at.first; },
      forms.first_interface);
  add("t_0", "first wave at the bottom", timeline.t0, forms.t0, exact.t0);
  add("t_1", "first wave at the top", timeline.t1, forms.t1, exact.t1);
  add_interfaces(
      "t^_c", "last change at the interface z = ", [](const auto& at) { return at.last; },
      forms.last_interface);
  add("t*", "steady state", timeline.t_star, forms.t_star, exact.t_star);
  return rows;
}

/// With so many digits, or the shortest text that reads back if digits is 0.
template <Real S>
std::string shown(const S& x, int digits) {
  if (digits == 0) return number_text(to_double(x));
  return x == 0 ? "0" : number_text(x, digits);
}

template <Real S>
std::string event_table(const std::vector<EventRow<S>>& rows, int digits, bool compare) {
  TextTable table({"event", "meaning", "time", compare ? "exact" : "", compare ? "relative difference" : "",
                   "closed form"});
  for (const EventRow<S>& row : rows) {
    std::string exact, difference;
    if (compare && row.exact) {
      exact = shown(*row.exact, digits);
      if (row.time && *row.exact != 0)
        difference = fmt::format("{:.1e}", to_double(*row.time) / *row.exact - 1);
    }
    table.add({row.event, row.meaning, row.time ? shown(*row.time, digits) : "never", exact, difference,
               row.form ? row.form->formula : ""});
  }
  return table.text();
}

std::string summary_line(const Summary& s) {
  std::string line;
  if (s.levels > 0)
    line = fmt::format("{} collisions, at most {} fronts, {} levels, ", s.collisions, s.fronts_max, s.levels);
  return line + fmt::format("{:.3g} s\n", s.wall_s);
}

/// Event times computed elsewhere, to compare with; none if the exact solver cannot do this scene.
Timeline<double> exact_times(const Scene<double>& scene) {
  SolverRequest request;
  request.timeline = true;
  return solve<ExactSolver>(scene, request).timeline.value_or(Timeline<double>{});
}

template <Real S>
void print_events(const EventsArguments& arguments, const Method& method, const Scene<double>& scene,
                  const Timeline<S>& timeline, const Summary& summary, int digits) {
  OutputFile out("-");
  if (arguments.json) {
    write_events_json(out, scene.name(), method.name(), timeline, summary, digits);
  } else {
    const bool compare = !method.guarantees().exact;
    const ClosedForms forms = closed_forms(scene);
    const auto rows = event_rows(timeline, forms, compare ? exact_times(scene) : Timeline<double>{});
    out.write(fmt::format("{} ({})\n\n{}", printable(scene.name(), 100), method.name(),
                          event_table(rows, digits, compare)));
    if (forms.t0)
      out.write(
          "\nz0 initial jump, zc interface, h top (heights above the bottom); "
          "k0, k1 rates s a below and above the interface\n");
    out.write(fmt::format("\nmass {}, steady height {}\n{}", shown(timeline.mass, digits),
                          shown(timeline.steady_height, digits), summary_line(summary)));
  }
  out.commit();
}

template <Real S>
int many_digits(const EventsArguments& arguments, const Method& method, const Scene<double>& scene,
                int digits) {
  const auto begin = std::chrono::steady_clock::now();
  const Scene<S> precise = read_scene<S>(arguments.scene);
  const Timeline<S> timeline =
      exact_timeline<S>(precise, TimelineOptions{static_cast<std::size_t>(number_of(method, "layers"))});
  Summary summary;
  summary.status = Status::ok;
  summary.message = fmt::format("computed with {} digits", std::numeric_limits<S>::digits10);
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  print_events(arguments, method, scene, timeline, summary, digits);
  return kDone;
}

/// Fronts for the picture, by the first solver that has fronts.
int draw(const EventsArguments& arguments, const Scene<double>& scene, const Timeline<double>& timeline,
         const Progress& progress) {
  Method method = arguments.method.with(Method::names(&Guarantees::has_fronts).front());
  if (!arguments.method.has("resolution")) set_option(method, "resolution", kPictureResolution, "");
  if (!arguments.method.has("layers")) set_option(method, "layers", kPictureLayers, "");
  SolverRequest request;
  request.times = {std::numeric_limits<double>::infinity()};
  request.fronts = true;
  const SolverResult result = solve(scene, method, request, progress);
  if (!result.summary.usable()) return report_unusable(result.summary);
  return draw_fronts(arguments.plot, scene, result.fronts, timeline, number_of(method, "resolution"));
}

int events(const EventsArguments& arguments) {
  const Method method = arguments.method.method();
  const int digits = arguments.digits.empty()
                         ? 0
                         : static_cast<int>(count_option("--digits", arguments.digits, 1, kMostDigits));
  if (!method.guarantees().has_timeline)
    refuse("--method", method.name(),
           fmt::format("computes no event times; must be one of: {}",
                       fmt::join(Method::names(&Guarantees::has_timeline), ", ")));
  if (digits > kDoubleDigits && !method.guarantees().exact)
    refuse("--digits", arguments.digits,
           fmt::format("must be <= {} with --method {}; only {} computes more digits", kDoubleDigits,
                       method.name(), ExactSolver::kName));
  check_picture_name("--plot", arguments.plot);
  check_outputs(arguments.scene, {{"--plot", arguments.plot}});
  const auto scene = read_scene<double>(arguments.scene);
  check_picture_target(arguments.plot);
  note_unused_layers(arguments.method, scene);

  ProgressLine progress;
  SolverRequest request;
  request.timeline = true;
  const SolverResult result = solve(scene, method, request, progress.callback());
  if (!result.summary.usable()) {
    Timeline<double> unknown;
    unknown.mass = scene.mass();
    unknown.steady_height = scene.bottom() + unknown.mass;
    if (arguments.json) print_events(arguments, method, scene, unknown, result.summary, 0);
    return report_unusable(result.summary);
  }
  if (digits > kDoubleDigits)
    many_digits<Real110>(arguments, method, scene, digits);
  else
    print_events(arguments, method, scene, *result.timeline, result.summary, digits);
  return arguments.plot.empty() ? kDone : draw(arguments, scene, *result.timeline, progress.callback());
}

}  // namespace

Command add_events(CLI::App& program) {
  const auto arguments = std::make_shared<EventsArguments>();
  CLI::App* app =
      program.add_subcommand("events", "Times of the first and last waves at interfaces and walls");
  app->add_option("SCENE", arguments->scene, "scene file")->type_name("")->required();
  arguments->method.add_to(*app);
  app->add_option("--digits", arguments->digits,
                  "significant digits, 1 to 100; beyond 17 (exact only) computed in multiprecision")
      ->type_name("N");
  app->add_option("--plot", arguments->plot,
                  "picture of the fronts in the (t, z) plane: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_flag("--json", arguments->json, "print JSON");
  return {app, "SCENE", [arguments] { return events(*arguments); }};
}

}  // namespace shearfront::tools
