// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace shearfront {
namespace {

/// How a(z) runs between its knots; nothing if in another way.
std::optional<RateCurve> curve_of(const DepthFunction<double>& function) {
  return std::visit(
      [](const auto& model) -> std::optional<RateCurve> {
        if (model.kIsLayered) return RateCurve::constant;
        if (is_linear_between_knots(model)) return RateCurve::linear;
        if (is_exponential_between_knots(model)) return RateCurve::exponential;
        return std::nullopt;
      },
      function);
}

EndValues<double> rates_of(const DepthFunction<double>& function, double lo, double hi) {
  return std::visit(
      [&](const auto& model) -> EndValues<double> {
        if (model.kIsLayered) return {model.value(lo), model.value(lo)};
        return end_values(model, lo, hi);
      },
      function);
}

std::vector<RatePiece> pieces_of(const Scene<double>& scene, RateCurve curve, double factor) {
  std::vector<double> ends{scene.bottom()};
  for (const double z : scene.knots()) ends.push_back(z);
  ends.push_back(scene.top());
  std::vector<RatePiece> pieces;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double lo = ends[k], hi = ends[k + 1];
    const EndValues<double> a = rates_of(scene.shear_rate(), lo, hi);
    double scale = scene.scale() * factor;
    if (scene.spec().temperature) scale *= std::sqrt(rates_of(*scene.spec().temperature, lo, hi).low);
    pieces.emplace_back(lo, hi, scale * a.low, scale * a.high, curve);
  }
  return pieces;
}

template <class StateOf>
std::vector<StartSegment> start_of(const Scene<double>& scene, const std::vector<RatePiece>& pieces,
                                   const StateOf& state_of) {
  const std::vector<double>&breaks = scene.initial_breaks(), &values = scene.initial_values();
  std::vector<StartSegment> start;
  std::size_t jump = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    double from = pieces[p].z_low;
    for (; jump < breaks.size() && breaks[jump] < pieces[p].z_high; ++jump) {
      if (!(breaks[jump] > from)) continue;
      start.push_back({p, from, breaks[jump], state_of(values[jump])});
      from = breaks[jump];
    }
    start.push_back({p, from, pieces[p].z_high, state_of(values[jump])});
  }
  return start;
}

}  // namespace

std::optional<CurvedScene> curved_scene(const Scene<double>& scene) {
  if (scene.is_layered() || scene.fluxes().size() != 1 || scene.has_diffusion() || scene.spec().is_neumann ||
      scene.spec().solid_fraction || scene.spec().initial_state)
    return std::nullopt;
  const Flux<double>& flux = scene.fluxes().front();
  const std::optional<RateCurve> curve = curve_of(scene.shear_rate());
  if (!flux.is_parabola() || !curve || *curve == RateCurve::constant) return std::nullopt;
  if (scene.spec().temperature && curve_of(*scene.spec().temperature) != RateCurve::constant)
    return std::nullopt;
  const StateRange<double> range = flux.range();
  if (flux.value(range.lowest) != 0 || flux.value(range.highest) != 0) return std::nullopt;
  const double width = range.highest - range.lowest, extremum = flux.value(flux.extrema().front());
  const bool has_maximum = extremum > 0;
  CurvedScene curved;
  curved.bottom = scene.bottom();
  curved.offset = has_maximum ? range.highest : range.lowest;
  curved.slope = has_maximum ? -width : width;
  const auto state_of = [&](double phi) {
    return std::clamp((phi - curved.offset) / curved.slope, 0.0, 1.0);
  };
  CurvedProblem& problem = curved.problem;
  problem.pieces = pieces_of(scene, *curve, 4 * std::abs(extremum) / width);
  problem.start = start_of(scene, problem.pieces, state_of);
  problem.ends.is_periodic = scene.spec().is_periodic;
  const std::array outside{&scene.spec().outside_bottom, &scene.spec().outside_top};
  for (std::size_t end = 0; end < 2; ++end) {
    if (!*outside[end]) continue;
    problem.ends.changes[end] = (*outside[end])->breaks;
    for (const double phi : (*outside[end])->values) problem.ends.states[end].push_back(state_of(phi));
  }
  return curved;
}

}  // namespace shearfront
