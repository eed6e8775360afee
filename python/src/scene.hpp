// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <utility>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/method.hpp"

namespace shearfront::python {

/// A scene that runs, fits and threads share.
struct SharedScene {
  explicit SharedScene(Scene<double> of) : scene(std::make_shared<const Scene<double>>(std::move(of))) {}
  std::shared_ptr<const Scene<double>> scene;
};

/// Refuses heights outside the domain. Errors: InputError (key "z").
void check_height(const Scene<double>& scene, double z);
/// Refuses times below 0 as well; infinity is the steady state.
void check_place(const Scene<double>& scene, double t, double z);

}  // namespace shearfront::python
