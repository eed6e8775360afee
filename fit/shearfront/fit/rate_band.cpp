// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/rate_band.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/random/chi_squared_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "shearfront/fit/quantile.hpp"

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

/// d log(s a) / d xi of the unknowns in units of their standard errors; empty if one that has a part has none.
std::optional<Eigen::VectorXd> scaled_slopes(double z, const std::vector<RateDirection>& directions,
                                             const Estimate& estimate) {
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(estimate.parameters.size()));
  for (const RateDirection& d : directions) {
    const double slope = d.slope(z);
    if (slope == 0) continue;
    const auto& error = estimate.parameters[d.index].std_error;
    if (!error) return std::nullopt;
    slopes[static_cast<Eigen::Index>(d.index)] = slope * *error;
  }
  return slopes;
}

/// The deviation of a number with these slopes.
double band_deviation(const Eigen::VectorXd& slopes, const Estimate& estimate) {
  double variance = 0;
  for (Eigen::Index i = 0; i < slopes.size(); ++i)
    for (Eigen::Index j = 0; j < slopes.size(); ++j)
      if (slopes[i] != 0 && slopes[j] != 0) variance += slopes[i] * estimate.correlation(i, j) * slopes[j];
  return std::sqrt(std::max(variance, 0.0));
}

double not_infinite(double x) { return std::min(x, std::numeric_limits<double>::max()); }

/// A sample of the largest deviation over the rows, in their own deviations; empty without unknowns that vary.
std::vector<double> largest_deviations(const std::vector<Eigen::VectorXd>& slopes, const Estimate& estimate) {
  std::vector<Eigen::Index> unknowns;
  for (Eigen::Index i = 0; i < estimate.correlation.rows(); ++i)
    if (std::any_of(slopes.begin(), slopes.end(), [&](const Eigen::VectorXd& s) { return s[i] != 0; }))
      unknowns.push_back(i);
  if (unknowns.empty()) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      estimate.correlation(unknowns, unknowns).eval());
  const Eigen::MatrixXd root =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  std::vector<Eigen::VectorXd> units;  // of rows that differ
  for (const Eigen::VectorXd& s : slopes) {
    Eigen::VectorXd unit = root.transpose() * s(unknowns);
    if (!(unit.norm() > 0)) continue;
    unit.normalize();
    if (units.empty() || units.back() != unit) units.push_back(std::move(unit));
  }
  const bool has_estimated_noise = !estimate.sigma_is_given && estimate.freedom > 0;
  boost::random::mt19937_64 generator(1);
  boost::random::normal_distribution<double> normal;
  boost::random::chi_squared_distribution<double> chi_squared(has_estimated_noise ? estimate.freedom : 1);
  std::vector<double> largest(RateBand::kBandDraws, 0);
  Eigen::VectorXd xi(static_cast<Eigen::Index>(unknowns.size()));
  for (double& most : largest) {
    for (double& x : xi) x = normal(generator);
    if (has_estimated_noise) xi /= std::sqrt(chi_squared(generator) / estimate.freedom);
    for (const Eigen::VectorXd& unit : units) most = std::max(most, std::abs(unit.dot(xi)));
  }
  std::sort(largest.begin(), largest.end());
  return largest;
}

/// The band with its logarithm stretched about its middle.
Interval stretched(const Interval& band, double factor) {
  if (band.low == band.high || factor == 1) return band;
  const double middle = std::sqrt(band.low) * std::sqrt(band.high),
               reach = std::pow(std::sqrt(band.high / band.low), factor);
  return {middle / reach, not_infinite(middle * reach)};
}

/// s a of a replicate of the bootstrap, with the interfaces of the estimate.
SceneSpec<double> replicate_scene(const Parameters& parameters, const Estimate& estimate, Eigen::Index b) {
  Eigen::VectorXd values = estimate.replicates.row(b);
  for (std::size_t i = 0; estimate.scene->is_layered() && i < parameters.size(); ++i)
    if (parameters[i].entry.field == "shear_rate.breaks")
      values[static_cast<Eigen::Index>(i)] = estimate.parameters[i].estimate;
  return parameters.scene_with(values);
}

