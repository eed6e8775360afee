// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "cli/arguments.hpp"
#include "cli/closed_form.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/prediction_file.hpp"
#include "cli/progress.hpp"
#include "cli/scene.hpp"
#include "cli/table.hpp"
#include "plot/pictures.hpp"
#include "shearfront/digits/exact_digits.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/scene/chute.hpp"

namespace shearfront::tools {
namespace {

constexpr int kDoubleDigits = 17;
/// Layers whose exact event times are computed only to stand beside others: some seconds.
constexpr std::size_t kMostCompared = 5000;
// Few enough fronts to be told apart.
constexpr double kPictureResolution = 0.04;

struct EventsArguments {
  PictureOptions pictures;
  SceneArgument scene;
  std::string digits, plot;
  bool json = false;
  MethodArguments method;
};

std::string band_text(const fit::Interval& band) {
  // As many digits as show how wide it is.
  const double width = band.high - band.low, size = std::max(std::abs(band.low), std::abs(band.high));
  const int digits = std::isfinite(size) && width > 0
                         ? std::clamp(std::max(static_cast<int>(std::ceil(std::log10(size / width))) + 2,
                                               static_cast<int>(std::ceil(std::log10(size)))),
                                      3, kDoubleDigits)
                         : 6;
  const auto end = [&](double t) { return std::isfinite(t) ? number_text(t, digits) : std::string("never"); };
  return fmt::format("[{}, {}]", end(band.low), end(band.high));
}

/// Event times as they are computed and printed, beside those by another road (formula or exact solver).
struct EventTable {
  const Scene<double>& scene;
  const Timeline<double>& timeline;
  const TimelineText& text;
  ClosedForms forms;
  std::optional<Timeline<double>> exact;
  int digits = 0;  ///< of times by another road; 0: the shortest text that reads back
  const fit::PredictedEvents* bands = nullptr;  ///< of a fitted scene
  SceneUnits units;
  std::string along = units.symbol();
  TextTable table{{"event", "meaning",
                   std::string(units.is_chute ? "distance" : "time") +
                       (units.t.empty() ? "" : " [" + printable(units.t, 20) + "]"),
                   bands ? "+-" : "", bands ? "95 %" : "", exact ? "exact" : "",
                   exact ? "relative difference" : "", "closed form"}};

