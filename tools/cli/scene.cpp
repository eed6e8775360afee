// SPDX-License-Identifier: BSD-3-Clause
#include "cli/scene.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
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
  app.add_option("--set", set_,
                 "another number for an entry of the scene: shear_rate.values[1]=0.4; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

SceneChanges SceneArgument::changes() const {
  SceneChanges changes;
  for (const std::string& text : set_) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos || sign == 0)
      refuse("--set", text, "must be an entry and its number, such as shear_rate.values[1]=0.4");
    const std::string key = text.substr(0, sign);
    if (std::any_of(changes.begin(), changes.end(), [&](const SceneChange& c) { return c.key == key; }))
      refuse("--set", text, "must not change an entry twice");
    changes.push_back({key, text.substr(sign + 1)});
  }
  return changes;
}

Scene<double> SceneArgument::read() {
  if (file_ != "-" && is_fit_file(file_)) {
    if (!set_.empty()) refuse("--set", set_.front(), "must not be given with a fit file");
    Fitted result = fitted(file_);
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
