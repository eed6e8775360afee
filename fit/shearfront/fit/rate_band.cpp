// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/rate_band.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace shearfront::fit {
namespace {

constexpr std::size_t kRateHeights = 201;
/// Relative step of central differences: error of order step^2 and rounding / step, both below 1e-9.
constexpr double kDifference = 1e-5;
/// A part of log(s a) smaller than this per unit of log p is rounding, not dependence.
constexpr double kNoPart = 1e-8;

double rate_at(const SceneSpec<double>& spec, double z) {
  return spec.scale * std::visit([&](const auto& a) { return a.value(z); }, spec.shear_rate);
}

/// The number of standard errors behind the confidence intervals; that of a normal distribution if none has
/// one.
double quantile_of(const Estimate& estimate, const Parameters& parameters) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ParameterEstimate& p = estimate.parameters[i];
    if (!p.ci95 || !p.std_error || !(*p.std_error > 0)) continue;
    const double q = parameters[i].entry.range == Range::positive
                         ? std::log(p.ci95->high / p.estimate) * p.estimate / *p.std_error
                         : (p.ci95->high - p.estimate) / *p.std_error;
    if (std::isfinite(q) && q > 0) return q;
  }
  return 1.96;
}

/// Where a row stands and where its s a is taken: for layers their ends and their middle.
struct RatePlace {
  double z = 0, inside = 0;
};
std::vector<RatePlace> places_of(const Scene<double>& scene) {
  std::vector<double> knots = scene.knots();
  std::vector<RatePlace> places;
  if (scene.is_layered()) {
    knots.push_back(scene.top());
    double below = scene.bottom();
    for (const double z : knots) {
      places.push_back({below, (below + z) / 2});
      places.push_back({z, (below + z) / 2});
      below = z;
    }
    return places;
  }
  for (std::size_t i = 0; i < kRateHeights; ++i)
    knots.push_back(std::lerp(scene.bottom(), scene.top(), static_cast<double>(i) / (kRateHeights - 1)));
  std::sort(knots.begin(), knots.end());
  for (const double z : knots) places.push_back({z, z});
  return places;
}

/// One unknown, a step up and down.
struct RateDirection {
  std::size_t index = 0;
  double size = 0, step = 0;  ///< size: of its value or, if it may be of any sign, its unit
  SceneSpec<double> above, below;
  /// d log(s a) / d p; 0 where it is rounding.
  [[nodiscard]] double slope(double z) const {
    const double slope = std::log(rate_at(above, z) / rate_at(below, z)) / (2 * step);
    return std::abs(slope * size) > kNoPart ? slope : 0;
  }
};

std::vector<RateDirection> directions_of(const Parameters& parameters, const Estimate& estimate) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = estimate.parameters[i].estimate;
  std::vector<RateDirection> directions;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (estimate.scene->is_layered() && parameters[i].entry.field == "shear_rate.breaks") continue;
    const auto k = static_cast<Eigen::Index>(i);
    const bool is_positive = parameters[i].entry.range == Range::positive;
    const double size = is_positive ? values[k] : parameters[i].unit, step = kDifference * size;
    Eigen::VectorXd above = values, below = values;
    above[k] += step;
    below[k] -= step;
    directions.push_back({i, size, step, parameters.scene_with(above), parameters.scene_with(below)});
  }
  return directions;
}

std::optional<Interval> band_at(double z, double rate, const std::vector<RateDirection>& directions,
                                const Estimate& estimate, double quantile) {
  std::vector<std::pair<Eigen::Index, double>> parts;  // slopes times standard errors
  for (const RateDirection& d : directions) {
    const double slope = d.slope(z);
    if (slope == 0) continue;
    const auto& error = estimate.parameters[d.index].std_error;
    if (!error) return std::nullopt;
    parts.emplace_back(static_cast<Eigen::Index>(d.index), slope * *error);
  }
  double variance = 0;
  for (const auto& [i, a] : parts)
    for (const auto& [j, b] : parts)
      if (a != 0 && b != 0) variance += a * estimate.correlation(i, j) * b;
  const double factor = std::exp(quantile * std::sqrt(std::max(variance, 0.0)));
  return Interval{rate / factor, std::min(rate * factor, std::numeric_limits<double>::max())};
}

}  // namespace

std::vector<RateRow> rate_rows(const Scene<double>& scene) {
  std::vector<RateRow> rows;
  for (const RatePlace& p : places_of(scene))
    rows.push_back({p.z, rate_at(scene.spec(), p.inside), std::nullopt});
  return rows;
}

RateBand rate_band(const Parameters& parameters, const Estimate& estimate) {
  RateBand result;
  const Scene<double>& scene = *estimate.scene;
  const std::vector<RateDirection> directions = directions_of(parameters, estimate);
  const double quantile = quantile_of(estimate, parameters);
  for (const RatePlace& p : places_of(scene)) {
    const double a = rate_at(scene.spec(), p.inside);
    result.rows.push_back({p.z, a, band_at(p.inside, a, directions, estimate, quantile)});
  }
  result.start = rate_rows(parameters.start_scene());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Entry& entry = parameters[i].entry;
    result.is_unknown = result.is_unknown || entry.field.starts_with("shear_rate.");
    if (!scene.is_layered() || entry.field != "shear_rate.breaks" || !estimate.parameters[i].ci95) continue;
    const RateRow &below = result.rows[2 * entry.index + 1], &above = result.rows[2 * entry.index + 2];
    const auto span = [](const RateRow& row) { return row.band.value_or(Interval{row.a, row.a}); };
    result.interfaces.push_back(
        {*estimate.parameters[i].ci95,
         {std::min(span(below).low, span(above).low), std::max(span(below).high, span(above).high)}});
  }
  return result;
}

}  // namespace shearfront::fit
