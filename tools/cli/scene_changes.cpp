// SPDX-License-Identifier: BSD-3-Clause
#include "cli/scene_changes.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "cli/arguments.hpp"

namespace shearfront::tools {

void SceneChangesOption::add_to(CLI::App& app) {
  app.add_option("--set", words_,
                 "another number for an entry of the scene: shear_rate.values[1]=0.4; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

SceneChanges SceneChangesOption::changes() const {
  SceneChanges changes;
  for (const std::string& text : words_) {
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

}  // namespace shearfront::tools
