// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include "shearfront/numeric/scalar.hpp"

/// What an initial state may say of itself beyond value() and integral(), for engines that have a closed form for it.
/// A model that is of such a kind has a member of the name; others need none.
namespace shearfront {

/// phi = below + (above - below) / (1 + exp(-(z - centre) / width)).
template <Real Scalar>
struct LogisticStep {
  Scalar below, above, centre, width;
};

/// phi = mean + amplitude sin(2 pi (z - origin) / wavelength).
template <Real Scalar>
struct Wave {
  Scalar mean, amplitude, wavelength, origin;
};

/// The step that the initial state is, if it is one.
template <Real Scalar, class Model>
[[nodiscard]] std::optional<LogisticStep<Scalar>> logistic_step(const Model& model) {
  if constexpr (requires { model.logistic_step(); }) return model.logistic_step();
  return std::nullopt;
}

/// The wave that the initial state is, if it is one.
template <Real Scalar, class Model>
[[nodiscard]] std::optional<Wave<Scalar>> wave(const Model& model) {
  if constexpr (requires { model.wave(); }) return model.wave();
  return std::nullopt;
}

}  // namespace shearfront