  void add(const std::string& event, const std::string& meaning, const std::optional<double>& time,
           const std::optional<std::string>& shown, const std::optional<ClosedForm>& form,
           std::optional<double> other, const fit::PredictedNumber& band) {
    if (form) other = form->value;
    std::string exact_time, difference;
    if (exact && other) {
      exact_time = digits == 0 ? number_text(*other) : *other == 0 ? "0" : number_text(*other, digits);
      if (time && *other != 0) difference = fmt::format("{:.1e}", *time / *other - 1);
    }
    table.add({event, meaning, shown.value_or("never"), band.std_error ? number_text(*band.std_error, 2) : "",
               band.band ? band_text(*band.band) : "", exact_time, difference, form ? form->formula : ""});
  }
  /// `member` of TimelineText::InterfaceTimes and of its numbers.
  void add_interfaces(const std::string& event, const char* meaning,
                      std::optional<double> Timeline<double>::InterfaceTimes::*member,
                      std::optional<std::string> TimelineText::InterfaceTimes::*text_member,
                      const std::optional<ClosedForm>& form,
                      fit::PredictedNumber fit::PredictedEvents::AtInterface::*band) {
    const std::size_t n = timeline.interfaces.size() - n_kinks();
    std::size_t number = 0;
    const std::string in_unit = units.z.empty() ? "" : " " + printable(units.z, 20);
    for (std::size_t i = 0; i < timeline.interfaces.size(); ++i) {
      const auto& at = timeline.interfaces[i];
      if (!scene.jumps_at(at.z)) continue;
      ++number;
      std::optional<double> other;
      for (const auto& same : exact.value_or(Timeline<double>{}).interfaces)
        if (same.z == at.z) other = same.*member;
      add(event + (n == 1 ? "" : fmt::format("({})", number)), meaning + number_text(at.z) + in_unit,
          at.*member, text.interfaces[i].*text_member, form, other,
          bands && i < bands->interfaces.size() ? bands->interfaces[i].*band : fit::PredictedNumber{});
    }
  }
  /// Heights of the timeline that are no interfaces: points of a table where only the slope jumps.
  [[nodiscard]] std::size_t n_kinks() const {
    return static_cast<std::size_t>(std::count_if(timeline.interfaces.begin(), timeline.interfaces.end(),
                                                  [&](const auto& at) { return !scene.jumps_at(at.z); }));
  }
  [[nodiscard]] std::string all() {
    const Timeline<double> other = exact.value_or(Timeline<double>{});
    using Times = Timeline<double>::InterfaceTimes;
    using Texts = TimelineText::InterfaceTimes;
    using Bands = fit::PredictedEvents::AtInterface;
    const fit::PredictedEvents none, &band = bands ? *bands : none;
    add_interfaces(along + "_c", "first wave at the interface z = ", &Times::first, &Texts::first,
                   forms.first_interface, &Bands::first);
    add(along + "_0", "first wave at the bottom", timeline.t0, text.t0, forms.t0, other.t0, band.t0);
    add(along + "_1", "first wave at the top", timeline.t1, text.t1, forms.t1, other.t1, band.t1);
    add_interfaces(along + "^_c", "last change at the interface z = ", &Times::last, &Texts::last,
                   forms.last_interface, &Bands::last);
    add(along + "*", "steady state", timeline.t_star, text.t_star, forms.t_star, other.t_star, band.t_star);
    return table.text();
  }
};

std::string summary_line(const Summary& s) {
  std::string line;
  if (s.levels > 0)
    line = fmt::format("{} collisions, at most {} fronts, {} levels, ", s.collisions, s.fronts_max, s.levels);
  return line + fmt::format("{:.3g} s\n", s.wall_s);
}

EventBands bands_of(const fit::PredictedEvents& events) {
  EventBands all{result_band(events.t0), result_band(events.t1), result_band(events.t_star), {}};
  for (const auto& at : events.interfaces)
    all.interfaces.push_back({result_band(at.first), result_band(at.last)});
  return all;
}

/// Event times computed elsewhere, to compare with; none if the exact solver cannot do this scene, or would take much longer.
Timeline<double> exact_times(const Scene<double>& scene) {
  if (scene.knots().size() > kMostCompared) {
    note(
        fmt::format("no exact times beside these, of more than {} layers: --method {} takes a time that "
                    "grows like the square of "
                    "their number",
                    kMostCompared, Method().name()));
    return {};
  }
  SolverRequest request;
  request.timeline = true;
  return with_progress([&](const Progress& progress) { return solve(scene, Method(), request, progress); })
      .timeline.value_or(Timeline<double>{});
}

/// `text` are the times as they are printed, `digits` those of times by another road, `bands` those of a fitted scene.
void print_events(const EventsArguments& arguments, const Method& method, const Scene<double>& scene,
                  const Timeline<double>& timeline, const TimelineText& text, const Summary& summary,
                  int digits, const fit::PredictedEvents* bands = nullptr) {
  OutputFile out("-");
  if (arguments.json) {
    write_events_json(out, scene.name(), method.name(), text, summary,
                      bands ? bands_of(*bands) : EventBands{}, scene.spec().units);
  } else {
    const bool compare = !method.guarantees().exact;
    EventTable table{scene,
                     timeline,
                     text,
                     closed_forms(scene),
                     compare ? std::optional(exact_times(scene)) : std::nullopt,
                     digits,
                     bands,
                     scene.spec().units};
    out.write(fmt::format("{} ({})\n\n{}", printable(scene.name(), 100), method.name(), table.all()));
    if (const std::size_t n = table.n_kinks(); n > 0)
      out.write(fmt::format(
          "\n{} left out where only the slope of the bed jumps, as at points of a table: --json has {}\n",
          n == 1 ? std::string("1 height is") : fmt::format("{} heights are", n), n == 1 ? "it" : "them"));
    if (table.forms.t0)
      out.write(
          "\nz0 initial jump, zc interface, h top (heights above the bottom); "
          "k0, k1 rates s a below and above the interface\n");
    out.write(
        fmt::format("\nmass {}, steady height {}\n{}", text.mass, text.steady_height, summary_line(summary)));
    if (!timeline.t_star) out.write(summary.message + '\n');
  }
  out.commit();
}

/// Fronts for the picture, by the first solver that has fronts.
int draw_events(const EventsArguments& arguments, const Scene<double>& scene,
                const Timeline<double>& timeline) {
  Method method = arguments.method.with(Method::names(&Guarantees::has_fronts).front());
  if (!arguments.method.has("resolution")) method.set("resolution", kPictureResolution);
  SolverRequest request;
  request.times = {std::numeric_limits<double>::infinity()};
  request.fronts = true;
  const SolverResult result =
      with_progress([&](const Progress& progress) { return solve(scene, method, request, progress); });
  if (!result.summary.usable()) return report_unusable(result.summary);
  return draw_fronts(arguments.plot, scene, method, result.fronts, timeline);
}

/// Where pieces stand for the bed, digits beyond the estimated error are not known.
void refuse_unknown_digits(const EventsArguments& arguments, const Scene<double>& scene,
                           const Method& method) {
  ExactSolution<double>::Options settings;
  settings.layers = static_cast<std::size_t>(number_of(method, "layers"));
  if (const double tolerance = number_of(method, "tolerance"); tolerance > 0) settings.tolerance = tolerance;
  const Scene<double> bed = scene.is_chute() ? SteadyChute<double>(scene).bed() : scene;
  const ExactSolution<double> solution(bed, settings);
  if (!solution.is_exact() && solution.form().is_exact())
    refuse("--digits", arguments.digits,
           "must be left out for a smooth start where a(z) is not constant in pieces: its times are those of "
           "a search");
  if (!solution.is_exact())
    refuse("--digits", arguments.digits,
           fmt::format("must be left out for a bed that {} pieces stand for: its times are approximate",
                       solution.n_layers()));
}

int events(EventsArguments& arguments) {
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
                       method.name(), Method().name()));
  arguments.pictures.apply();
  check_picture_name("--plot", arguments.plot);
  check_outputs(arguments.scene.file(), {{"--plot", arguments.plot}});
  const auto scene = arguments.scene.read();
  check_picture_target(arguments.plot);
  note_before_run(arguments.method, method, scene);

