// SPDX-License-Identifier: BSD-3-Clause
#include "cli/scene.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <utility>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "shearfront/fit/scene_uncertainty.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/scene_text.hpp"

namespace shearfront::tools {
namespace {

constexpr std::uint64_t kUncertaintySeed = 1;

}  // namespace

void SceneArgument::add_to(CLI::App& app) {
  app.add_option("SCENE", file_, "scene file (- for standard input), or a fit file: the fitted scene")
      ->type_name("")
      ->required();
  set_.add_to(app);
}

Scene<double> SceneArgument::read() {
  if (file_ != "-" && is_fit_file(file_)) {
    Fitted result = fitted(file_, changes());
    draws_ = std::move(result.draws);
    text_ = scene_text(result.estimate.scene->spec());
    return *result.estimate.scene;
  }
  text_ = detail::TextSource::read(file_).text();
  Scene<double> scene = with_remarks(parse_scene<double>(text_, file_, changes()));
  if (const auto uncertainty = fit::read_uncertainty(text_, file_, scene))
    draws_ = fit::draw_scenes(scene, *uncertainty, kPredictionDraws, kUncertaintySeed);
  return scene;
}

}  // namespace shearfront::tools
