// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/exact_side_by_side.hpp"
#include "support/hard_scenes.hpp"

/// Scenes and points that are hard for the exact engine: what the stability table and the tests of hard cases
/// evaluate.
namespace shearfront::support {

struct HardPoints {
  std::string name;
  Scene<double> scene;
  std::vector<Point> points;
  int n_moves = 4;            ///< how often the scene's numbers are moved, to see what that changes
  bool with_timeline = true;  ///< off where the event times of all interfaces would take minutes
};

/// A time for looking at random scene number `number`.
[[nodiscard]] inline double random_time(std::uint64_t number) {
  SceneMaker maker(seed_of(number) + 1000000);
  return std::exp(maker.uniform(-3, 3));
}

/// `n` points of a scene, times from 1e-3 t* to 1.1 t*, closer together towards 0.
[[nodiscard]] inline std::vector<Point> random_points(const Scene<double>& scene, int n, std::uint64_t seed) {
  SceneMaker maker(seed_of(seed) + 2000000);
  const double t_star = *exact_timeline(scene).t_star;
  std::vector<Point> points;
  if (!(t_star > 0)) return points;
  for (int i = 0; i < n; ++i) {
    const double z = maker.uniform(scene.bottom(), scene.top());
    points.push_back({z, t_star * std::exp(maker.uniform(-7, 0.1))});
  }
  return points;
}

/// Points at all heights i / 16 and the given times.
[[nodiscard]] inline std::vector<Point> points_at(const std::vector<double>& times) {
  std::vector<Point> points;
  for (const double t : times)
    for (int i = 1; i < 16; ++i) points.push_back({i / 16.0, t});
  return points;
}

/// The 17 numbers around the lower shock of a solution that is pure below it, at time t.
[[nodiscard]] inline std::vector<Point> points_around_lower_shock(const Scene<double>& scene, double t) {
  const ExactSolution<double> solution(scene);
  double lo = scene.bottom(), hi = solution.steady_height();
  while (std::nextafter(lo, hi) < hi) {
    const double z = lo + (hi - lo) / 2;
    (solution.at(z, t).H > 0 ? hi : lo) = z;
  }
  for (int i = 0; i < 8; ++i) lo = std::nextafter(lo, 0.0);
  std::vector<Point> points;
  for (int i = 0; i < 17; ++i) {
    points.push_back({lo, t});
    lo = std::nextafter(lo, 1.0);
  }
  return points;
}

[[nodiscard]] inline std::vector<HardPoints> hard_points() {
  std::vector<Point> at_the_edge, at_zero;
  for (const auto& [z, arrival] : {std::pair(0.8, 0.3 / 0.31), std::pair(0.1, 0.21 / 0.31 + 0.19 / 2.4)})
    for (int k = 4; k <= 50; k += 2) at_the_edge.push_back({z, arrival * (1 + std::ldexp(1.0, -k))});
  for (const double t : {1e-300, 1e-100, 1e-20, 1e-9})
    for (const double z : {0.29, std::nextafter(0.5, 0.0), 0.5, std::nextafter(0.5, 1.0)})
      at_zero.push_back({z, t});
  SceneSpec<double> smooth;
  smooth.initial_breaks = {0.5};
  smooth.initial_values = {0, 1};
  const auto exponential = [&](double amplitude, double decay, double scale) {
    SceneSpec<double> spec = smooth;
    spec.shear_rate = Exponential<double>{amplitude, decay};
    spec.scale = scale;
    return Scene<double>(spec);
  };
  const std::vector<double> one{0.5};
  std::vector<HardPoints> cases{
      {"shear cell of May et al. (2010)", shear_cell(), points_at({0.1, 0.5, 1, 2, 3, 4, 5, 6})},
      {"t = travel time (1 + 2^-4 ... 2^-50): H near 0", shear_cell(), at_the_edge},
      {"t = 1e-300 ... 1e-9 next to the jump", shear_cell(), at_zero},
      {"t = 1e10 ... 1e300", shear_cell(), points_at({1e10, 1e100, 1e300})},
      {"bottleneck 1e-6 high: H within 1e-12 of its capacity",
       layered_scene({0.6, 0.6 + 1e-6}, {1, 0.2, 1}, {0.3}, {0, 1}), points_at({0.5, 1, 2, 3, 4, 5})},
      {"bottleneck 1e-12 high", layered_scene({0.6, 0.6 + 1e-12}, {1, 0.2, 1}, {0.3}, {0, 1}),
       points_at({0.5, 1, 2, 3, 4, 5})},
      {"17 numbers around a shock", shear_cell(), points_around_lower_shock(shear_cell(), 3)},
      {"rates one ulp apart", layered_scene({0.3, 0.7}, {0.8, std::nextafter(0.8, 1.0), 0.8}, {0.4}, {0, 1}),
       points_at({0.1, 0.5, 1, 2})},
      {"rates 1e-9 apart", layered_scene({0.3, 0.7}, {0.8, 0.8 + 1e-9, 0.8}, {0.4}, {0, 1}),
       points_at({0.1, 0.5, 1, 2})},
      {"contrast 1e12, fast layer below", layered_scene({0.29}, {1e12, 1}, one, {0, 1}),
       points_at({1e-3, 0.4, 1})},
      {"contrast 1e12, slow layer between", layered_scene({0.29, 0.6}, {1e6, 1e-6, 1e6}, one, {0, 1}),
       points_at({1e-3, 1e3, 1e5, 1e6})},
      {"jump one ulp above an interface",
       layered_scene({0.29}, {2.4, 0.31}, {std::nextafter(0.29, 1.0)}, {0, 1}), points_at({0.1, 0.3, 2})},
      {"s = 1e-300", shear_cell(1e-300), points_at({0.5e300, 3e300, 6e300})},
      {"s = 1e300", shear_cell(1e300), points_at({0.5e-300, 3e-300, 6e-300})},
      {"t* = 2e15", layered_scene({}, {1e-15}, one, {0, 1}), points_at({1e14, 1e15})},
      {"traces, phi = 1e-15", layered_scene({0.29}, {2.4, 0.31}, {}, {1e-15}), points_at({0.1, 0.5})},
      {"exponential a of May et al. (2010)", exponential(0.87 / 0.205, 0.205, 13.60),
       points_at({0.01, 0.1, 0.6, 1})},
      {"exponential a, contrast e^100", exponential(1, 0.01, 1), points_at({1e-3, 1e10, 1e20, 1e30})},
      {"exponential a, nearly constant", exponential(1, 1e9, 1), points_at({0.1, 0.5, 1, 1.5})},
      {"1000 random layers", many_layers(1000, 11), points_at({0.03, 1}), 1, false},
  };
  return cases;
}

/// Those that take seconds to minutes in 50 digits; those of 1e6 jumps without event times, which take
/// more than ten minutes.
[[nodiscard]] inline std::vector<HardPoints> slow_hard_points() {
  const std::vector<Point> points{{0.1, 0.3}, {0.4, 0.03}, {0.6, 1}};
  return {{"10000 random layers", many_layers(10000, 12), points, 1, false},
          {"1e6 jumps", many_jumps(1000000, 13), points, 1, false}};
}

}  // namespace shearfront::support
