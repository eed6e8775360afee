// SPDX-License-Identifier: BSD-3-Clause
// Scenes of many layers or jumps.
#include <gtest/gtest.h>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/closeness.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::relative_error;
using support::SceneMaker;

TEST(ExactLargeScenes, HundredsOfLayers) {
  for (const auto order :
       {SceneMaker::Order::falling, SceneMaker::Order::rising, SceneMaker::Order::random}) {
    SceneMaker make(support::seed_of(7));
    SceneSpec<double> spec = make.step(2, order);
    Piecewise<double> a;
    // Monotone layers take the 50-digit oracle n^2 steps to prepare.
    const int n = order == SceneMaker::Order::random ? 1000 : 250;
    for (int i = 0; i < n; ++i) {
      if (i > 0) a.breaks.push_back(double(i) / n);
      a.values.push_back(make.uniform(0.2, 4));
    }
    if (order == SceneMaker::Order::falling) std::sort(a.values.rbegin(), a.values.rend());
    if (order == SceneMaker::Order::rising) std::sort(a.values.begin(), a.values.end());
    spec.shear_rate = a;
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    const ExactSolution<Real110> oracle(scene_cast<Real110>(scene));
    for (int k = 0; k < 3; ++k) {
      const double z = make.uniform(0, 1), t = make.uniform(0.1, 2);
      EXPECT_NEAR(solution.M(z, t), to_double(oracle.M(Real110(z), Real110(t))), 1e-13);
    }
  }
}

TEST(SlowExactLargeScenes, TenThousandLayers) {
  for (const bool falling : {true, false}) {
    SceneSpec<double> spec;
    spec.initial_breaks = {0.5};
    spec.initial_values = {0, 1};
    SceneMaker make(support::seed_of(8));
    Piecewise<double> a;
    for (int i = 0; i < 10000; ++i) {
      if (i > 0) a.breaks.push_back(i / 10000.0);
      a.values.push_back(falling ? 2 * std::exp(-(i + 0.5) / 3000.0) : make.uniform(0.2, 4));
    }
    spec.shear_rate = a;
    const ExactSolution<double> solution{Scene<double>(spec)};
    SceneSpec<double> smooth = spec;
    smooth.shear_rate = Exponential<double>{2, 0.3};
    const ExactSolution<double> limit{Scene<double>(smooth)};
    double below = 0;
    for (int i = 0; i <= 20; ++i) {
      const double z = i / 20.0, M = solution.M(z, 0.8);
      EXPECT_GE(M, below);
      below = M;
      if (falling) {
        EXPECT_NEAR(M, limit.M(z, 0.8), 2e-6) << z;
      }
    }
    EXPECT_EQ(below, solution.mass());
  }
}

TEST(ExactLargeScenes, AHundredThousandJumps) {
  SceneMaker make(support::seed_of(9));
  SceneSpec<double> spec;
  const int n = 100000;
  for (int i = 1; i <= n; ++i) spec.initial_breaks.push_back(i / (n + 1.0));
  for (int i = 0; i <= n; ++i) spec.initial_values.push_back(make.uniform(0, 1));
  // The same data averaged over cells of 100 jumps: M moves by at most a quarter of their width.
  SceneSpec<double> averaged = spec;
  averaged.initial_breaks.clear();
  averaged.initial_values.clear();
  const int cells = 1000;
  for (const auto& a : {Piecewise<double>{{0.3, 0.8}, {1, 3, 0.5}}, Piecewise<double>{{}, {1}}}) {
    spec.shear_rate = averaged.shear_rate = a;
    const ExactSolution<double> solution{Scene<double>(spec)};
    averaged.initial_breaks.clear();
    averaged.initial_values.clear();
    for (int i = 0; i < cells; ++i) {
      if (i > 0) averaged.initial_breaks.push_back(double(i) / cells);
      averaged.initial_values.push_back(
          (solution.M(double(i + 1) / cells, 0.0) - solution.M(double(i) / cells, 0.0)) * cells);
    }
    const ExactSolution<double> coarse{Scene<double>(averaged)};
    for (int k = 0; k < 200; ++k) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-9.0, 1.0));
      EXPECT_NEAR(solution.M(z, t), coarse.M(z, t), 0.25 / cells) << "z " << z << " t " << t;
    }
  }
}

/// Ranges of cells are pruned by lower bounds only when there are many: here against every path on its own,
/// one layer, value = M(x) + (z - x + a t)^2 / (4 a t).
TEST(ExactLargeScenes, PruningMissesNothing) {
  SceneMaker make(support::seed_of(10));
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1.3}};
  const int n = 3000;
  for (int i = 1; i <= n; ++i) spec.initial_breaks.push_back(i / (n + 1.0));
  double phi = 0.5;
  for (int i = 0; i <= n; ++i) {
    phi = std::clamp(phi + make.uniform(-0.1, 0.1), 0.0, 1.0);
    spec.initial_values.push_back(phi);
  }
  const Scene<double> scene(spec);
  const ExactSolution<double> solution(scene);
  for (int k = 0; k < 100; ++k) {
    const double z = make.uniform(0, 1), t = std::exp(make.uniform(-6.0, 0.5)), r = 1.3;
    double best = infinity<double>();
    if (z <= r * t) best = z;
    if (1 - z <= r * t) best = std::min(best, solution.mass());
    double M = 0, lo = 0;
    for (int i = 0; i <= n; ++i) {
      const double p = spec.initial_values[std::size_t(i)],
                   hi = i == n ? 1 : spec.initial_breaks[std::size_t(i)];
      const double foot = std::clamp(z - r * (2 * p - 1) * t, lo, hi), d = z - foot;
      if (std::abs(d) <= r * t * (1 + 1e-12))
        best = std::min(best, M + p * (foot - lo) + (d + r * t) * (d + r * t) / (4 * r * t));
      M += p * (hi - lo);
      lo = hi;
    }
    EXPECT_NEAR(solution.M(z, t), best, 1e-12) << "z " << z << " t " << t;
  }
}

}  // namespace
}  // namespace shearfront
