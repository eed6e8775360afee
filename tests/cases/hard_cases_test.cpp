// SPDX-License-Identifier: BSD-3-Clause
// Scenes named by what is hard about them. Each says what must come out and why; all of them must keep their
// mass to 1e-13, stay in [0, 1], satisfy every jump condition, agree with the Lax-Hopf formula and reach the
// steady state.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "oracles/verify.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using Tracked = Tracker<LevelGrid<double>>;

SceneSpec<double> layered(std::vector<double> breaks, std::vector<double> values,
                          std::vector<double> initial_breaks, std::vector<double> initial_values) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{std::move(breaks), std::move(values)};
  spec.initial_breaks = std::move(initial_breaks);
  spec.initial_values = std::move(initial_values);
  return spec;
}

struct Outcome {
  Timeline<double> tracked, exact;
  std::uint64_t collisions = 0;
};

struct Limits {
  double M_slack = 1;           // |M - exact| <= M_slack resolution^2
  double verify_slack = 1e-11;  // relative, for speeds between states whose difference cancels
  bool against_exact = true;    // off where the formula takes minutes
};

/// Runs to the times and to the steady state, checking all guarantees at each.
Outcome run(const SceneSpec<double>& spec, double resolution, const std::vector<double>& times,
            Limits limits = {}) {
  const Scene<double> scene(spec);
  const TrackingSetup<double> setup(scene, resolution);
  Tracked tracker(setup);
  const double mass = scene.mass(), height = scene.top() - scene.bottom();
  const auto exact = limits.against_exact ? std::make_unique<ExactSolution<double>>(scene) : nullptr;
  const auto check = [&](double t) {
    EXPECT_NEAR(tracker.mass(), mass, 1e-13 * std::max(mass, height)) << "t = " << t;
    EXPECT_EQ(verify(tracker, 1e-13 * height, limits.verify_slack), std::vector<std::string>{});
    const Profile<double> profile = tracker.profile();
    for (const double phi : profile.below()) {
      ASSERT_GE(phi, 0);
      ASSERT_LE(phi, 1);
    }
    if (!exact) return;
    for (int i = 0; i <= 20; ++i) {
      const double z = scene.bottom() + height * i / 20;
      EXPECT_NEAR(profile.at(z).M, exact->M(z, t), limits.M_slack * resolution * resolution * height + 1e-13)
          << "z = " << z << ", t = " << t;
    }
  };
  for (const double t : times) {
    tracker.advance_to(t);
    check(t);
  }
  EXPECT_EQ(tracker.run_to_steady(), Status::steady);
  check(infinity<double>());
  return {tracked_timeline(tracker, scene, setup.stack), exact ? exact_timeline(scene) : Timeline<double>{},
          tracker.n_collisions()};
}

TEST(HardCases, JumpExactlyOnTheInterface) {
  // The fan starts on z_c, split between two layers: t_c = 0, and both halves travel in one layer each, so
  // t_0 = z_c / k0 and t_1 = (1 - z_c) / k1 up to the first secant.
  const double k0 = 2.4, k1 = 0.31, z_c = 0.29, resolution = 0.01;
  const Outcome o = run(layered({z_c}, {k0, k1}, {z_c}, {0, 1}), resolution, {0, 0.01, 0.3, 2});
  EXPECT_EQ(o.tracked.interfaces[0].first, 0.0);
  EXPECT_EQ(o.exact.interfaces[0].first, 0.0);
  EXPECT_NEAR(*o.exact.t0, z_c / k0, 1e-15);
  EXPECT_NEAR(*o.exact.t1, (1 - z_c) / k1, 1e-14);
  EXPECT_NEAR(*o.tracked.t0, z_c / k0, 1.2 * resolution * z_c / k0);
  EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, resolution * *o.exact.t_star);
}

TEST(HardCases, JumpOneUlpFromTheInterface) {
  const double z_c = 0.29;
  for (const double z0 : {std::nextafter(z_c, 0.0), std::nextafter(z_c, 1.0)}) {
    const Outcome near = run(layered({z_c}, {2.4, 0.31}, {z0}, {0, 1}), 0.01, {0.3, 2});
    const Outcome on = run(layered({z_c}, {2.4, 0.31}, {z_c}, {0, 1}), 0.01, {});
    EXPECT_NEAR(*near.tracked.t_star, *on.tracked.t_star, 1e-12 * *on.tracked.t_star);
    EXPECT_NEAR(*near.tracked.t0, *on.tracked.t0, 1e-12);
  }
}

