// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
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
#include "shearfront/digits/exact_digits.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

constexpr int kDoubleDigits = 17;
// Few enough fronts to be told apart.
constexpr const char* kPictureResolution = "0.04";
constexpr const char* kPictureLayers = "100";

struct EventsArguments {
  std::string scene, digits, plot;
  bool json = false;
  MethodArguments method;
};

/// One row of the table: the time and its text, empty if it never comes; `exact` is the time by another road.
struct EventRow {
  std::string event, meaning;
  std::optional<double> time;
  std::optional<std::string> text;
  std::optional<ClosedForm> form;
  std::optional<double> exact;
};

std::vector<EventRow> event_rows(const Timeline<double>& timeline, const TimelineText& text,
                                 const ClosedForms& forms, const std::optional<Timeline<double>>& exact) {
  const std::size_t n = timeline.interfaces.size();
  const auto number = [n](std::size_t i) { return n == 1 ? std::string() : fmt::format("({})", i + 1); };
  const auto other = [](const std::optional<ClosedForm>& form, const auto& time) -> std::optional<double> {
    if (form) return form->value;
    return time;
  };
  const auto exact_at = [&](std::size_t i) {
    return exact && i < exact->interfaces.size() ? exact->interfaces[i] : Timeline<double>::InterfaceTimes{};
  };
  const Timeline<double> none;
  const Timeline<double>& by_formula = exact ? *exact : none;
  std::vector<EventRow> rows;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& at = timeline.interfaces[i];
    rows.push_back({"t_c" + number(i), "first wave at the interface z = " + number_text(at.z),
                    at.first, text.interfaces[i].first, forms.first_interface, other(forms.first_interface, exact_at(i).first)});
  }
  rows.push_back({"t_0", "first wave at the bottom", timeline.t0, text.t0, forms.t0, other(forms.t0, by_formula.t0)});
  rows.push_back({"t_1", "first wave at the top", timeline.t1, text.t1, forms.t1, other(forms.t1, by_formula.t1)});
  for (std::size_t i = 0; i < n; ++i) {
    const auto& at = timeline.interfaces[i];
    rows.push_back({"t^_c" + number(i), "last change at the interface z = " + number_text(at.z),
                    at.last, text.interfaces[i].last, forms.last_interface, other(forms.last_interface, exact_at(i).last)});
  }
  rows.push_back(
      {"t*", "steady state", timeline.t_star, text.t_star, forms.t_star, other(forms.t_star, by_formula.t_star)});
  return rows;
}

/// With so many digits, or the shortest text that reads back if digits is 0.
std::string shown(double x, int digits) {
  if (digits == 0) return number_text(x);
  return x == 0 ? "0" : number_text(x, digits);
}

