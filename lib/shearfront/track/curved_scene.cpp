// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
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

bool is_in_layers(const std::optional<DepthFunction<double>>& function) {
  return !function || curve_of(*function) == RateCurve::constant;
}

SolidHeights solid_heights(const Scene<double>& scene, const std::vector<double>& ends) {
  if (!scene.spec().solid_fraction) return {};
  std::vector<double> fractions;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    fractions.push_back(rates_of(*scene.spec().solid_fraction, ends[k], ends[k + 1]).low);
  return {ends, fractions};
}

std::vector<RatePiece> pieces_of(const Scene<double>& scene, const std::vector<double>& ends,
                                 const SolidHeights& heights, RateCurve curve, double factor) {
  std::vector<RatePiece> pieces;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double lo = ends[k], hi = ends[k + 1];
    const EndValues<double> a = rates_of(scene.shear_rate(), lo, hi);
    double scale = scene.scale() * factor;
    if (scene.spec().temperature) scale *= std::sqrt(rates_of(*scene.spec().temperature, lo, hi).low);
    if (scene.spec().solid_fraction) scale *= rates_of(*scene.spec().solid_fraction, lo, hi).low;
    pieces.emplace_back(heights.y_of(lo), heights.y_of(hi), scale * a.low, scale * a.high, curve);
  }
  return pieces;
}

template <class StateOf>
std::vector<StartSegment> start_of(const Scene<double>& scene, const std::vector<RatePiece>& pieces,
                                   const SolidHeights& heights, const StateOf& state_of) {
  std::vector<double> breaks;
  for (const double z : scene.initial_breaks()) breaks.push_back(heights.y_of(z));
  const std::vector<double>& values = scene.initial_values();
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

/// phi / c = offset + slope u of a smooth start, y the height.
std::shared_ptr<const StartShape> shape_of(const Scene<double>& scene, const CurvedScene& curved) {
  StartShape shape;
  shape.u = [scene, heights = curved.heights, offset = curved.offset, slope = curved.slope](double y) {
    return std::clamp((scene.initial_share(heights.z_of(y)) - offset) / slope, 0.0, 1.0);
  };
  shape.amount = [scene, heights = curved.heights, offset = curved.offset, slope = curved.slope](double lo,
                                                                                                 double hi) {
    return (scene.initial_amount(heights.z_of(lo), heights.z_of(hi)) - offset * (hi - lo)) / slope;
  };
  return std::make_shared<const StartShape>(std::move(shape));
}

std::vector<StartSegment> smooth_start_of(const Scene<double>& scene, const CurvedScene& curved,
                                          const FluxBranches* flux) {
  const auto shape = shape_of(scene, curved);
  std::vector<double> knots;
  for (const double z : scene.initial_knots()) knots.push_back(curved.heights.y_of(z));
  std::vector<StartSegment> start;
  auto knot = knots.begin();
  for (std::size_t p = 0; p < curved.problem.pieces.size(); ++p) {
    const RatePiece& piece = curved.problem.pieces[p];
    double from = piece.z_low;
    for (; knot != knots.end() && *knot < piece.z_high; ++knot) {
      if (!(*knot > from)) continue;
      add_smooth_segments(start, piece, p, from, *knot, shape, flux);
      from = *knot;
    }
    add_smooth_segments(start, piece, p, from, piece.z_high, shape, flux);
  }
  return start;
}

CurvedScene scene_with(const Scene<double>& scene, std::shared_ptr<const FluxBranches> branches) {
  const Flux<double>& flux = scene.fluxes().front();
  const StateRange<double> range = flux.range();
  const double width = range.highest - range.lowest, top = flux.extrema().front(), extremum = flux.value(top);
  const bool has_maximum = extremum > 0;
  CurvedScene curved;
  std::vector<double> ends{scene.bottom()};
  for (const double z : scene.knots()) ends.push_back(z);
  ends.push_back(scene.top());
  curved.heights = solid_heights(scene, ends);
  curved.bottom = scene.bottom();
  curved.offset = has_maximum ? range.highest : range.lowest;
  curved.slope = has_maximum ? -width : width;
  const auto state_of = [&](double share) {
    if (share == top && branches) return branches->top();
    return std::clamp((share - curved.offset) / curved.slope, 0.0, 1.0);
  };
  CurvedProblem& problem = curved.problem;
  problem.pieces =
      pieces_of(scene, ends, curved.heights, *curve_of(scene.shear_rate()), 4 * std::abs(extremum) / width);
  problem.start = scene.has_smooth_start() ? smooth_start_of(scene, curved, branches.get())
                                           : start_of(scene, problem.pieces, curved.heights, state_of);
  problem.ends.is_periodic = scene.spec().is_periodic;
  const std::array outside{&scene.spec().outside_bottom, &scene.spec().outside_top};
  for (std::size_t end = 0; end < 2; ++end) {
    if (!*outside[end]) continue;
    problem.ends.changes[end] = (*outside[end])->breaks;
    for (const double share : (*outside[end])->values) problem.ends.states[end].push_back(state_of(share));
  }
  problem.flux = std::move(branches);
  return curved;
}

}  // namespace

