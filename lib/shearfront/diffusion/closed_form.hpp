// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <variant>

#include "shearfront/scene/scene.hpp"

namespace shearfront::diffusion {

/// phi and M = int_bottom^z phi of a closed form.
struct ClosedFormValue {
  double phi = 0, M = 0;
};
struct ClosedForm {
  std::function<ClosedFormValue(double z, double t)> value;
  /// By how much phi may differ from the solution at time t because the form does not hold at the ends of the
  /// bed; none: it holds there.
  std::function<double(double t)> end_effect{};

  [[nodiscard]] double effect_of_ends(double t) const { return end_effect ? end_effect(t) : 0; }
};

/// The closed form of a scene with diffusion, or why it has none; see ColeHopfSolver for those known.
[[nodiscard]] std::variant<ClosedForm, std::string> closed_form(const Scene<double>& scene);

}  // namespace shearfront::diffusion
