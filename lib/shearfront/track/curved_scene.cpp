// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/track/solid_profile.hpp"

namespace shearfront {
namespace {

/// How a(z) runs between its knots; nothing if in another way, or if T or c varies there.
std::optional<RateCurve> curve_of(const Scene<double>& scene) {
  if (!is_constant_in_pieces<double>(scene.spec().temperature) ||
      !is_constant_in_pieces<double>(scene.spec().solid_fraction))
    return std::nullopt;
  return std::visit(
      [](const auto& model) -> std::optional<RateCurve> {
        if (model.kIsLayered) return RateCurve::constant;
        if (is_linear_between_knots(model)) return RateCurve::linear;
        if (is_exponential_between_knots(model)) return RateCurve::exponential;
        return std::nullopt;
      },
      scene.shear_rate());
}

/// s a sqrt(T) c times `factor` at both ends of an interval without a knot inside, as seen from within.
EndValues<double> rates_of(const Scene<double>& scene, double factor, double lo, double hi) {
  const EndValues<double> a = end_values_of<double>(scene.shear_rate(), lo, hi);
  EndValues<double> scale{scene.scale() * factor, scene.scale() * factor};
  if (scene.spec().temperature) {
    const EndValues<double> T = end_values_of<double>(*scene.spec().temperature, lo, hi);
    scale = {scale.low * std::sqrt(T.low), scale.high * std::sqrt(T.high)};
  }
  if (scene.spec().solid_fraction) {
    const EndValues<double> c = end_values_of<double>(*scene.spec().solid_fraction, lo, hi);
    scale = {scale.low * c.low, scale.high * c.high};
  }
  return {scale.low * a.low, scale.high * a.high};
}

/// The rate between two heights of a smooth bed over y, by what it is there: linear or exponential, whichever is nearer in its middle;
/// `error`: what it leaves at three places between, as a part. Towards a place where it is 0 such a curve would take for ever: there
/// the mean.
struct FittedCurve {
  RateCurve curve;
  double low, high, error;
};
FittedCurve fitted_curve(const Scene<double>& scene, double factor, double lo, double hi) {
  const EndValues<double> rates = rates_of(scene, factor, lo, hi);
  if (!(rates.low > 0 && rates.high > 0)) {
    const double mean = scene.scale() * factor * scene.mean_rate(lo, hi) * scene.mean_solid_fraction(lo, hi);
    return {RateCurve::constant, mean, mean, 1};
  }
  const auto rate_at = [&](double part) {
    const double z =
        has_smooth_solid_fraction(scene) ? height_holding(scene, lo, hi, part) : lo + part * (hi - lo);
    return rates_of(scene, factor, lo, z).high;
  };
  const auto linear = [&](double part) { return rates.low + part * (rates.high - rates.low); };
  const auto exponential = [&](double part) { return rates.low * std::pow(rates.high / rates.low, part); };
  const double middle = rate_at(0.5);
  const bool is_linear = std::abs(linear(0.5) - middle) <= std::abs(exponential(0.5) - middle);
  double error = 0;
  for (const double part : {0.25, 0.5, 0.75})
    error = std::max(error, std::abs((is_linear ? linear(part) : exponential(part)) / rate_at(part) - 1));
  return {is_linear ? RateCurve::linear : RateCurve::exponential, rates.low, rates.high, error};
}

/// Layers between the knots, halved until curves through the rates at their ends are off by less than what the levels cost, R^2 / 2 of
/// it; next to a place where the rate is 0 until they are R^2 of the bed high.
LayerStack<double> fitted_layers(const Scene<double>& scene, double resolution) {
  constexpr double kShare = 0.5, kThinnest = 1e-12;
  const double square = resolution * resolution, height = scene.top() - scene.bottom();
  const std::vector<double> knots = scene.knots();
  std::vector<double> boundaries{scene.bottom()}, ends{scene.top()}, rates;
  ends.insert(ends.end(), knots.rbegin(), knots.rend());
  while (!ends.empty()) {
    const double lo = boundaries.back(), hi = ends.back(), middle = lo + (hi - lo) / 2;
    const FittedCurve fit = fitted_curve(scene, 1, lo, hi);
    const bool is_fine =
        fit.curve == RateCurve::constant ? hi - lo <= square * height : fit.error <= kShare * square;
    if (!is_fine && hi - lo > kThinnest * height && middle > lo && middle < hi) {
      ends.push_back(middle);
      continue;
    }
    boundaries.push_back(hi);
    ends.pop_back();
  }
  std::vector<bool> is_break;
  for (std::size_t k = 0; k + 1 < boundaries.size(); ++k) {
    rates.push_back(scene.mean_rate(boundaries[k], boundaries[k + 1]));
    if (k > 0) is_break.push_back(scene.jumps_at(boundaries[k]));
  }
  LayerMaterial<double> material = material_of(scene, boundaries);
  return {std::move(boundaries), std::move(rates), scene.scale(), std::move(is_break), std::move(material)};
}

/// 4 |f| of the extremum for a width of the flux of 1, in units of the lowest flux's: what makes r of s a sqrt(T) c.
double rate_factor(const Scene<double>& scene, const Flux<double>& flux) {
  const StateRange<double> first = scene.fluxes().front().range();
  return 4 * std::abs(flux.value(flux.extrema().front())) / (first.highest - first.lowest);
}

std::vector<RatePiece> pieces_of(const Scene<double>& scene, const LayerStack<double>& layers,
                                 const FlowCoordinate& heights, std::optional<RateCurve> curve,
                                 const std::vector<std::shared_ptr<const FluxBranches>>& fluxes) {
  std::vector<RatePiece> pieces;
  for (std::size_t k = 0; k < layers.n_layers(); ++k) {
    const double lo = layers.boundary(k), hi = layers.boundary(k + 1),
                 factor = rate_factor(scene, layers.flux(k));
    const std::shared_ptr<const FluxBranches>& flux = fluxes[layers.flux_index(k)];
    if (curve) {
      const EndValues<double> rates = rates_of(scene, factor, lo, hi);
      pieces.emplace_back(heights.y_of(lo), heights.y_of(hi), rates.low, rates.high, *curve, flux);
    } else {
      const FittedCurve fit = fitted_curve(scene, factor, lo, hi);
      pieces.emplace_back(heights.y_of(lo), heights.y_of(hi), fit.low, fit.high, fit.curve, flux);
    }
  }
  return pieces;
}

/// u of a share of piece p; that of the largest flux to the bit.
double state_of(const Scene<double>& scene, const CurvedScene& curved, std::size_t p, double share) {
  const RatePiece& piece = curved.problem.pieces[p];
  const Flux<double>& flux = scene.fluxes()[curved.flux_index[p]];
  if (piece.flux && share == flux.extrema().front()) return piece.top();
  return std::clamp(curved.heights.u_of(p, share), 0.0, 1.0);
}

std::vector<StartSegment> start_of(const Scene<double>& scene, const CurvedScene& curved) {
  const std::vector<RatePiece>& pieces = curved.problem.pieces;
  std::vector<double> breaks;
  for (const double z : scene.initial_breaks()) breaks.push_back(curved.heights.y_of(z));
  const std::vector<double>& values = scene.initial_values();
  std::vector<StartSegment> start;
  std::size_t jump = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    double from = pieces[p].z_low;
    for (; jump < breaks.size() && breaks[jump] < pieces[p].z_high; ++jump) {
      if (!(breaks[jump] > from)) continue;
      start.push_back({p, from, breaks[jump], state_of(scene, curved, p, values[jump])});
      from = breaks[jump];
    }
    start.push_back({p, from, pieces[p].z_high, state_of(scene, curved, p, values[jump])});
  }
  return start;
}

/// u of a smooth start in piece p over y.
std::shared_ptr<const StartShape> shape_of(const Scene<double>& scene, const FlowCoordinate& heights,
                                           std::size_t p) {
  StartShape shape;
  shape.u = [scene, heights, p](double y) {
    return std::clamp(heights.u_of(p, scene.initial_share(heights.z_of(y))), 0.0, 1.0);
  };
  shape.amount = [scene, heights](double lo, double hi) {
    return heights.image_of(lo, hi, scene.initial_amount(heights.z_of(lo), heights.z_of(hi)));
  };
  return std::make_shared<const StartShape>(std::move(shape));
}

std::vector<StartSegment> smooth_start_of(const Scene<double>& scene, const CurvedScene& curved) {
  std::vector<double> knots;
  for (const double z : scene.initial_knots()) knots.push_back(curved.heights.y_of(z));
  std::vector<StartSegment> start;
  std::shared_ptr<const StartShape> shape;
  auto knot = knots.begin();
  for (std::size_t p = 0; p < curved.problem.pieces.size(); ++p) {
    const RatePiece& piece = curved.problem.pieces[p];
    if (p == 0 || curved.flux_index[p] != curved.flux_index[p - 1])
      shape = shape_of(scene, curved.heights, p);
    double from = piece.z_low;
    for (; knot != knots.end() && *knot < piece.z_high; ++knot) {
      if (!(*knot > from)) continue;
      add_smooth_segments(start, piece, p, from, *knot, shape);
      from = *knot;
    }
    add_smooth_segments(start, piece, p, from, piece.z_high, shape);
  }
  return start;
}

CurvedScene scene_with(const Scene<double>& scene, double resolution,
                       const std::vector<std::shared_ptr<const FluxBranches>>& fluxes) {
  const std::optional<RateCurve> curve = curve_of(scene);
  const LayerStack<double> layers = curve ? pieces_between_knots(scene) : fitted_layers(scene, resolution);
  CurvedScene curved{{}, FlowCoordinate(scene, layers), {}};
  CurvedProblem& problem = curved.problem;
  problem.pieces = pieces_of(scene, layers, curved.heights, curve, fluxes);
  double fastest = 0;
  for (const RatePiece& piece : problem.pieces) fastest = std::max({fastest, piece.low, piece.high});
  const int exponent = std::ilogb(fastest);
  curved.time_unit = std::ldexp(1.0, -exponent);
  for (RatePiece& piece : problem.pieces)
    piece = {piece.z_low, piece.z_high, std::ldexp(piece.low, -exponent), std::ldexp(piece.high, -exponent),
             piece.curve, piece.flux};
  const std::vector<double> knots = scene.knots();
  for (std::size_t k = 0; !curve && k < layers.n_layers(); ++k)
    problem.is_part.push_back(!std::binary_search(knots.begin(), knots.end(), layers.boundary(k)));
  for (std::size_t k = 0; k < layers.n_layers(); ++k) curved.flux_index.push_back(layers.flux_index(k));
  problem.start = scene.has_smooth_start() ? smooth_start_of(scene, curved) : start_of(scene, curved);
  problem.ends.is_periodic = scene.spec().is_periodic;
  const std::array outside{&scene.spec().outside_bottom, &scene.spec().outside_top};
  for (std::size_t end = 0; end < 2; ++end) {
    if (!*outside[end]) continue;
    const std::size_t p = end == 0 ? 0 : layers.n_layers() - 1;
    for (const double t : (*outside[end])->breaks) problem.ends.changes[end].push_back(t / curved.time_unit);
    for (const double share : (*outside[end])->values)
      problem.ends.states[end].push_back(state_of(scene, curved, p, share));
  }
  return curved;
}

bool has_maximum(const Flux<double>& flux) { return flux.value(flux.extrema().front()) > 0; }

}  // namespace

