// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/io/scene_file.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/method.hpp"

namespace shearfront::python {

/// A scene that runs, fits and threads share.
struct SharedScene {
  explicit SharedScene(Scene<double> of) : scene(std::make_shared<const Scene<double>>(std::move(of))) {}
  std::shared_ptr<const Scene<double>> scene;
};

/// Entries of a scene and their numbers, as a file has them.
using Changes = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] inline SceneChanges changes_of(const Changes& pairs) {
  SceneChanges changes;
  for (const auto& [key, value] : pairs) changes.push_back({key, value});
  return changes;
}

/// Refuses heights outside the domain. Errors: InputError (key "z").
void check_height(const Scene<double>& scene, double z);
/// Refuses times below 0 as well; infinity is the steady state.
void check_place(const Scene<double>& scene, double t, double z);

}  // namespace shearfront::python
