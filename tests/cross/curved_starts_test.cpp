// SPDX-License-Identifier: BSD-3-Clause
// Curved fronts from smooth and tabulated starts: laws, and the exact solution, which states an error of 1e-6 there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/track/track.hpp"
#include "support/curved_scenes.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

SceneSpec<double> random_smooth_spec(std::uint64_t seed) {
  support::SceneMaker maker(seed);
  SceneSpec<double> spec;
  spec.shear_rate = support::random_curved_rate(maker);
  spec.initial_state = support::random_start(maker);
  return spec;
}

void keep_mass_and_come_to_rest(std::uint64_t first, std::uint64_t n) {
  for (std::uint64_t seed = first; seed < first + n; ++seed) {
    const Scene<double> scene(random_smooth_spec(support::seed_of(seed)));
    Tracking tracking(scene, {.resolution = 0.05});
    EXPECT_LE(tracking.summary().layers, 20u) << seed;  // no staircase
    for (const double t : {0.0, 0.1, 0.5}) {
      tracking.advance(t);
      const Profile<double> profile = tracking.profile();
      EXPECT_NEAR(profile.mass(), scene.mass(), 1e-12) << "seed " << seed << ", t = " << t;
      for (const auto* side : {&profile.below(), &profile.above()}) {
        EXPECT_GE(*std::min_element(side->begin(), side->end()), 0) << seed;
        EXPECT_LE(*std::max_element(side->begin(), side->end()), 1) << seed;
      }
    }
    EXPECT_EQ(tracking.advance(infinity<double>()), Status::steady) << seed;
    EXPECT_NEAR(tracking.field(scene)->at(scene.mass()).M, scene.mass(), 1e-12) << seed;
  }
}

TEST(CurvedStarts, KeepMassAndComeToRest) { keep_mass_and_come_to_rest(40, 60); }
TEST(SlowCurvedStarts, KeepMassAndComeToRest) { keep_mass_and_come_to_rest(1000, 3000); }

// At t = 0 between the heights where H is a level M is off by what a step of u there is times its width.
TEST(CurvedStarts, BeginAsTheStart) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Scene<double> scene(random_smooth_spec(support::seed_of(seed)));
    for (const double resolution : {0.04, 0.005}) {
      Tracking tracking(scene, {.resolution = resolution});
      tracking.advance(0);
      const auto field = tracking.field(scene);
      double largest = 0;
      for (int i = 1; i < 200; ++i)
        largest = std::max(largest, std::abs(field->at(i / 200.0).M - scene.initial_amount(0, i / 200.0)));
      EXPECT_LE(largest, resolution) << "seed " << seed << ", R = " << resolution;
      sum += (resolution > 0.01 ? 1 : -1) * std::log2(std::max(largest, 1e-16));
    }
  }
  EXPECT_GE(sum / 12 / 3, 1.3);
}

void approach_the_exact_solution(std::uint64_t first, int n, double least_order) {
  double coarse = 0, fine = 0;
  int counted = 0;
  for (int i = 0; i < n; ++i) {
    const Scene<double> scene(random_smooth_spec(support::seed_of(first + static_cast<std::uint64_t>(i))));
    const ExactSolution<double> exact(scene);
    constexpr double kTime = 0.3;
    double largest[2]{};
    for (const int is_fine : {0, 1}) {
      Tracking tracking(scene, {.resolution = is_fine ? 0.005 : 0.04});
      tracking.advance(kTime);
      const auto field = tracking.field(scene);
      for (int k = 1; k < 10; ++k)
        largest[is_fine] =
            std::max(largest[is_fine], std::abs(field->at(k / 10.0).M - exact.M(k / 10.0, kTime)));
    }
    EXPECT_LE(largest[1], 1e-4) << "seed " << first + static_cast<std::uint64_t>(i);
    constexpr double kStatedError = 1e-6;
    if (largest[1] < 3 * kStatedError) continue;
    coarse += std::log2(largest[0]);
    fine += std::log2(largest[1]);
    ++counted;
  }
  ASSERT_GE(counted, n / 4);
  std::printf("%d scenes: mean order of M %.2f\n", counted, (coarse - fine) / counted / 3);
  EXPECT_GE((coarse - fine) / counted / 3, least_order);
}
TEST(CurvedStarts, ApproachTheExactSolution) { approach_the_exact_solution(1, 6, 1.4); }
TEST(SlowCurvedStarts, ApproachTheExactSolution) { approach_the_exact_solution(1000, 60, 1.5); }

// A table through constant states with a part of nearly none between is the scene that is constant in pieces.
TEST(CurvedStarts, SteepTablesAreJumps) {
  SceneSpec<double> jumps;
  jumps.shear_rate = Table<double>{{0, 0.4, 0.7, 1}, {1, 2, 0.6, 1.4}};
  jumps.initial_breaks = {0.3, 0.6};
  jumps.initial_values = {0.2, 0.9, 0.5};
  SceneSpec<double> table = jumps;
  table.initial_breaks.clear();
  table.initial_values.clear();
  constexpr double kWidth = 1e-9;
  table.initial_state =
      TableInitial<double>{{0, 0.3, 0.3 + kWidth, 0.6, 0.6 + kWidth, 1}, {0.2, 0.2, 0.9, 0.9, 0.5, 0.5}};
  const Scene<double> a(jumps), b(table);
  Tracking one(a, {.resolution = 0.01}), other(b, {.resolution = 0.01});
  for (const double t : {0.1, 0.4}) {
    one.advance(t);
    other.advance(t);
    const auto of_one = one.field(a), of_other = other.field(b);
    for (int i = 0; i <= 20; ++i)
      EXPECT_NEAR(of_one->at(i / 20.0).M, of_other->at(i / 20.0).M, 2e-4) << t << ' ' << i;
  }
}

}  // namespace
}  // namespace shearfront
