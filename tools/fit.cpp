// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/fit_text.hpp"
#include "cli/fitted.hpp"
#include "cli/prediction_file.hpp"
#include "cli/progress.hpp"
#include "cli/scene_changes.hpp"
#include "plot/pictures.hpp"
#include "shearfront/fit/estimate_json.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/rate_band.hpp"
#include "shearfront/io/file_error.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

struct FitArguments {
  PictureOptions pictures;
  SceneChangesOption set;
  std::vector<std::string> files;
  std::string output, plot, truth, scene_out, band, predict, times, heights;
  bool json = false;
};

/// All files, with the complaints about all of them.
std::vector<fit::FitFile> read_files(const std::vector<std::string>& paths, const SceneChanges& changes) {
  std::vector<fit::FitFile> files;
  Complaints complaints;
  std::string report;
  for (const std::string& path : paths) {
    try {
      files.push_back(fit::read_fit_file(path, changes));
    } catch (const FileError& error) {
      complaints.insert(complaints.end(), error.complaints().begin(), error.complaints().end());
      report += (report.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!complaints.empty()) throw FileError(std::move(complaints), std::move(report));
  return files;
}

/// Refuses fits of other data, quantities or losses than the first. Errors: FileError that names both files.
void check_comparable(const std::vector<std::string>& names, const std::vector<fit::FitFile>& files) {
  Complaints complaints;
  std::string report;
  for (std::size_t i = 1; i < files.size(); ++i) {
    const std::string why = fit::incomparable(files.front().spec, files[i].spec);
    if (why.empty()) continue;
    complaints.push_back(
        {printable(names[i]), "", fmt::format("cannot be compared with {}: {}", printable(names[0]), why)});
    report += fmt::format("{}{}: {}", report.empty() ? "" : "\n", complaints.back().key,
                          complaints.back().constraint);
  }
  if (!complaints.empty()) throw FileError(std::move(complaints), std::move(report));
}

/// Remarks on standard error; `who` tells several fits apart.
int report_outcome(const fit::Estimate& estimate, const std::string& who) {
  if (!estimate.usable()) {
    fmt::print(stderr, "shearfront: {}no result ({}): {}\n", who, name_of(estimate.status),
               printable(estimate.message));
    return kNoResult;
  }
  if (estimate.status != Status::ok) note(who + printable(estimate.message));
  for (const std::string& warning : estimate.warnings) note(who + printable(warning, 500));
  return kDone;
}

/// Names that tell the models apart: their own, or those of the files.
std::vector<std::string> model_names(std::vector<std::string> paths,
                                     const std::vector<fit::Estimate>& estimates) {
  std::vector<std::string> names;
  for (const fit::Estimate& estimate : estimates) names.push_back(estimate.name);
  paths.resize(estimates.size());  // an interruption leaves some out
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() ? names : paths;
}

int print_one(const fit::Estimate& estimate, bool json) {
  OutputFile out("-");
  if (json)
    out.write(detail::json_document(to_json(estimate)));
  else if (estimate.usable())
    out.write(estimate_text(estimate));
  out.commit();
  return report_outcome(estimate, "");
}

int print_several(const std::vector<std::string>& names, const std::vector<fit::Estimate>& estimates,
                  bool json) {
  OutputFile out("-");
  const auto models = fit::compare_models(names, estimates);
  if (json) {
    detail::Json all{{"fits", detail::Json::array()}, {"comparison", comparison_json(models)}};
    for (const fit::Estimate& estimate : estimates) all["fits"].push_back(to_json(estimate));
    out.write(detail::json_document(all));
  } else {
    for (const fit::Estimate& estimate : estimates)
      if (estimate.usable()) out.write(estimate_text(estimate) + "\n");
    out.write(comparison_text(models));
  }
  out.commit();
  int code = kDone;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    code = std::max(code, report_outcome(estimates[i], printable(names[i], 100) + ": "));
  return code;
}

/// The models of one file: which is how good, the best in full, and a line for what is to be said about each other.
int print_models(const FittedModels& models, bool json) {
  const std::vector<fit::Estimate>& estimates = models.all.estimates;
  std::vector<std::string> names;
  for (const fit::FitSpec& spec : models.all.specs) names.push_back(spec.name);
  OutputFile out("-");
  const auto compared = fit::compare_models(names, estimates, models.criterion, models.n_searched);
  if (json) {
    detail::Json all{{"fits", detail::Json::array()}, {"comparison", comparison_json(compared)}};
    all["best"] = models.best ? detail::Json(names[*models.best]) : detail::Json();
    for (const fit::Estimate& estimate : estimates) all["fits"].push_back(to_json(estimate));
    out.write(detail::json_document(all));
  } else {
    out.write(comparison_text(compared));
    if (models.best) out.write("\n" + estimate_text(estimates[*models.best]));
  }
  out.commit();
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const fit::Estimate& e = estimates[i];
    if (i == models.best)
      (void)report_outcome(e, names[i] + ": ");
    else if (!e.usable())
      note(fmt::format("{}: no result ({}): {}", names[i], name_of(e.status), printable(e.message)));
    else if (!e.warnings.empty())
      note(fmt::format("{}: {}{}", names[i], printable(e.warnings.front(), 100),
                       e.warnings.size() == 1 ? "" : fmt::format(" (and {} more)", e.warnings.size() - 1)));
  }
  return models.best ? kDone : kNoResult;
}

PredictionPlan plan_of(const FitArguments& arguments, const Scene<double>& scene) {
  constexpr std::size_t kHeights = 101;
  if (arguments.predict.empty()) {
    if (!arguments.times.empty()) refuse("--times", arguments.times, "needs --predict");
    if (!arguments.heights.empty()) refuse("--heights", arguments.heights, "needs --predict");
    return {};
  }
  if (arguments.times.empty())
    throw InputError("--times", "", "missing; must be a list such as 0.5,6 or 0:10:21");
  PredictionPlan plan;
  plan.times = list_option("--times", arguments.times, {0}, ">= 0", Steady::refused);
  plan.heights = arguments.heights.empty()
                     ? equally_spaced(scene.bottom(), scene.top(), kHeights)
                     : list_option("--heights", arguments.heights, {scene.bottom(), scene.top()},
                                   fmt::format("inside the domain [{}, {}]", number_text(scene.bottom()),
                                               number_text(scene.top())),
                                   Steady::refused);
  return plan;
}

int fit_files(const FitArguments& arguments) {
  const bool is_one = arguments.files.size() == 1;
  const std::vector<Output> outputs{{"", "-"},
                                    {"-o", arguments.output},
                                    {"--plot", arguments.plot},
                                    {"--scene-out", arguments.scene_out},
                                    {"--band", arguments.band},
                                    {"--predict", arguments.predict}};
  for (const Output& output : outputs)
    if (!is_one && !output.option.empty() && !output.path.empty())
      refuse(output.option, output.path, "needs a single fit file");
  arguments.pictures.apply();
  check_picture_name("--plot", arguments.plot);
  std::vector<fit::FitFile> files = read_files(arguments.files, arguments.set.changes());
  for (std::size_t i = 0; !is_one && i < files.size(); ++i)
    if (files[i].choice)
      throw InputError(printable(arguments.files[i]), "",
                       "compares models already: it must be the only file");
  check_comparable(arguments.files, files);
  for (const std::string& input : {arguments.files[0], files[0].scene, files[0].observations})
    check_outputs(input, outputs);
  if (!arguments.truth.empty() && arguments.plot.empty()) refuse("--truth", arguments.truth, "needs --plot");
  std::optional<Scene<double>> truth;
  if (!arguments.truth.empty()) truth = with_remarks(read_scene<double>(arguments.truth));
  const PredictionPlan plan = plan_of(arguments, files[0].spec.scene);
  std::optional<OutputFile> output, scene_out, band, prediction;
  if (!arguments.output.empty()) output.emplace(arguments.output);
  if (!arguments.scene_out.empty()) scene_out.emplace(arguments.scene_out);
  if (!arguments.band.empty()) band.emplace(arguments.band);
  if (!arguments.predict.empty()) prediction.emplace(arguments.predict);
  check_picture_target(arguments.plot);
  for (const fit::FitFile& file : files) {
    print_remarks(file.remarks);
    print_remarks(file.spec.observations.notes);
  }

  std::vector<fit::Estimate> estimates;
  std::optional<FittedModels> models;
  bool is_interrupted = false;
  {
    const InterruptGuard guard;  // what follows ends at once
    if (is_one && files[0].choice)
      models = run_models(files[0], arguments.files[0]);
    else
      for (std::size_t i = 0; i < files.size() && !InterruptGuard::is_interrupted(); ++i)
        estimates.push_back(run_fit(files[i].spec, arguments.files[i]));
    is_interrupted = InterruptGuard::is_interrupted();
  }
  const std::string title = files[0].spec.name;
  std::vector<OtherModel> others;
  if (models) {
    const int code = print_models(*models, arguments.json);
    if (!models->best) return code;
    files[0].spec = models->all.specs[*models->best];
    for (std::size_t i = 0; i < models->all.specs.size(); ++i)
      if (i != *models->best && models->all.estimates[i].usable())
        others.push_back({models->all.specs[i].name, *models->all.estimates[i].scene});
    estimates.push_back(models->all.estimates[*models->best]);
  }
  if (!is_one) return print_several(model_names(arguments.files, estimates), estimates, arguments.json);
  const fit::Estimate& estimate = estimates.front();
  if (output && estimate.usable()) {
    write_residuals_csv(*output, files[0].spec.observations, estimate, files[0].spec.scene.spec().units);
    output->commit();
  }
  if (scene_out && estimate.usable()) {
    scene_out->write(scene_text(estimate.scene->spec()));
    scene_out->commit();
  }
  if (band && estimate.usable()) {
    const fit::RateBand rates =
        fit::rate_band(fit::Parameters(files[0].spec.scene, files[0].spec.unknown), estimate);
    write_band_csv(*band, rates, files[0].spec.scene.spec().units);
    band->commit();
    note_rate_band(rates);
  }
  if (prediction && estimate.usable() && !is_interrupted) {
    const fit::FitSpec& spec = files[0].spec;
    write_predictions_csv(*prediction, plan, *estimate.scene,
                          fit::scenes_behind(fit::Parameters(spec.scene, spec.unknown), estimate,
                                             kPredictionDraws, spec.search.seed),
                          spec.forward.method);
    prediction->commit();
  }
  const int code = files[0].choice ? kDone : print_one(estimate, arguments.json);
  if (is_interrupted && (prediction || !arguments.plot.empty()))
    note("interrupted: no --predict and no --plot, which need more runs");
  if (arguments.plot.empty() || is_interrupted) return code;
  return std::max(code, draw_fit(arguments.plot, files[0].spec, estimate, title, truth, others));
}

}  // namespace

