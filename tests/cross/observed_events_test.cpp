// SPDX-License-Identifier: BSD-3-Clause
// Event times seen in profiles converge to the exact ones.
#include "support/observed_events.hpp"
#include "support/source_examples.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

using support::example_1;
using support::observed_events;
using support::ProfileSeries;

std::vector<double> spaced(double end, int n) {
  std::vector<double> times;
  for (int i = 0; i <= n; ++i) times.push_back(end * i / n);
  return times;
}

Timeline<double> seen_on_a_grid(const Scene<double>& scene, std::size_t n_cells, double end, int n_times) {
  SolverRequest request;
  request.times = spaced(end, n_times);
  request.profiles = true;
  auto result = solve<GodunovSolver>(scene, request, {{.cells = n_cells}});
  return observed_events(scene, {request.times, std::move(result.profiles)});
}

/// The exact solution as cell averages.
Timeline<double> seen_in_the_truth(const Scene<double>& scene, int n_cells, double end, int n_times) {
  const ExactSolution<double> exact(scene);
  ProfileSeries series;
  series.times = spaced(end, n_times);
  for (const double t : series.times) {
    std::vector<double> z, phi;
    for (int j = 0; j <= n_cells; ++j) z.push_back(static_cast<double>(j) / n_cells);
    for (std::size_t j = 0; j + 1 < z.size(); ++j)
      phi.push_back((exact.M(z[j + 1], t) - exact.M(z[j], t)) / (z[j + 1] - z[j]));
    series.profiles.emplace_back(z, phi, phi);
  }
  return observed_events(scene, series);
}

// phi next to a wall grows like (t - t0) / (2 t) behind the edge of a fan: theta costs a delay of 2 theta t.
TEST(ObservedEvents, OfTheExactSolutionAreLateByTheThreshold) {
  const auto exact = exact_timeline(example_1());
  for (const int n : {100, 400}) {
    const auto seen = seen_in_the_truth(example_1(), n, 8, 800);
    const double theta = 1 / std::sqrt(n), h = 1.0 / n;
    for (const auto& [a, b] : {std::pair(seen.t1, exact.t1),
                               std::pair(seen.interfaces.at(0).first, exact.interfaces.at(0).first)}) {
      ASSERT_TRUE(a.has_value());
      EXPECT_GT(*a, *b);
      EXPECT_LT(*a, *b * (1 + 3 * theta));
    }
    EXPECT_LT(*seen.t0, *exact.t0 * (1 + 3 * theta));
    EXPECT_NEAR(*seen.interfaces.at(0).last, *exact.interfaces.at(0).last, 40 * h + 0.01);
    EXPECT_NEAR(*seen.t_star, *exact.t_star, 20 * h + 0.01);
    EXPECT_DOUBLE_EQ(seen.mass, 0.5);
    EXPECT_DOUBLE_EQ(seen.steady_height, 0.5);
  }
}

TEST(ObservedEvents, OfAGridConverge) {
  const auto exact = exact_timeline(example_1());
  const auto coarse = seen_on_a_grid(example_1(), 100, 8, 800),
             fine = seen_on_a_grid(example_1(), 1600, 8, 800);
  const auto order = [](const std::optional<double>& a, const std::optional<double>& b,
                        const std::optional<double>& truth) {
    return std::log2(std::abs(*a - *truth) / std::abs(*b - *truth)) / 4;
  };
  EXPECT_GT(order(coarse.interfaces[0].first, fine.interfaces[0].first, exact.interfaces[0].first), 0.4);
  EXPECT_GT(order(coarse.interfaces[0].last, fine.interfaces[0].last, exact.interfaces[0].last), 0.7);
  EXPECT_GT(order(coarse.t_star, fine.t_star, exact.t_star), 0.7);
  // The feet ahead of fans shrink more slowly: order 1/2 is reached on fine grids only.
  EXPECT_GT(order(coarse.t0, fine.t0, exact.t0), 0.1);
  EXPECT_GT(order(coarse.t1, fine.t1, exact.t1), 0.15);
  for (const auto& [a, b] : {std::pair(fine.t0, exact.t0), std::pair(fine.t1, exact.t1)})
    EXPECT_NEAR(*a, *b, 0.08 * *b);
}

TEST(ObservedEvents, NothingHappensInASteadyBed) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.3}, {1, 2}};
  spec.initial_breaks = {0.6};
  spec.initial_values = {1, 0};
  const auto seen = seen_on_a_grid(Scene<double>(spec), 50, 1, 10);
  EXPECT_FALSE(seen.t0 || seen.t1 || seen.interfaces.at(0).first || seen.interfaces.at(0).last);
  EXPECT_EQ(seen.t_star, 0.0);
}

TEST(ObservedEvents, WhatLiesBehindTheEndIsEmpty) {
  const auto seen = seen_on_a_grid(example_1(), 100, 1, 100);
  EXPECT_TRUE(seen.t0.has_value());
  EXPECT_FALSE(seen.t1 || seen.t_star || seen.interfaces.at(0).last);
}

}  // namespace
}  // namespace shearfront
