// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "shearfront/model/depth/model.hpp"
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

/// dphi/dz: a member slope(z), or else a difference of fourth order on the side of `middle`.
template <class Model, Real Scalar>
[[nodiscard]] Scalar start_slope(const Model& model, const Scalar& z, const Scalar& middle) {
  if constexpr (requires { model.slope(z, middle); }) {
    return model.slope(z, middle);
  } else {
    const Scalar h = (middle - z) * Scalar(std::ldexp(1.0, -std::numeric_limits<Scalar>::digits / 5));
    const auto at = [&](int n) { return Scalar(model.value(Scalar(z + h * Scalar(n)))); };
    return (Scalar(-25) * at(0) + Scalar(48) * at(1) - Scalar(36) * at(2) + Scalar(16) * at(3) -
            Scalar(3) * at(4)) /
           (Scalar(12) * h);
  }
}

/// Derivatives by the entries of the model: add(entry, that of phi(z), that of int_lo^z phi). By a member derivatives(lo, z, add), or
/// else by differences of fourth order.
template <class Model, Real Scalar, class Add>
void start_derivatives(const Model& model, const Scalar& lo, const Scalar& z, const Add& add) {
  if constexpr (requires { model.derivatives(lo, z, add); }) {
    model.derivatives(lo, z, add);
  } else {
    Model moved = model;
    const auto places = model_entries(moved);
    const Scalar unit(std::ldexp(1.0, -std::numeric_limits<Scalar>::digits / 5 - 2));
    for (std::size_t e = 0; e < places.size(); ++e) {
      const Scalar here = *places[e], size = here < 0 ? Scalar(-here) : here;
      const Scalar h = (size > 0 ? size : Scalar(1)) * unit;
      const auto by = [&](const auto& of) {
        const auto at = [&](int n) {
          *places[e] = here + h * Scalar(n);
          return Scalar(of());
        };
        const Scalar change = Scalar(8) * (at(1) - at(-1)) - (at(2) - at(-2));
        *places[e] = here;
        return Scalar(change / (Scalar(12) * h));
      };
      const Scalar by_value = by([&] { return moved.value(z); }),
                   by_integral = by([&] { return moved.integral(lo, z); });
      add(e, by_value, by_integral);
    }
  }
}

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
