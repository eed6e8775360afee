// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/track/scene_tangents.hpp"

/// How the flux and the numbers of a layer move with an entry: what the StateMotion of every grid is made of.
namespace shearfront::track_detail {

/// d(strength f(x)) where the share moves by dx; for a state at an extremum, where f has no slope or a kink, with its model.
struct FluxMotion {
  const Flux<double>& flux;
  const Flux<Dual<1>>* moving;  ///< none: its numbers stay
  double strength, strength_by;

  [[nodiscard]] double operator()(double x, double dx) const {
    if (moving) {
      const Dual<1> value = moving->value(Dual<1>(x, dx));
      return strength_by * value.v + strength * value.d[0];
    }
    const double slope = dx != 0 ? strength * flux.derivative(x) * dx : 0;
    return strength_by != 0 ? strength_by * flux.value(x) + slope : slope;
  }
  /// dx at which strength f(x) moves by `df`.
  [[nodiscard]] double inverse(double x, double df) const {
    const double rest = df - (*this)(x, 0);
    return rest != 0 ? rest / (strength * flux.derivative(x)) : 0;
  }
};

/// Derivatives of range and extrema of a flux, with the values.
struct FluxPlaces {
  StateRange<Dual<1>> range;
  std::vector<Dual<1>> extrema;
  explicit FluxPlaces(const Flux<Dual<1>>& flux) : range(flux.range()), extrema(flux.extrema()) {}
};

[[nodiscard]] inline const Flux<Dual<1>>* moving_flux_of(const SceneTangent& by, std::size_t flux) {
  return by.moving_flux == flux ? &by.fluxes[flux] : nullptr;
}

/// Rate and solid fraction of a layer, and the share of a state, with their derivatives.
struct LayerTangent {
  const Flux<Dual<1>>& flux;
  Dual<1> rate, solid_fraction;

  LayerTangent(const LayerStack<double>& stack, const SceneTangent& by, std::size_t k)
      : flux(by.fluxes[stack.flux_index(k)]),
        rate(stack.rate(k), by.rate[k]),
        solid_fraction(stack.solid_fraction(k), by.solid_fraction[k]) {}

  [[nodiscard]] Dual<1> share(double phi, double phi_by) const {
    return Dual<1>(phi, phi_by) / solid_fraction;
  }
  /// d |rate (f'(r) - f'(l)) / (x_r - x_l)| / c.
  [[nodiscard]] double fan_rate(const Dual<1>& x_l, const Dual<1>& x_r) const {
    return abs(rate * (flux.derivative(x_r) - flux.derivative(x_l)) / (x_r - x_l) / solid_fraction).d[0];
  }
  [[nodiscard]] double speed(const Dual<1>& x_l, const Dual<1>& x_r) const {
    return (rate * flux.secant(x_l, x_r)).d[0];
  }
};

/// The shares of two states of a grid whose states all lie on the flux, with their derivatives, and what moves in their layer.
struct SharesTangent {
  LayerTangent layer;
  Dual<1> l, r;

  template <class GridOf, class Rows>
  SharesTangent(const GridOf& of, const Rows& rows, const SceneTangent& by, const std::vector<double>& phi_by,
                std::size_t k, State below, State above)
      : layer(of.stack, by, k),
        l(layer.share(of.grid.phi(k, below), phi_by[rows(k, below)])),
        r(layer.share(of.grid.phi(k, above), phi_by[rows(k, above)])) {}

  [[nodiscard]] double fan_rate() const { return layer.fan_rate(l, r); }
  [[nodiscard]] double speed() const { return layer.speed(l, r); }
};

}  // namespace shearfront::track_detail
