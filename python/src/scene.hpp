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

}  // namespace shearfront::python