/// Puts the quantiles of the replicates in place of the bands that there are.
void set_replicated_bands(const Parameters& parameters, const Estimate& estimate,
                          const std::vector<RatePlace>& places, RateBand& result) {
  const Eigen::Index n = estimate.replicates.rows();
  result.n_replicates = static_cast<std::size_t>(n);
  std::vector<std::vector<double>> rates(result.rows.size());
  for (Eigen::Index b = 0; b < n; ++b) {
    const SceneSpec<double> spec = replicate_scene(parameters, estimate, b);
    for (std::size_t k = 0; k < places.size(); ++k) rates[k].push_back(rate_at(spec, places[k].inside));
  }
  std::vector<double> largest(static_cast<std::size_t>(n), 0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    RateRow& row = result.rows[k];
    if (!row.band || row.band->low == row.band->high) continue;
    std::vector<double> sorted = rates[k];
    std::sort(sorted.begin(), sorted.end());
    row.band = {quantile(sorted, 0.025), quantile(sorted, 0.975)};
    const double middle = std::log(row.band->low) / 2 + std::log(row.band->high) / 2,
                 half = std::log(row.band->high / row.band->low) / 2;
    for (std::size_t b = 0; half > 0 && b < largest.size(); ++b)
      largest[b] = std::max(largest[b], std::abs(std::log(rates[k][b]) - middle) / half);
  }
  std::sort(largest.begin(), largest.end());
  result.stretch = std::max(1.0, quantile(largest, 0.95));
}

}  // namespace

std::vector<RateRow> rate_rows(const Scene<double>& scene) {
  std::vector<RateRow> rows;
  for (const RatePlace& p : places_of(scene))
    rows.push_back({p.z, rate_at(scene.spec(), p.inside), std::nullopt, std::nullopt});
  return rows;
}

RateBand rate_band(const Parameters& parameters, const Estimate& estimate) {
  RateBand result;
  const Scene<double>& scene = *estimate.scene;
  const std::vector<RateDirection> directions = directions_of(parameters, estimate);
  const double quantile_of_one = quantile_of(estimate, parameters);
  const std::vector<RatePlace> places = places_of(scene);
  std::vector<Eigen::VectorXd> all_slopes;
  for (const RatePlace& p : places) {
    RateRow& row = result.rows.emplace_back(RateRow{p.z, rate_at(scene.spec(), p.inside), {}, {}});
    const auto slopes = scaled_slopes(p.inside, directions, estimate);
    if (!slopes) continue;
    const double factor = std::exp(quantile_of_one * band_deviation(*slopes, estimate));
    row.band = {row.a / factor, not_infinite(row.a * factor)};
    all_slopes.push_back(*slopes);
  }
  if (estimate.replicates.rows() > 0) {
    set_replicated_bands(parameters, estimate, places, result);
  } else if (directions.size() > 1) {
    const std::vector<double> largest = largest_deviations(all_slopes, estimate);
    if (!largest.empty()) result.stretch = std::max(1.0, quantile(largest, 0.95) / quantile_of_one);
  }
  for (RateRow& row : result.rows)
    if (row.band) row.everywhere = stretched(*row.band, result.stretch);
  result.start = rate_rows(parameters.start_scene());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Entry& entry = parameters[i].entry;
    result.is_unknown = result.is_unknown || entry.field.starts_with("shear_rate.");
    if (!scene.is_layered() || entry.field != "shear_rate.breaks") continue;
    const ParameterEstimate& p = estimate.parameters[i];
    const auto& interval = p.bootstrap95 ? p.bootstrap95 : p.ci95;
    if (!interval) continue;
    const RateRow &below = result.rows[2 * entry.index + 1], &above = result.rows[2 * entry.index + 2];
    const auto span = [](const RateRow& row) { return row.band.value_or(Interval{row.a, row.a}); };
    result.interfaces.push_back(
        {*interval,
         {std::min(span(below).low, span(above).low), std::max(span(below).high, span(above).high)}});
  }
  return result;
}

}  // namespace shearfront::fit
