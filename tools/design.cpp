// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/design.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/fitted.hpp"
#include "cli/progress.hpp"
#include "cli/scene_changes.hpp"
#include "cli/table.hpp"
#include "plot/picture.hpp"
#include "plot/pictures.hpp"
#include "shearfront/io/detail/json.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solution/bed_height.hpp"

namespace shearfront::tools {
namespace {

constexpr double kMostCandidates = 1e5;
constexpr std::size_t kMostListed = 40;

struct DesignArguments {
  SceneChangesOption set;
  PictureOptions pictures;
  std::string file, times, heights, quantities, sigma, number = "20", unit = "measurement", criterion = "D",
                                                       draws = "1", seed, output, plot;
  bool alone = false, json = false;
};

/// What one of --quantity says: bin:0.05, point, cumulative, bed-height.
struct MeasuredQuantity {
  std::string text;
  Quantity quantity = Quantity::bin;
  double width = 0;
};

/// What the fit was made of, where nothing else is asked for.
MeasuredQuantity quantity_of_data(const Observations& observations) {
  const double width = observations.rows.front().width;
  return {std::string(name_of(observations.quantity)) + (width > 0 ? ":" + number_text(width) : ""),
          observations.quantity, width};
}

std::vector<MeasuredQuantity> quantities_of(const DesignArguments& arguments, const fit::FitSpec& spec) {
  if (arguments.quantities.empty()) return {quantity_of_data(spec.observations)};
  constexpr std::string_view kAllowed = "must be a list of point, bin:WIDTH, cumulative and bed-height";
  std::vector<MeasuredQuantity> all;
  for (const std::string_view text : split(arguments.quantities, ',')) {
    MeasuredQuantity one{std::string(text)};
    const std::size_t colon = text.find(':');
    bool is_known = false;
    for (const Quantity q : {Quantity::point, Quantity::bin, Quantity::cumulative, Quantity::bed_height})
      if (name_of(q) == text.substr(0, colon)) one.quantity = q, is_known = true;
    if (!is_known || (one.quantity == Quantity::bin) != (colon != std::string_view::npos))
      refuse("--quantity", arguments.quantities, kAllowed);
    if (one.quantity == Quantity::bin)
      one.width = number_option("--quantity", text.substr(colon + 1),
                                {0, spec.scene.top() - spec.scene.bottom(), true},
                                "must have a width > 0 that fits into the domain");
    if (one.quantity == Quantity::bed_height)
      if (const std::string why = BedHeight::refusal(spec.scene); !why.empty())
        refuse("--quantity", arguments.quantities, "must suit the scene: " + why);
    all.push_back(std::move(one));
  }
  return all;
}

/// The times and heights of the data, each once, where none are given.
std::vector<double> places_of_data(const Observations& observations, double Observation::*place) {
  std::set<double> all;
  for (const Observation& o : observations.rows) all.insert(o.*place);
  return {all.begin(), all.end()};
}

/// Without their noise.
Observations candidates_of(const DesignArguments& arguments, const fit::FitSpec& spec,
                           const MeasuredQuantity& quantity) {
  const Scene<double>& scene = spec.scene;
  const auto times = arguments.times.empty()
                         ? places_of_data(spec.observations, &Observation::t)
                         : list_option("--times", arguments.times, {0}, ">= 0", Steady::refused);
  std::vector<double> heights{0};
  if (quantity.quantity != Quantity::bed_height) {
    if (arguments.heights.empty() && spec.observations.quantity == Quantity::bed_height)
      throw InputError("--heights", "", "missing; must be a list such as 0.05:0.95:19");
    heights = arguments.heights.empty()
                  ? places_of_data(spec.observations, &Observation::z)
                  : list_option("--heights", arguments.heights, {scene.bottom(), scene.top()},
                                fmt::format("inside the domain [{}, {}]", number_text(scene.bottom()),
                                            number_text(scene.top())),
                                Steady::refused);
  }
  if (static_cast<double>(times.size()) * static_cast<double>(heights.size()) > kMostCandidates)
    refuse("--times", arguments.times, "must give at most 1e5 pairs of time and height");
  Observations candidates;
  candidates.quantity = quantity.quantity;
  for (const double t : times)
    for (const double z : heights)
      if (quantity.width == 0 || is_bin_inside(z, quantity.width, scene.bottom(), scene.top()))
        candidates.rows.push_back({t, z, 0, quantity.width});
  if (candidates.rows.empty())
    refuse("--quantity", quantity.text, "must have a bin inside the domain at one of the heights");
  return candidates;
}

/// The noise of a measurement: as asked for, as the data have it (their median), as the fit found it.
std::optional<double> given_sigma(const DesignArguments& arguments, const Observations& observations) {
  if (!arguments.sigma.empty())
    return number_option("--sigma", arguments.sigma, {0, std::numeric_limits<double>::max(), true}, "> 0");
  if (!observations.has_sigma()) return std::nullopt;
  std::vector<double> all;
  for (const Observation& o : observations.rows) all.push_back(o.sigma);
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

std::string unit_name(fit::DesignUnit unit, std::size_t n) {
  const std::string one(fit::kDesignUnitNames[static_cast<std::size_t>(unit)]);
  return n == 1 ? one : one + "s";
}

/// "t = 0.5: z = 0.1, 0.2" for measurements, or a list of times or heights; `along` is t, or x of chutes.
std::string chosen_text(const fit::Design& design, const Observations& candidates, fit::DesignUnit unit,
                        const std::string& along) {
  std::vector<std::string> places;
  std::string text;
  double t = std::numeric_limits<double>::quiet_NaN();
  const auto flush = [&] {
    if (unit == fit::DesignUnit::measurement && !places.empty())
      text += fmt::format("  {} = {}: z = {}\n", along, number_text(t), fmt::join(places, ", "));
    else if (!places.empty())
      text +=
          fmt::format("  {} = {}\n", unit == fit::DesignUnit::time ? along : "z", fmt::join(places, ", "));
    places.clear();
  };
  for (const fit::DesignChoice& choice : design.choices) {
    if (!choice.is_chosen) continue;
    const Observation& o = candidates.rows[choice.rows.front()];
    if (unit == fit::DesignUnit::measurement && o.t != t) flush();
    t = o.t;
    places.push_back(number_text(unit == fit::DesignUnit::time ? o.t : o.z));
  }
  flush();
  return text;
}

std::string design_text(const fit::Design& design, const Observations& candidates,
                        const MeasuredQuantity& quantity, const fit::DesignSpec& wanted,
                        const std::string& along) {
  const auto number = [](double x) {
    return std::isfinite(x) ? fmt::format("{:.3g}", x) : std::string("undetermined");
  };
  std::string text = fmt::format(
      "{} of {} {} ({}, sigma {}){}, {}: at least {:.0f} % of the information of the best\n", wanted.n,
      design.choices.size(), unit_name(wanted.unit, design.choices.size()), quantity.text,
      number_text(candidates.rows.front().sigma), wanted.adds ? " beside the data" : " without the data",
      wanted.criterion == fit::Criterion::target
          ? "for " + wanted.target
          : std::string(fit::kCriterionNames[static_cast<std::size_t>(wanted.criterion)]) + "-optimal",
      std::floor(100 * design.efficiency()));
  TextTable table({"unknown", "estimate", "std. error now",
                   fmt::format("{} spread evenly", design.evenly_spread), fmt::format("{} chosen", wanted.n),
                   "evenly / chosen"});
  for (std::size_t j = 0; j < design.unknowns.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    table.add({design.unknowns[j], number_text(design.estimates[i], 5), number(design.errors.before[i]),
               number(design.errors.evenly[i]), number(design.errors.chosen[i]),
               number(design.errors.evenly[i] / design.errors.chosen[i])});
  }
  text += table.text();
  const std::string places = chosen_text(design, candidates, wanted.unit, along);
  if (wanted.n <= kMostListed) text += places;
  return text;
}

void write_csv(OutputFile& file, const fit::Design& design, const Observations& candidates,
               const SceneUnits& units) {
  const bool has_width = candidates.rows.front().width > 0;
  file.write(has_width ? csv_header({"t", "z", "width", "weight", "worth", "chosen"}, units)
                       : csv_header({"t", "z", "weight", "worth", "chosen"}, units));
  for (const fit::DesignChoice& choice : design.choices)
    for (const std::size_t k : choice.rows) {
      const Observation& o = candidates.rows[k];
      file.write(fmt::format("{},{},{}{},{},{}\n", number_text(o.t), number_text(o.z),
                             has_width ? number_text(o.width) + "," : "", number_text(choice.weight),
                             number_text(choice.worth), choice.is_chosen ? 1 : 0));
    }
}

detail::Json design_json(const fit::Design& design, const Observations& candidates,
                         const MeasuredQuantity& quantity, const fit::DesignSpec& wanted,
                         const std::string& along) {
  const auto number = [](double x) { return std::isfinite(x) ? detail::Json(x) : detail::Json(); };
  detail::Json json{
      {"quantity", quantity.text},
      {"sigma", candidates.rows.front().sigma},
      {"unit", fit::kDesignUnitNames[static_cast<std::size_t>(wanted.unit)]},
      {"criterion", wanted.criterion == fit::Criterion::target
                        ? wanted.target
                        : std::string(fit::kCriterionNames[static_cast<std::size_t>(wanted.criterion)])},
      {"with_data", wanted.adds},
      {"candidates", design.choices.size()},
      {"efficiency_at_least", design.efficiency()},
      {"unknowns", detail::Json::array()},
      {"chosen", detail::Json::array()}};
  for (std::size_t j = 0; j < design.unknowns.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    json["unknowns"].push_back({{"name", design.unknowns[j]},
                                {"estimate", design.estimates[i]},
                                {"std_error_now", number(design.errors.before[i])},
                                {"std_error_evenly", number(design.errors.evenly[i])},
                                {"std_error", number(design.errors.chosen[i])}});
  }
  for (const fit::DesignChoice& choice : design.choices)
    if (choice.is_chosen)
      for (const std::size_t k : choice.rows)
        json["chosen"].push_back({{along, candidates.rows[k].t}, {"z", candidates.rows[k].z}});
  return json;
}

int draw_design(const std::string& path, const fit::FitSpec& spec, const fit::Design& design,
                const Observations& candidates, const std::string& subtitle) {
  Picture picture(path, "design");
  picture.set("title", spec.name);
  picture.set("subtitle", subtitle);
  picture.set("along", spec.scene.spec().units.symbol());
  picture.set("unit_t", without_markup(spec.scene.spec().units.t));
  picture.set("unit_z", without_markup(spec.scene.spec().units.z));
  picture.set("z_low", spec.scene.bottom());
  picture.set("z_high", spec.scene.top());
  picture.add_file("design.csv", [&](OutputFile& file) { write_csv(file, design, candidates, {}); });
  return picture.draw();
}

fit::DesignSpec wanted_of(const DesignArguments& arguments) {
  fit::DesignSpec wanted;
  wanted.n = count_option("--number", arguments.number, 1, static_cast<unsigned long long>(kMostCandidates));
  wanted.unit = static_cast<fit::DesignUnit>(
      choice_option("--unit", arguments.unit, {fit::kDesignUnitNames.begin(), fit::kDesignUnitNames.end()}));
  wanted.criterion = fit::Criterion::target;
  wanted.target = arguments.criterion;
  for (std::size_t i = 0; i + 1 < fit::kCriterionNames.size(); ++i)
    if (arguments.criterion == fit::kCriterionNames[i]) wanted.criterion = static_cast<fit::Criterion>(i);
  wanted.adds = !arguments.alone;
  wanted.draws = count_option("--draws", arguments.draws, 1, 1000);
  if (!arguments.seed.empty()) {
    if (wanted.draws == 1) refuse("--seed", arguments.seed, "needs --draws");
    wanted.seed = count_option("--seed", arguments.seed, 0, 9'223'372'036'854'775'807);
  }
  return wanted;
}

/// design() with its refusals as those of options.
fit::Design best_design(const fit::FitSpec& spec, const fit::Estimate& estimate,
                        const fit::DesignSpec& wanted, const MeasuredQuantity& quantity) {
  try {
    return fit::design(spec, estimate, wanted);
  } catch (const InputError& error) {
    const Complaint& complaint = error.complaints().front();
    const std::string option = complaint.key == "n"            ? "--number"
                               : complaint.key == "candidates" ? "--times"
                                                               : "--" + complaint.key;
    refuse(option, complaint.value, quantity.text + ": " + complaint.constraint);
  }
}

int design_measurements(const DesignArguments& arguments) {
  arguments.pictures.apply();
  check_picture_name("--plot", arguments.plot);
  fit::DesignSpec wanted = wanted_of(arguments);
  check_outputs(arguments.file, {{"-o", arguments.output}, {"--plot", arguments.plot}});
  if (!is_fit_file(arguments.file))
    throw InputError(printable(arguments.file), "",
                     "must be a fit file: its unknowns are what is to be known better");
  const fit::FitFile file = fit::read_fit_file(arguments.file, arguments.set.changes());
  if (file.choice)
    throw InputError(printable(arguments.file), "", "must have one model; [compare] has several");
  const fit::FitSpec& spec = file.spec;
  const std::vector<MeasuredQuantity> quantities = quantities_of(arguments, spec);
  for (const Output& output : {Output{"-o", arguments.output}, Output{"--plot", arguments.plot}})
    if (quantities.size() > 1 && !output.path.empty())
      refuse(output.option, output.path, "needs a single --quantity");
  std::vector<Observations> candidates;
  for (const MeasuredQuantity& quantity : quantities)
    candidates.push_back(candidates_of(arguments, spec, quantity));
  std::optional<double> sigma = given_sigma(arguments, spec.observations);
  check_picture_target(arguments.plot);
  print_remarks(file.remarks);
  print_remarks(spec.observations.notes);

  const fit::Estimate estimate = [&] {
    const InterruptGuard guard;
    return run_fit(spec, arguments.file);
  }();
  if (InterruptGuard::is_interrupted()) (void)std::raise(SIGINT);  // the fit is not what was asked for
  if (!estimate.usable())
    throw InputError(printable(arguments.file), "",
                     fmt::format("has no estimate ({}): {}", name_of(estimate.status), estimate.message));
  for (const std::string& warning : estimate.warnings) note(printable(warning, 500));
  if (!sigma) sigma = estimate.sigma;
  if (!(*sigma > 0)) throw InputError("--sigma", "", "missing; the fit leaves no noise to take its place");

  OutputFile out("-");
  detail::Json all = detail::Json::array();
  int code = kDone;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const MeasuredQuantity& quantity = quantities[i];
    wanted.candidates = candidates[i];
    for (Observation& o : wanted.candidates.rows) o.sigma = *sigma;
    const fit::Design design = best_design(spec, estimate, wanted, quantity);
    if (!arguments.output.empty()) {
      OutputFile table(arguments.output);
      write_csv(table, design, wanted.candidates, spec.scene.spec().units);
      table.commit();
    }
    if (arguments.json)
      all.push_back(
          design_json(design, wanted.candidates, quantity, wanted, spec.scene.spec().units.symbol()));
    else
      out.write(design_text(design, wanted.candidates, quantity, wanted, spec.scene.spec().units.symbol()));
    if (!arguments.plot.empty())
      code = draw_design(arguments.plot, spec, design, wanted.candidates,
                         fmt::format("{}, sigma {}; circles: the {} chosen", quantity.text,
                                     number_text(*sigma, 3), wanted.n));
  }
  if (arguments.json) out.write(detail::json_document(all));
  out.commit();
  return code;
}

}  // namespace

Command add_design(CLI::App& program) {
  const auto arguments = std::make_shared<DesignArguments>();
  CLI::App* app = program.add_subcommand(
      "design", "Where to measure next: the times and heights that say most about the unknowns of a fit");
  app->add_option("FIT", arguments->file, "fit file")->type_name("")->required();
  arguments->set.add_to(*app);
  app->add_option("--times", arguments->times, "times that could be measured; default those of the data")
      ->type_name("LIST");
  app->add_option("--heights", arguments->heights,
                  "heights that could be measured; default those of the data")
      ->type_name("LIST");
  app->add_option(
         "--quantity", arguments->quantities,
         "what is measured: point, bin:WIDTH, cumulative, bed-height; several are compared; default as "
         "the data")
      ->type_name("LIST");
  app->add_option("--sigma", arguments->sigma, "noise of a measurement; default that of the data")
      ->type_name("S");
  app->add_option("-n,--number", arguments->number, "how many are chosen, default 20")->type_name("N");
  app->add_option("--unit", arguments->unit,
                  "what is chosen as one: a measurement, all heights at a time, all times at a height")
      ->type_name(fmt::format("{}", fmt::join(fit::kDesignUnitNames, "|")));
  app->add_option(
         "--criterion", arguments->criterion,
         "what is to be small: D volume of the confidence region (default), A sum of the relative variances, "
         "E worst combination, or the name of an unknown")
      ->type_name("D|A|E|NAME");
  app->add_flag("--alone", arguments->alone, "in place of the data of the fit; default beside them");
  app->add_option("--draws", arguments->draws,
                  "the mean over so many scenes within the error bars; default 1, the estimate")
      ->type_name("N");
  app->add_option("--seed", arguments->seed, "of the draws")->type_name("N");
  app->add_option("-o", arguments->output, "all candidates with weight and worth as CSV")->type_name("FILE");
  app->add_option("--plot", arguments->plot, "picture of what a measurement is worth: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  arguments->pictures.add_to(*app);
  app->add_flag("--json", arguments->json, "print JSON");
  return {app, "FIT", [arguments] { return design_measurements(*arguments); }};
}

}  // namespace shearfront::tools
