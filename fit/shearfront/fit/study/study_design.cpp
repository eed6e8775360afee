// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/study/study_design.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <numeric>

namespace shearfront::fit {
namespace {

using Unit = std::vector<std::vector<double>>;  // points of the unit cube

/// The middle of the cells of a random generator: 0 < u < 1.
class OpenUniform {
 public:
  explicit OpenUniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return (static_cast<double>(engine_() >> 12) + 0.5) * 0x1p-52; }
  /// The numbers 0 to n - 1 in random order.
  std::vector<std::size_t> permutation(std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i)
      std::swap(order[i - 1], order[boost::random::uniform_int_distribution<std::size_t>(0, i - 1)(engine_)]);
    return order;
  }

 private:
  boost::random::mt19937_64 engine_;
};

Unit random_points(std::size_t n, std::size_t d, OpenUniform& uniform) {
  Unit points(n, std::vector<double>(d));
  for (auto& point : points)
    for (double& u : point) u = uniform();
  return points;
}

Unit latin_hypercube(std::size_t n, std::size_t d, OpenUniform& uniform) {
  Unit points(n, std::vector<double>(d));
  for (std::size_t j = 0; j < d; ++j) {
    const std::vector<std::size_t> slices = uniform.permutation(n);
    for (std::size_t i = 0; i < n; ++i)
      points[i][j] = (static_cast<double>(slices[i]) + uniform()) / static_cast<double>(n);
  }
  return points;
}

Unit sobol_sequence(std::size_t n, std::size_t d) {
  boost::random::sobol engine(d);
  Unit points(n, std::vector<double>(d));
  for (auto& point : points)
    for (double& u : point) u = (static_cast<double>(engine() >> 11) + 0.5) * 0x1p-53;
  return points;
}

/// A, B, then for each variation A with its column from B (Saltelli et al. 2010).
Unit mixtures(std::size_t n, std::size_t d, OpenUniform& uniform) {
  const Unit a = random_points(n, d, uniform), b = random_points(n, d, uniform);
  Unit points = a;
  points.insert(points.end(), b.begin(), b.end());
  for (std::size_t j = 0; j < d; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      points.push_back(a[i]);
      points.back()[j] = b[i][j];
    }
  return points;
}

std::vector<std::vector<double>> grid_points(const StudySpec& spec) {
  const std::size_t n = n_runs(spec);
  std::vector<std::vector<double>> points(n, std::vector<double>(spec.variations.size()));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = spec.variations.size(), rest = i; j-- > 0;) {
      const std::vector<double>& values = spec.variations[j].values;
      points[i][j] = values[rest % values.size()];
      rest /= values.size();
    }
  return points;
}

}  // namespace

double Variation::at(double u) const {
  switch (kind) {
    case VariationKind::list:
    case VariationKind::range:
    case VariationKind::log_range:
      return values[std::min(static_cast<std::size_t>(u * static_cast<double>(values.size())),
                             values.size() - 1)];
    case VariationKind::uniform:
      return first + u * (second - first);
    case VariationKind::log_uniform:
      return first * std::pow(second / first, u);
    case VariationKind::normal:
      return first + second * boost::math::quantile(boost::math::normal_distribution<double>(), u);
    case VariationKind::lognormal:
      return first * std::exp(second * boost::math::quantile(boost::math::normal_distribution<double>(), u));
  }
  return first;
}

std::size_t n_runs(const StudySpec& spec) {
  if (spec.design == DesignKind::indices) return spec.runs * (spec.variations.size() + 2);
  if (spec.design != DesignKind::grid) return spec.runs;
  std::size_t n = 1;
  for (const Variation& v : spec.variations) n *= v.values.size();
  return n;
}

std::vector<std::vector<double>> study_points(const StudySpec& spec) {
  const std::size_t d = spec.variations.size();
  OpenUniform uniform(spec.seed);
  Unit unit;
  switch (spec.design) {
    case DesignKind::grid:
      return grid_points(spec);
    case DesignKind::latin_hypercube:
      unit = latin_hypercube(spec.runs, d, uniform);
      break;
    case DesignKind::sobol:
      unit = sobol_sequence(spec.runs, d);
      break;
    case DesignKind::random:
      unit = random_points(spec.runs, d, uniform);
      break;
    case DesignKind::indices:
      unit = mixtures(spec.runs, d, uniform);
      break;
    case DesignKind::fit:
    case DesignKind::replicates:
      break;
  }
  for (auto& point : unit)
    for (std::size_t j = 0; j < d; ++j) point[j] = spec.variations[j].at(point[j]);
  return unit;
}

}  // namespace shearfront::fit