Command add_fit(CLI::App& program) {
  const auto arguments = std::make_shared<FitArguments>();
  CLI::App* app = program.add_subcommand(
      "fit", "Find entries of a scene from observations; several fit files are compared as models");
  app->add_option("FIT", arguments->files, "fit files")->type_name("")->required();
  arguments->set.add_to(*app);
  app->add_option("-o", arguments->output, "observed and predicted values and residuals as CSV")
      ->type_name("FILE");
  app->add_option("--plot", arguments->plot,
                  "picture of data, fit, shear rate and search: FILE.svg, .png or .pdf")
      ->type_name("FILE");
  app->add_option("--truth", arguments->truth, "scene whose s a(z) --plot shows as well")->type_name("SCENE");
  app->add_option("--scene-out", arguments->scene_out, "the fitted scene, a scene file")->type_name("FILE");
  app->add_option("--band", arguments->band,
                  "s a(z) with its 95 % bands as CSV, of each height by itself and of all at once")
      ->type_name("FILE");
  app->add_option(
         "--predict", arguments->predict,
         "phi, M, the height of the bed and event times with their 95 % bands as CSV, at --times and "
         "--heights")
      ->type_name("FILE");
  app->add_option("--times", arguments->times, "of --predict: 0.5,6 or start:stop:count")->type_name("LIST");
  app->add_option("--heights", arguments->heights, "of --predict; default 101 over the whole domain")
      ->type_name("LIST");
  arguments->pictures.add_to(*app);
  app->add_flag("--json", arguments->json, "print JSON");
  app->footer(
      "Ctrl-C ends the search with the best point so far (status interrupted); a second one ends the "
      "program.");
  return {app, "FIT...", [arguments] { return fit_files(*arguments); }};
}

}  // namespace shearfront::tools
