// SPDX-License-Identifier: BSD-3-Clause
// Beds under a lid by the exact method: pieces as many as the tolerance takes, over any contrast of a(z).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"

namespace shearfront {
namespace {

SceneSpec<double> bed(double length, double load, double lid) {
  SceneSpec<double> spec;
  Kinetic<double> a;
  a.length = length;
  a.load = load;
  spec.shear_rate = a;
  spec.top = lid;
  spec.initial_breaks = {lid / 2};
  spec.initial_values = {0, 1};
  return spec;
}

/// Pure grains take int dz / a: values of an independent integration.
TEST(KineticBed, FirstWavesTakeThePureTimes) {
  const ExactSolution<double> solution(Scene<double>(bed(0.1, 1, 1)));
  const auto times = exact_timeline(solution);
  const double error = timeline_error(solution, times);
  EXPECT_NEAR(*times.t0, 44.80849763, std::max(3 * error, 1e-6));
  EXPECT_NEAR(*times.t1, 1.5653003293, std::max(3 * error, 1e-6));
  EXPECT_TRUE(solution.meets_tolerance());
}

/// a(0) / a(1) = 2e-19: times from 0.1 to 1e19.
TEST(KineticBed, KeepsTheToleranceOverAnyContrast) {
  const Scene<double> scene(bed(0.015, 1, 1));
  ExactSolution<double>::Options coarse, fine;
  coarse.tolerance = 1e-4;
  fine.layers = 1024;
  const ExactSolution<double> solution(scene, coarse), reference(scene, fine);
  EXPECT_TRUE(solution.meets_tolerance());
  EXPECT_LT(solution.n_layers(), 1024u);
  double worst = 0;
  for (int i = 1; i < 10; ++i)
    for (double log_t = -1; log_t < 20; log_t += 1.5)
      worst = std::max(worst, std::abs(solution.M(i / 10.0, std::pow(10, log_t)) -
                                       reference.M(i / 10.0, std::pow(10, log_t))));
  EXPECT_LT(worst, 1e-4);
}

}  // namespace
}  // namespace shearfront