std::string event_table(const std::vector<EventRow>& rows, int digits, bool compare) {
  TextTable table({"event", "meaning", "time", compare ? "exact" : "", compare ? "relative difference" : "",
                   "closed form"});
  for (const EventRow& row : rows) {
    std::string exact, difference;
    if (compare && row.exact) {
      exact = shown(*row.exact, digits);
      if (row.time && *row.exact != 0)
        difference = fmt::format("{:.1e}", *row.time / *row.exact - 1);
    }
    table.add({row.event, row.meaning, row.text.value_or("never"), exact, difference,
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

/// Event times computed elsewhere, to compare with; nothing if the exact solver cannot do this scene.
std::optional<Timeline<double>> exact_times(const Scene<double>& scene) {
  SolverRequest request;
  request.timeline = true;
  const SolverResult result = shearfront::solve(scene, Method(), request);
  return result.summary.usable() ? result.timeline : std::nullopt;
}

/// `text` are the times as they are printed, `digits` those of times by another road.
void print_events(const EventsArguments& arguments, const Scene<double>& scene, const Timeline<double>& timeline,
                  const TimelineText& text, const Summary& summary, int digits) {
  OutputFile out("-");
  const Method chosen = arguments.method.method();
  const std::string_view method = chosen.name();
  if (arguments.json) {
    write_events_json(out, scene.name(), method, text, summary);
  } else {
    const bool compare = !Method(method).guarantees().exact;
    const auto exact = compare ? exact_times(scene) : std::nullopt;
    out.write(fmt::format("{} ({})\n\n", printable(scene.name(), 100), method));
    const ClosedForms forms = closed_forms(scene);
    out.write(event_table(event_rows(timeline, text, forms, exact), digits, compare));
    if (forms.t0)
      out.write(
          "\nz0 initial jump, zc interface, h top (heights above the bottom); "
          "k0, k1 rates s a below and above the interface\n");
    out.write(fmt::format("\nmass {}, steady height {}\n", text.mass, text.steady_height));
    out.write(summary_line(summary));
  }
  out.commit();
}

/// Fronts for the picture, by the first solver that has fronts.
int draw(const EventsArguments& arguments, const Scene<double>& scene, const Timeline<double>& timeline) {
  SolverOptions options{arguments.method.with(Method::names(&Guarantees::has_fronts).front()), {}};
  if (!arguments.method.has("resolution")) set_option(options.method, "resolution", kPictureResolution, "");
  if (!arguments.method.has("layers")) set_option(options.method, "layers", kPictureLayers, "");
  SolverRequest request;
  request.times = {std::numeric_limits<double>::infinity()};
  request.heights = {scene.bottom()};
  request.fronts = true;
  const SolverResult result = shearfront::solve(scene, options.method, request, options.progress);
  if (!result.summary.usable()) return report_unusable(result.summary);
  return draw_fronts(arguments.plot, scene, result.fronts, timeline, number_of(options.method, "resolution"));
}

int events(const EventsArguments& arguments) {
  const Method chosen = arguments.method.method();
  const std::string_view method = chosen.name();
  SolverOptions options{arguments.method.method(), {}};
  const int digits = arguments.digits.empty()
                         ? 0
                         : static_cast<int>(count_option("--digits", arguments.digits, 1, kMostDigits));
  if (!Method(method).guarantees().has_timeline)
    refuse(
        "--method", method,
        fmt::format("computes no event times; must be one of: {}", fmt::join(Method::names(&Guarantees::has_timeline), ", ")));
  if (digits > kDoubleDigits && !chosen.guarantees().exact)
    refuse("--digits", arguments.digits,
           fmt::format("must be <= {} with --method {}; only {} computes more digits", kDoubleDigits, method,
                       Method().name()));
  check_picture_name("--plot", arguments.plot);
  check_outputs(arguments.scene, {{"--plot", arguments.plot}});
  const auto scene = with_remarks(read_scene<double>(arguments.scene));
  check_picture_target(arguments.plot);
  note_unused_layers(arguments.method, scene);

  ProgressLine progress;
  options.progress = progress.callback();
  SolverRequest request;
  request.timeline = true;
  SolverResult result = shearfront::solve(scene, options.method, request, options.progress);
  if (!result.summary.usable()) {
    if (arguments.json) {
      Timeline<double> unknown;
      unknown.mass = scene.mass();
      unknown.steady_height = scene.bottom() + unknown.mass;
      print_events(arguments, scene, unknown, text_of(unknown, 0), result.summary, 0);
    }
    return report_unusable(result.summary);
  }
  TimelineText text;
  if (digits > kDoubleDigits) {
    const auto begin = std::chrono::steady_clock::now();
    text = exact_digits(arguments.scene, static_cast<std::size_t>(number_of(chosen, "layers")), digits);
    result.summary.message = fmt::format("computed with {} digits", kComputedDigits);
    result.summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  } else {
    text = text_of(*result.timeline, arguments.json ? 0 : digits);
  }
  print_events(arguments, scene, *result.timeline, text, result.summary, digits);
  return arguments.plot.empty() ? kDone : draw(arguments, scene, *result.timeline);
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
