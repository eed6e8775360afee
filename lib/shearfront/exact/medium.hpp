// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <variant>

#include "shearfront/exact/exponential_medium.hpp"
#include "shearfront/exact/layered_medium.hpp"

namespace shearfront::exact {

/// The medium of a scene: layered a exactly, exponential a by closed forms, any other a as a staircase of
/// about `staircase_layers` layers.
template <Real Scalar>
[[nodiscard]] std::shared_ptr<const Medium<Scalar>> make_medium(const Scene<Scalar>& scene,
                                                                std::size_t staircase_layers) {
  if (scene.is_layered()) return std::make_shared<const LayeredMedium<Scalar>>(scene, exact_layers(scene));
  if (std::holds_alternative<Exponential<Scalar>>(scene.shear_rate()))
    return std::make_shared<const ExponentialMedium<Scalar>>(scene);
  return std::make_shared<const LayeredMedium<Scalar>>(scene, staircase(scene, staircase_layers));
}

/// Whether make_medium represents a(z) of the scene without approximation.
template <Real Scalar>
[[nodiscard]] bool has_exact_medium(const Scene<Scalar>& scene) {
  return scene.is_layered() || std::holds_alternative<Exponential<Scalar>>(scene.shear_rate());
}

}  // namespace shearfront::exact