SolidHeights::SolidHeights(std::vector<double> ends, std::vector<double> fractions)
    : z_(std::move(ends)), y_{z_.front()}, c_(std::move(fractions)) {
  for (std::size_t k = 0; k < c_.size(); ++k) y_.push_back(y_[k] + c_[k] * (z_[k + 1] - z_[k]));
}
std::size_t SolidHeights::layer_of(const std::vector<double>& ends, double height) {
  const auto it = std::upper_bound(ends.begin() + 1, ends.end() - 1, height);
  return static_cast<std::size_t>(it - ends.begin()) - 1;
}
double SolidHeights::y_of(double z) const {
  if (c_.empty()) return z;
  if (z == z_.back()) return y_.back();
  const std::size_t k = layer_of(z_, z);
  return y_[k] + c_[k] * (z - z_[k]);
}
double SolidHeights::z_of(double y) const {
  if (c_.empty()) return y;
  if (!(y < y_.back())) return z_.back();
  const std::size_t k = layer_of(y_, y);
  return std::min(z_[k + 1], z_[k] + (y - y_[k]) / c_[k]);
}
double SolidHeights::fraction(double y) const { return c_.empty() ? 1 : c_[layer_of(y_, y)]; }

Profile<double> CurvedScene::profile_of(const Lines& lines) const {
  std::vector<double> z = lines.ends(), below = lines.below(), above = lines.above();
  for (std::size_t i = 0; i < below.size(); ++i) {
    const double c = heights.fraction(z[i] + (z[i + 1] - z[i]) / 2);
    below[i] = c * share_of(below[i]);
    above[i] = c * share_of(above[i]);
  }
  for (double& height : z) height = heights.z_of(height);
  return {std::move(z), std::move(below), std::move(above)};
}

bool has_curved_fronts(const Scene<double>& scene) {
  if (scene.is_layered() || scene.fluxes().size() != 1 || scene.has_diffusion() || scene.spec().is_neumann)
    return false;
  const Flux<double>& flux = scene.fluxes().front();
  const std::optional<RateCurve> curve = curve_of(scene.shear_rate());
  return curve && *curve != RateCurve::constant && FluxBranches::suits(flux) &&
         is_in_layers(scene.spec().temperature) && is_in_layers(scene.spec().solid_fraction);
}

CurvedScene curved_scene(const Scene<double>& scene) {
  const Flux<double>& flux = scene.fluxes().front();
  return scene_with(scene, flux.is_parabola() ? nullptr : std::make_shared<const FluxBranches>(flux));
}

double count_curved_levels(const Scene<double>& scene, double resolution) {
  return count_levels(scene_with(scene, nullptr).problem, resolution);
}

}  // namespace shearfront