  SolverRequest request;
  request.timeline = true;
  SolverResult result =
      with_progress([&](const Progress& progress) { return solve(scene, method, request, progress); });
  if (!result.summary.usable()) {
    Timeline<double> unknown;
    unknown.mass = scene.mass();
    unknown.steady_height = scene.bottom() + unknown.mass;
    if (arguments.json)
      print_events(arguments, method, scene, unknown, text_of(unknown, 0), result.summary, 0);
    return report_unusable(result.summary);
  }
  TimelineText text = text_of(*result.timeline, arguments.json ? 0 : digits);
  if (digits > 0 && method.guarantees().exact) refuse_unknown_digits(arguments, scene, method);
  if (digits > kDoubleDigits) {
    const auto begin = std::chrono::steady_clock::now();
    text = exact_digits(arguments.scene.text(), arguments.scene.file(), digits, arguments.scene.changes());
    result.summary.message = fmt::format("computed with {} digits", kComputedDigits);
    result.summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  std::optional<fit::PredictedEvents> bands;
  if (const fit::DrawnScenes* draws = arguments.scene.draws()) {
    bands = fit::predict_events(scene, *draws, method);
    note_draws(*draws, bands->n_failed);
    if (!arguments.json) note_bands(*draws, bands->n_by_draws, 3 + 2 * bands->interfaces.size());
  }
  print_events(arguments, method, scene, *result.timeline, text, result.summary, digits,
               bands ? &*bands : nullptr);
  if (!arguments.json) note_approximation(method, result.summary);
  return arguments.plot.empty() ? kDone : draw_events(arguments, scene, *result.timeline);
}

}  // namespace

Command add_events(CLI::App& program) {
  const auto arguments = std::make_shared<EventsArguments>();
  CLI::App* app =
      program.add_subcommand("events", "Times of the first and last waves at interfaces and walls");
  arguments->scene.add_to(*app);
  arguments->method.add_to(*app);
  app->add_option("--digits", arguments->digits,
                  "significant digits, 1 to 100; beyond 17 (exact only) computed in multiprecision")
      ->type_name("N");
  app->add_option("--plot", arguments->plot,
                  "picture of the fronts in the (t, z) plane: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  arguments->pictures.add_to(*app);
  app->add_flag("--json", arguments->json, "print JSON");
  return {app, "SCENE", [arguments] { return events(*arguments); }};
}

}  // namespace shearfront::tools
