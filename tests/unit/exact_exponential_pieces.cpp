// SPDX-License-Identifier: BSD-3-Clause
// Beds whose rate is exponential in pieces: `chute`, and an exponential beside a solid fraction or a temperature in layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/many_digits.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

SceneSpec<double> random_bed(support::SceneMaker& make, DepthFunction<double> a) {
  SceneSpec<double> spec;
  spec.shear_rate = std::move(a);
  spec.scale = make.uniform(0.5, 2);
  spec.initial_breaks = {make.uniform(0.05, 0.5), make.uniform(0.5, 0.95)};
  for (int i = 0; i < 3; ++i) {
    const int kind = make.integer(0, 4);
    spec.initial_values.push_back(kind == 0 ? 0.0 : kind == 1 ? 1.0 : make.uniform(0, 1));
  }
  return spec;
}

Chute<double> random_chute(support::SceneMaker& make) {
  return {make.uniform(0.2, 2), make.uniform(0.1, 2), make.uniform(0.1, 0.9)};
}

/// A cut where nothing changes: the runs, turns and starts of several pieces must add up to the closed form of one. (What stood
/// for a bed by its parts was a chord of each.)
TEST(ExponentialPieces, ACutChangesNothing) {
  const std::uint64_t seed = support::seed_of(81);
  support::SceneMaker make(seed);
  int n_turned = 0, n_compared = 0;
  for (int n = 0; n < 60; ++n) {
    auto spec = random_bed(make, Exponential<double>{make.uniform(0.5, 3), make.uniform(0.15, 3)});
    const ExactSolution<double> one{Scene<double>(spec)};
    ASSERT_TRUE(one.is_exact());
    std::vector<double> cuts{make.uniform(0.02, 0.98)}, ones{1, 1};
    if (n % 3 == 1) cuts = {make.uniform(0.02, 0.5), make.uniform(0.5, 0.98)}, ones = {1, 1, 1};
    if (n % 3 == 2) {  // enough for turns and starts to be left out by bounds
      for (int i = 1; i < 60; ++i) cuts.push_back(make.uniform(0, 1));
      std::sort(cuts.begin(), cuts.end());
      ones.resize(cuts.size() + 1, 1);
    }
    spec.temperature = Piecewise<double>{cuts, ones};
    const ExactSolution<double> cut{Scene<double>(spec)};
    ASSERT_TRUE(cut.is_exact());
    ASSERT_EQ(cut.n_layers(), cuts.size() + 1);
    for (int i = 0; i < 40; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-4, 2));
      EXPECT_NEAR(cut.M(z, t), one.M(z, t), 4e-15)
          << "seed " << seed << " scene " << n << " z " << z << " t " << t;
      const double phi = one.phi(z, t), other = cut.phi(z, t);
      n_turned += one.path(z, t).turned ? 1 : 0;
      if (std::abs(phi - other) > 1e-3) continue;  // a shock within rounding
      ++n_compared;
      EXPECT_NEAR(other, phi, 1e-13) << "seed " << seed << " scene " << n << " z " << z << " t " << t;
    }
    const auto times = exact_timeline(one), same = exact_timeline(cut);
    EXPECT_NEAR(*same.t_star, *times.t_star, 1e-13 * *times.t_star) << "seed " << seed << " scene " << n;
  }
  EXPECT_GT(n_turned, 40);
  EXPECT_GT(n_compared, 2390);
}

/// By a table through it, which is solved by other closed forms: second order in its steps.
TEST(ExponentialPieces, AChuteIsTheLimitOfTables) {
  support::SceneMaker make(support::seed_of(82));
  for (int n = 0; n < 4; ++n) {
    const auto chute = random_chute(make);
    auto spec = random_bed(make, chute);
    const ExactSolution<double> exact{Scene<double>(spec)};
    EXPECT_TRUE(exact.is_exact());
    EXPECT_EQ(exact.n_layers(), 2u);
    const auto in_steps = [&](int steps) {
      Table<double> table;
      for (const double to : {chute.centre, 1.0}) {
        const double from = to == 1 ? chute.centre : 0;
        for (int i = to == 1 ? 1 : 0; i <= steps; ++i) {
          table.z.push_back(i == steps ? to : from + (to - from) * i / steps);
          table.values.push_back(chute.value(table.z.back()));
        }
      }
      auto other = spec;
      other.shear_rate = table;
      return ExactSolution<double>{Scene<double>(other)};
    };
    const auto coarse = in_steps(50), fine = in_steps(200);
    double far = 0, near = 0;
    for (int i = 0; i < 60; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 1)), M = exact.M(z, t);
      far = std::max(far, std::abs(coarse.M(z, t) - M));
      near = std::max(near, std::abs(fine.M(z, t) - M));
    }
    EXPECT_GT(far, 12 * near);
    EXPECT_LT(near, 1e-4);
  }
}

/// The centre lets s amplitude / 4 through, whatever comes.
TEST(ExponentialPieces, TheCentreOfAChuteIsAThroat) {
  SceneSpec<double> spec;
  spec.shear_rate = Chute<double>{0.2, 0.25, 0.5};
  spec.initial_breaks = {0.7};
  spec.initial_values = {0, 1};
  const ExactSolution<double> exact{Scene<double>(spec)};
  EXPECT_NEAR(exact.M(0.5, 3) - exact.M(0.5, 2), 0.05, 1e-15);
  EXPECT_NEAR(exact.phi(0.5, 3), 0.5, 1e-15);
  EXPECT_NEAR(exact.phi(0.5, 2), 0.5, 1e-15);
  // Beside it H = s a phi (1 - phi) is the same, once a path that rests has come: from 0.7 it takes sum 2 lambda q / h = 3.29.
  const double a = 0.2 * std::exp(0.1 / 0.25), phi = exact.phi(0.4, 3.5);
  EXPECT_NEAR(a * phi * (1 - phi), 0.05, 1e-15);
  // The first grains need int dz / (s a) of a pure state to come to the centre.
  const auto times = exact_timeline(exact);
  ASSERT_EQ(times.interfaces.size(), 1u);
  EXPECT_EQ(times.interfaces[0].z, 0.5);
  EXPECT_NEAR(*times.interfaces[0].first, 0.25 / 0.2 * -std::expm1(-0.2 / 0.25), 1e-15);
}

/// What rounding does: the same in 110 digits.
TEST(ExponentialPieces, AreTheSameInManyDigits) {
  const std::uint64_t seed = support::seed_of(83);
  support::SceneMaker make(seed);
  for (int n = 0; n < 12; ++n) {
    const Scene<double> scene(random_bed(make, random_chute(make)));
    support::expect_same_in_many_digits(scene, make, 8, 4e-15, 1e-12,
                                        "seed " + std::to_string(seed) + " scene " + std::to_string(n));
  }
}

/// Next to constant and next to linear: k = 1e-12 must be what k = 0 is.
TEST(ExponentialPieces, AlmostNoBendIsNone) {
  support::SceneMaker make(support::seed_of(84));
  for (const double decay : {1e6, 1e9, 1e12, 1e15}) {
    auto spec = random_bed(make, Exponential<double>{1.5, decay});
    const ExactSolution<double> exact{Scene<double>(spec)};
    spec.shear_rate = Piecewise<double>{{}, {1.5}};
    const ExactSolution<double> flat{Scene<double>(spec)};
    for (int i = 0; i < 60; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 1));
      EXPECT_NEAR(exact.M(z, t), flat.M(z, t), 2 / decay + 2e-15)
          << "decay " << decay << " z " << z << " t " << t;
    }
  }
}

}  // namespace
}  // namespace shearfront