TEST(HardCases, StableJumpExactlyOnTheInterface) {
  // Large above small is the final state already, wherever the interface is: nothing moves, t* = 0.
  const Outcome o = run(layered({0.29}, {2.4, 0.31}, {0.29}, {1, 0}), 0.1, {1});
  EXPECT_EQ(o.collisions, 0u);
  EXPECT_EQ(o.tracked.t_star, 0.0);
  EXPECT_EQ(o.exact.t_star, 0.0);
  EXPECT_FALSE(o.tracked.t0.has_value());
  EXPECT_FALSE(o.tracked.interfaces[0].first.has_value());
}

TEST(HardCases, EqualNeighbouringRatesChangeNothing) {
  // An interface between equal layers is only a line on paper: the solution is that of one layer.
  const auto one = layered({}, {0.8}, {0.4}, {0, 1}),
             three = layered({0.3, 0.7}, {0.8, 0.8, 0.8}, {0.4}, {0, 1});
  const Outcome a = run(one, 0.01, {0.5}), b = run(three, 0.01, {0.5});
  EXPECT_NEAR(*a.tracked.t_star, *b.tracked.t_star, 1e-13 * *a.tracked.t_star);
  const Scene<double> scene_a(one), scene_b(three);
  const TrackingSetup<double> sa(scene_a, 0.01), sb(scene_b, 0.01);
  Tracked ta(sa), tb(sb);
  for (const double t : {0.2, 0.7, 1.5, 3.0}) {
    ta.advance_to(t), tb.advance_to(t);
    EXPECT_LE(l1_distance(ta.profile(), tb.profile()), 1e-12);
  }
}

TEST(HardCases, NearlyEqualNeighbouringRates) {
  // One ulp of contrast: flux levels differ in the last bit, the solution in nothing that can be seen.
  const double a = 0.8, b = std::nextafter(0.8, 1.0);
  const Outcome o = run(layered({0.3, 0.7}, {a, b, a}, {0.4}, {0, 1}), 0.01, {0.2, 0.9});
  const Outcome flat = run(layered({}, {a}, {0.4}, {0, 1}), 0.01, {});
  EXPECT_NEAR(*o.tracked.t_star, *flat.tracked.t_star, 1e-12 * *flat.tracked.t_star);
}

TEST(HardCases, ContrastOfTwelveOrdersOfMagnitude) {
  // The slow layer rules: after t ~ 1e-11 nothing moves in the fast one but what the slow one lets through.
  for (const auto& rates : {std::vector<double>{1e12, 1}, {1, 1e12}, {1e-12, 1}, {1e6, 1e-6, 1e6}}) {
    std::vector<double> breaks{0.29};
    if (rates.size() == 3) breaks = {0.29, 0.6};
    const Outcome o = run(layered(breaks, rates, {0.5}, {0, 1}), 0.01, {1e-12, 1e-3, 1, 1e3, 1e6});
    EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, 0.01 * *o.exact.t_star);
  }
}

TEST(HardCases, ThousandRandomLayers) {
  support::SceneMaker maker(support::seed_of(11));
  SceneSpec<double> spec;
  Piecewise<double> a;
  for (int i = 0; i < 1000; ++i) {
    if (i > 0) a.breaks.push_back(i / 1000.0);
    a.values.push_back(std::exp(maker.uniform(-1, 1)));
  }
  spec.shear_rate = a;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Outcome o = run(spec, 0.1, {0.3, 2});
  EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, 0.1 * *o.exact.t_star);
}

