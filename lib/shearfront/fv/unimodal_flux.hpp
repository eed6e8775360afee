// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <variant>

#include "shearfront/model/flux/all.hpp"

namespace shearfront::fv {

/// A flux f on [lo, hi] with f(lo) == f(hi) == 0 and one extremum between: all the schemes need to know.
struct UnimodalFlux {
  double lo = 0, hi = 1;
  double extremum = 0.5;     ///< where f is least (is_minimum) or largest
  bool is_minimum = true;    ///< grains of this kind sink (f <= 0); otherwise they rise
  double largest_slope = 1;  ///< max |f'|
  std::function<double(double)> value, derivative;
  bool is_quadratic = false;  ///< a parabola, up to scale and sign phi (phi - 1): there is a fast kernel
  std::string refusal;        ///< why f cannot be used; empty if it can
};

/// A flux model as the schemes see it. The largest slope is that of a fine sampling which includes both
/// ends, where a convex or concave f is steepest. Cost: a few thousand evaluations.
template <class Model>
[[nodiscard]] UnimodalFlux unimodal_flux(const Model& model) {
  constexpr int kSlopeSamples = 4096;
  UnimodalFlux flux;
  flux.lo = model.range().lowest;
  flux.hi = model.range().highest;
  flux.value = [model](double phi) { return model.value(phi); };
  flux.derivative = [model](double phi) { return model.derivative(phi); };
  const std::vector<double> extrema = model.extrema();
  if (extrema.size() != 1) {
    flux.refusal =
        "flux " + std::string(Model::kName) + " has more than one extremum or none; front-tracking covers it";
    return flux;
  }
  flux.extremum = extrema[0];
  flux.is_minimum = flux.value(flux.extremum) < flux.value(flux.lo);
  if constexpr (requires { Model::kIsParabola; }) flux.is_quadratic = Model::kIsParabola;
  if (flux.value(flux.lo) != 0 || flux.value(flux.hi) != 0)
    flux.refusal = "flux " + std::string(Model::kName) + " does not vanish between pure states";
  flux.largest_slope = 0;
  for (int i = 0; i <= kSlopeSamples; ++i) {
    const double phi = flux.lo + (flux.hi - flux.lo) * i / kSlopeSamples;
    flux.largest_slope = std::max(flux.largest_slope, std::abs(model.derivative(phi)));
  }
  return flux;
}

}  // namespace shearfront::fv
