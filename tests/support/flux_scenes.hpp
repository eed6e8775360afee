// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"
#include "support/random_scene.hpp"

/// Random scenes with other fluxes, solid fraction and temperature, and a naive Godunov scheme for them.
namespace shearfront::support {

/// Which fluxes a random scene takes: one shape, because a minimum may not face a maximum.
enum class FluxShape { convex_parabolas, concave_parabolas, convex, concave };

inline Flux<double> random_flux(SceneMaker& make, FluxShape shape) {
  switch (shape) {
    case FluxShape::convex_parabolas:
      return Quadratic<double>{};
    case FluxShape::concave_parabolas:
      if (make.integer(0, 1) == 0) return Lwr<double>{};
      return Lwr<double>{make.uniform(0.125, 2)};
    case FluxShape::convex:
      if (make.integer(0, 2) == 0) return Quadratic<double>{};
      if (make.integer(0, 1) == 0)
        return FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.1875, -0.25, -0.1875, 0}};
      if (make.integer(0, 1) == 0) return Cubic<double>{make.uniform(0, 0.5)};
      return Cubic<double>{make.uniform(0, 0.5), CubicScaling::quadratic_extremum};
    case FluxShape::concave:
      if (make.integer(0, 2) == 0) return Lwr<double>{make.uniform(0.125, 2)};
      {
        const double jam = make.uniform(0.125, 2);
        return Triangular<double>{jam * make.uniform(0.1, 0.7), jam};
      }
  }
  return Quadratic<double>{};
}

/// Up to four layers of a(z), one or two fluxes, c and T in up to three layers each; states in their ranges.
inline SceneSpec<double> random_flux_scene(SceneMaker& make, FluxShape shape) {
  const auto order = make.order();  // one draw after the other: the same scenes with every compiler
  const int n_layers = make.integer(1, 4);
  SceneSpec<double> spec = make.data(n_layers, order, 5);
  spec.fluxes = {random_flux(make, shape)};
  if (make.integer(0, 1) == 1) {
    spec.flux_breaks = make.heights(1, 0, 1);
    spec.fluxes.push_back(random_flux(make, shape));
  }
  const auto layers = [&](double lo, double hi) {
    Piecewise<double> model;
    const int n = make.integer(1, 3);
    model.breaks = make.heights(n - 1, 0, 1);
    for (int i = 0; i < n; ++i) model.values.push_back(make.uniform(lo, hi));
    return model;
  };
  if (make.integer(0, 1) == 1) spec.solid_fraction = layers(0.3, 1);
  if (make.integer(0, 1) == 1) spec.temperature = layers(0.25, 4);
  double jam = 1e300;
  for (const auto& flux : spec.fluxes) jam = std::min(jam, flux.range().highest);
  for (double& share : spec.initial_values) share *= jam;
  return spec;
}

/// Cell averages of phi by the Godunov scheme with supply and demand (the flux of Riemann problems between
/// fluxes with one extremum), cells of equal height with the numbers of their middles.
inline std::vector<double> godunov_any_scene(const Scene<double>& scene, double t, std::size_t n) {
  const double h = (scene.top() - scene.bottom()) / static_cast<double>(n);
  std::vector<double> share(n), c(n), rate(n), peak(n), flux(n + 1, 0.0);
  std::vector<const Flux<double>*> model(n);
  double fastest = 0;
  const auto value = [&](std::size_t j, double x) { return rate[j] * c[j] * model[j]->value(x); };
  bool concave = false;
  for (std::size_t j = 0; j < n; ++j) {
    const double z = scene.bottom() + (static_cast<double>(j) + 0.5) * h;
    model[j] = &scene.flux_at(z);
    c[j] = scene.solid_fraction_at(z);
    rate[j] = scene.scale() * scene.rate_at(z);
    share[j] = scene.initial_share(z);
    const Flux<double>& f = *model[j];
    peak[j] = f.extrema().front();
    concave = f.curvature() == Curvature::concave;
    for (const double x : {f.range().lowest, f.range().highest})
      fastest = std::max(fastest, rate[j] * std::abs(f.derivative(x)));
  }
  const auto steps = static_cast<std::size_t>(std::ceil(t * fastest / (0.9 * h)));
  const double dt = t / static_cast<double>(steps);
  for (std::size_t step = 0; step < steps; ++step) {
    for (std::size_t j = 1; j < n; ++j)
      flux[j] = concave ? std::min(value(j - 1, std::min(share[j - 1], peak[j - 1])),
                                   value(j, std::max(share[j], peak[j])))
                        : std::max(value(j - 1, std::max(share[j - 1], peak[j - 1])),
                                   value(j, std::min(share[j], peak[j])));
    for (std::size_t j = 0; j < n; ++j) share[j] -= dt / (h * c[j]) * (flux[j + 1] - flux[j]);
  }
  for (std::size_t j = 0; j < n; ++j) share[j] *= c[j];
  return share;
}

}  // namespace shearfront::support