SceneSpec<double> ten_thousand_layers(const std::function<double(int)>& rate) {
  SceneSpec<double> spec;
  Piecewise<double> a;
  for (int i = 0; i < 10000; ++i) {
    if (i > 0) a.breaks.push_back(i / 10000.0);
    a.values.push_back(rate(i));
  }
  spec.shear_rate = a;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

TEST(HardCases, TenThousandRandomLayers) {
  // Every interface is a mirror for part of the waves; the slowest layer of all throttles the flux in the
  // end.
  support::SceneMaker maker(support::seed_of(12));
  const auto spec = ten_thousand_layers([&](int) { return std::exp(maker.uniform(-1, 1)); });
  run(spec, 0.25, {0.001, 0.03}, {1, 1e-11, false});
}

TEST(HardCases, TenThousandLayersOfAFallingRate) {
  // A staircase for a = 4 - 3 z: the fan turns back little by little. Short of the walls, against the
  // formula.
  const auto spec = ten_thousand_layers([](int i) { return 4 - 3 * (i + 0.5) / 10000; });
  const double resolution = 0.02, t = 0.02;
  const Scene<double> scene(spec);
  const TrackingSetup<double> setup(scene, resolution);
  Tracked tracker(setup);
  const ExactSolution<double> exact(scene);
  tracker.advance_to(t);
  EXPECT_NEAR(tracker.mass(), scene.mass(), 1e-13);
  EXPECT_EQ(verify(tracker, 1e-13, 1e-11), std::vector<std::string>{});
  const Profile<double> profile = tracker.profile();
  for (const double z : {0.46, 0.48, 0.5, 0.52, 0.54})
    EXPECT_NEAR(profile.at(z).M, exact.M(z, t), resolution * resolution);
}

TEST(HardCases, LayerOfWidth1em12) {
  // Too thin to be seen: waves need 1e-12 / a longer (or shorter) to cross it, so nothing changes by more
  // than that, unless it is a bottleneck, which throttles the flux however thin it is.
  const auto plain = layered({}, {1}, {0.5}, {0, 1}),
             fast = layered({0.3, 0.3 + 1e-12}, {1, 3, 1}, {0.5}, {0, 1}),
             slow = layered({0.3, 0.3 + 1e-12}, {1, 0.2, 1}, {0.5}, {0, 1});
  const Outcome p = run(plain, 0.01, {0.5}), f = run(fast, 0.01, {0.1, 0.5, 1}),
                s = run(slow, 0.01, {0.1, 0.5, 1});
  EXPECT_NEAR(*f.tracked.t_star, *p.tracked.t_star, 1e-10);
  EXPECT_GT(*s.tracked.t_star, *p.tracked.t_star * 1.5);
  EXPECT_NEAR(*s.tracked.t_star, *s.exact.t_star, 0.01 * *s.exact.t_star);
}

TEST(HardCases, LayerOneUlpHigh) {
  const double lo = 0.3, hi = std::nextafter(lo, 1.0);
  const Outcome o = run(layered({lo, hi}, {1, 0.2, 1}, {0.5}, {0, 1}), 0.05, {0.1, 0.5, 1});
  const Outcome thin = run(layered({lo, lo + 1e-12}, {1, 0.2, 1}, {0.5}, {0, 1}), 0.05, {});
  EXPECT_NEAR(*o.tracked.t_star, *thin.tracked.t_star, 1e-10);
}

TEST(HardCases, AllCollisionsSimultaneous) {
  // 64 equal cells of 0 | 1 | 0 | 1 ...: every cell does the same at the same time, and every meeting inside
  // is of a fan front with a wall or with its mirror image. Mirror symmetry (z -> 1 - z, phi -> 1 - phi) must
  // survive.
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  for (int i = 0; i < 64; ++i) {
    if (i > 0) spec.initial_breaks.push_back(i / 64.0);
    spec.initial_values.push_back(i % 2);
  }
  const Outcome o = run(spec, 0.05, {0.01, 0.05, 0.2, 1});
  EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, 0.05 * *o.exact.t_star);
  const Scene<double> scene(spec);
  const TrackingSetup<double> setup(scene, 0.05);
  Tracked tracker(setup);
  tracker.advance_to(0.3);
  const Profile<double> p = tracker.profile();
  for (double z = 0.005; z < 1; z += 0.01) EXPECT_NEAR(p.at(z).M - (z - 0.5) - p.at(1 - z).M, 0.0, 1e-12);
}

TEST(HardCases, ThreeFrontsInOnePoint) {
  // Shocks 0.8 | 0.5 and 0.5 | 0.2 with speeds a (l + r - 1) = 0.3 and -0.3, at equal distance 1/32 from an
  // interface between equal layers: both and the interface meet in one point, at t = 1 / (32 * 0.3), before
  // the walls' shocks come.
  const Outcome o = run(layered({0.5}, {1, 1}, {0.46875, 0.53125}, {0.8, 0.5, 0.2}), 0.1, {0.05, 0.2, 1.5});
  EXPECT_NEAR(*o.tracked.interfaces[0].first, 1 / 9.6, 1e-12);
  EXPECT_NEAR(*o.exact.interfaces[0].first, 1 / 9.6, 1e-12);
}