Profile<double> CurvedScene::profile_of(const Lines& lines) const {
  const std::vector<double>& y = lines.ends();
  std::vector<double> z{heights.z_of(y.front())}, below, above;
  for (std::size_t i = 0; i < lines.below().size(); ++i) {
    const std::size_t k = heights.layer_of(y[i] + (y[i + 1] - y[i]) / 2);
    const double from = z.back(), to = heights.z_of(y[i + 1]);
    z.push_back(to);
    const double low = heights.share_of(k, lines.below()[i]), high = heights.share_of(k, lines.above()[i]);
    const SolidLine c = heights.solid_line(k, from, to, y[i + 1] - y[i]);
    below.push_back(c.low * low);
    above.push_back(c.high * high);
    if (c.low == c.high || low == high) continue;
    // Two slopes make more than the line has in y; where there is room it is taken from one end or both.
    const double excess = (c.high - c.low) * (high - low) / 4;
    const auto fits = [&](double from_low, double from_high) {
      const double a = (below.back() - from_low) / c.low, b = (above.back() - from_high) / c.high;
      const double pure = heights.share_of(k, 0), other = heights.share_of(k, 1),
                   least = std::min(pure, other), most = std::max(pure, other);
      if (!(a >= least && a <= most && b >= least && b <= most)) return false;
      below.back() -= from_low;
      above.back() -= from_high;
      return true;
    };
    if (!fits(excess, excess) && !fits(2 * excess, 0)) fits(0, 2 * excess);
  }
  return {std::move(z), std::move(below), std::move(above)};
}

bool has_curved_fronts(const Scene<double>& scene) {
  if (scene.is_layered() || scene.has_diffusion() || scene.spec().is_neumann) return false;
  const std::vector<Flux<double>>& fluxes = scene.fluxes();
  return std::all_of(fluxes.begin(), fluxes.end(), [&](const Flux<double>& flux) {
    return FluxBranches::suits(flux) && has_maximum(flux) == has_maximum(fluxes.front());
  });
}

CurvedScene curved_scene(const Scene<double>& scene, double resolution) {
  std::vector<std::shared_ptr<const FluxBranches>> fluxes;
  for (const Flux<double>& flux : scene.fluxes())
    fluxes.push_back(flux.is_parabola() ? nullptr : std::make_shared<const FluxBranches>(flux));
  return scene_with(scene, resolution, fluxes);
}

double count_curved_entries(const Scene<double>& scene, double resolution) {
  const std::vector<std::shared_ptr<const FluxBranches>> none(scene.fluxes().size());
  const CurvedProblem problem = scene_with(scene, resolution, none).problem;
  return count_levels(problem, resolution) * static_cast<double>(problem.pieces.size());
}

}  // namespace shearfront
