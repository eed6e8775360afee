// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <variant>

#include "cli/command.hpp"
#include "cli/scene_changes.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/scene_uncertainty.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

std::string counted(std::size_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string layers_text(const Scene<double>& scene) {
  if (!scene.is_layered()) return "smooth shear rate";
  return counted(scene.knots().size() + 1, "layer");
}

std::string start_text(const Scene<double>& scene) {
  const auto& start = scene.spec().initial_state;
  if (!start) return counted(scene.initial_breaks().size(), "jump");
  return "smooth start (" + std::visit([](const auto& model) { return std::string(model.kName); }, *start) +
         ")";
}

std::string summary_text(const Scene<double>& scene) {
  return fmt::format("{}, {}, {}, mass {}", quoted_text(scene.name(), 80), layers_text(scene),
                     start_text(scene), number_text(scene.mass()));
}

/// "t 0 to 6 [s]"
std::string range_text(std::string_view name, const std::vector<Observation>& rows,
                       double Observation::*member, const std::string& unit) {
  const auto [least, most] = std::minmax_element(
      rows.begin(), rows.end(),
      [member](const Observation& a, const Observation& b) { return a.*member < b.*member; });
  return fmt::format("{} {} to {}{}", name, number_text((*least).*member), number_text((*most).*member),
                     unit.empty() ? "" : " [" + printable(unit, 40) + "]");
}

std::string summary_text(const Observations& data) {
  const bool has_place = data.quantity != Quantity::bed_height;
  const std::string_view symbol = !has_place ? "H" : data.quantity == Quantity::cumulative ? "M" : "phi";
  return fmt::format(
      "{} ({}), {}, {}{}{}{}", counted(data.rows.size(), "observation"), name_of(data.quantity),
      range_text(data.units.is_chute ? "x" : "t", data.rows, &Observation::t, data.units.t),
      has_place ? range_text("z", data.rows, &Observation::z, data.units.z) + ", " : "",
      range_text(symbol, data.rows, &Observation::value, data.units.value), data.has_sigma() ? ", sigma" : "",
      data.n_missing > 0 ? fmt::format(", {} missing", data.n_missing) : "");
}

std::string summary_text(const fit::FitFile& file) {
  const fit::FitSpec& spec = file.spec;
  return fmt::format("{}, {}, {} ({}), {}, {}", quoted_text(spec.name, 80),
                     file.choice ? counted(file.choice->models.size(), "model")
                                 : counted(fit::Parameters(spec.scene, spec.unknown).size(), "unknown"),
                     counted(spec.observations.rows.size(), "observation"),
                     name_of(spec.observations.quantity), spec.forward.method.name(), spec.search.algorithm);
}

bool is_csv(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension == ".csv";
}

void check_scene(const std::string& file, const Scene<double>& scene) {
  print_remarks(scene.spec().remarks);
  (void)fit::read_uncertainty(detail::TextSource::read(file).text(), file, scene);
}

/// What there is to say about a good file.
std::string check_file(const std::string& file, const std::optional<Scene<double>>& scene,
                       const SceneChanges& changes) {
  if (!is_csv(file)) {
    const auto content = fit::read_scene_or_fit(file, changes);
    if (const auto* fit_file = std::get_if<fit::FitFile>(&content))
      print_remarks(fit_file->remarks);
    else
      check_scene(file, std::get<Scene<double>>(content));
    return std::visit([](const auto& good) { return summary_text(good); }, content);
  }
  const Observations data = scene ? read_observations(file, *scene) : read_observations(file);
  print_remarks(data.notes);
  return summary_text(data);
}

struct CheckArguments {
  SceneChangesOption set;
  std::vector<std::string> files;
  std::string scene;
};

int check(const CheckArguments& arguments) {
  std::optional<Scene<double>> scene;
  const SceneChanges changes = arguments.set.changes();
  if (!arguments.scene.empty()) scene = with_remarks(read_scene<double>(arguments.scene, changes));
  OutputFile out("-");
  bool all_good = true;
  for (const std::string& file : arguments.files) {
    try {
      out.write(fmt::format("{}: ok: {}\n", printable(file), check_file(file, scene, changes)));
    } catch (const FileError& error) {
      fmt::print(stderr, "{}\n", error.what());
      all_good = false;
    }
  }
  out.commit();
  return all_good ? kDone : kBadInput;
}

}  // namespace

Command add_check(CLI::App& program) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* app = program.add_subcommand(
      "check", "Validate scene files, fit files and files of observations and report every problem");
  app->add_option("FILE", arguments->files, "scene files, fit files, and files of observations (.csv)")
      ->type_name("")
      ->required();
  arguments->set.add_to(*app);
  app->add_option("--scene", arguments->scene, "the scene whose domain the observations must lie in")
      ->type_name("SCENE");
  return {app, "FILE...", [arguments] { return check(*arguments); }};
}

}  // namespace shearfront::tools