TEST(SlowHardCases, ResolutionOneMillionth) {
  const Outcome o = run(layered({0.29}, {2.4, 0.31}, {0.5}, {0, 1}), 1e-6, {0.5, 6}, {4, 1e-9, true});
  EXPECT_NEAR(*o.tracked.t_star, 2 / 0.31, 1e-12);
  EXPECT_NEAR(*o.tracked.t1, 0.5 / 0.31, 1.2e-6 * 0.5 / 0.31);
}

TEST(HardCases, TinyAndHugeTimesAndScales) {
  const auto spec = layered({0.29}, {2.4, 0.31}, {0.5}, {0, 1});
  run(spec, 0.01, {1e-300, 1e300});
  for (const double scale : {1e-300, 1e-150, 1e150, 1e300}) {
    SceneSpec<double> scaled = spec;
    scaled.scale = scale;
    const Outcome o = run(scaled, 0.01, {0.5 / scale, 6 / scale});
    EXPECT_NEAR(*o.tracked.t_star * scale, 2 / 0.31, 1e-11);
    EXPECT_NEAR(*o.exact.t_star * scale, 2 / 0.31, 1e-13);
  }
}

TEST(HardCases, SteadyTimeOf1e15) {
  const Outcome o = run(layered({}, {1e-15}, {0.5}, {0, 1}), 0.01, {1e14, 1e15});
  EXPECT_NEAR(*o.tracked.t_star / 2e15, 1, 1e-13);
}

TEST(HardCases, HundredThousandJumps) {
  // More initial states than the grid has levels: their fluxes come from the polygon, second order in the
  // resolution.
  support::SceneMaker maker(support::seed_of(13));
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  for (int i = 0; i < 100000; ++i) {
    if (i > 0) spec.initial_breaks.push_back(i / 100000.0);
    spec.initial_values.push_back(maker.uniform(0, 1));
  }
  const Outcome o = run(spec, 0.1, {1e-5, 1e-3, 0.1}, {1, 1e-9, false});
  EXPECT_GT(*o.tracked.t_star, 0);
}

TEST(HardCases, ConstantInitialData) {
  const std::vector<double> breaks{0.29}, rates{2.4, 0.31};
  // Only one kind of grain: nothing ever moves.
  for (const double phi : {0.0, 1.0}) {
    const Outcome o = run(layered(breaks, rates, {}, {phi}), 0.1, {1});
    EXPECT_EQ(o.collisions, 0u);
    EXPECT_EQ(o.tracked.t_star, 0.0);
    EXPECT_EQ(o.exact.t_star, 0.0);
  }
  // A mixture starts to segregate at both walls and at the interface at once.
  const Outcome o = run(layered(breaks, rates, {}, {0.5}), 0.01, {0, 0.1, 1, 5});
  EXPECT_EQ(o.tracked.t0, 0.0);
  EXPECT_EQ(o.tracked.t1, 0.0);
  EXPECT_EQ(o.tracked.interfaces[0].first, 0.0);
  EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, 0.01 * *o.exact.t_star);
}

TEST(HardCases, TracesOfOneKindOfGrain) {
  for (const double phi : {1e-9, 1e-15, 1 - 1e-9}) {
    const Outcome o = run(layered({0.29}, {2.4, 0.31}, {}, {phi}), 0.01, {0.1, 1});
    EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, 0.01 * *o.exact.t_star);
  }
}

TEST(HardCases, StatesNextToOneHalf) {
  // The flux is flat there: a state 1e-9 from 1/2 has the flux of 1/2 to rounding, and must still keep its
  // phi.
  const double phi = 0.5 + 1e-9;
  const Outcome o = run(layered({0.29}, {2.4, 0.31}, {0.4, 0.7}, {phi, 0.5, 1 - phi}), 0.01, {0.1, 1, 4});
  EXPECT_NEAR(*o.tracked.t_star, *o.exact.t_star, 0.01 * *o.exact.t_star);
}

}  // namespace
}  // namespace shearfront
