// SPDX-License-Identifier: BSD-3-Clause
// The tracker against the Lax-Hopf formula, which shares no code with it: random scenes, both ways of
// choosing data.
#include <gtest/gtest.h>

#include <cmath>

#include "oracles/verify.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "support/checked.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

struct Drawn {
  Scene<double> scene;
  double time;
};

// Even numbers: small above large with z0 random; odd: up to 20 jumps. 2 to 8 layers, a falling, rising or
// random.
Drawn draw(int number) {
  SceneMaker maker(support::seed_of(static_cast<std::uint64_t>(number)));
  const int layers = maker.integer(2, 8);
  const auto order = maker.order();
  Scene<double> scene(number % 2 == 0 ? maker.step(layers, order) : maker.data(layers, order, 20));
  return {scene, std::exp(maker.uniform(-3, 3))};
}

using LevelTracker = Tracker<LevelGrid<double>>;

constexpr double kResolution = 0.02;
constexpr int kScenes = 600;
constexpr int kBlocks = 12;

class TrackerAgainstExact : public testing::TestWithParam<int> {};

TEST_P(TrackerAgainstExact, AgreesWithinTheResolution) {
  for (int number = GetParam(); number < kScenes; number += kBlocks) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const auto [scene, time] = draw(number);
    const ExactSolution<double> exact(scene);
    const TrackingSetup<double> setup(scene, kResolution);
    LevelTracker tracker(setup);
    tracker.advance_to(time);
    EXPECT_NEAR(tracker.mass(), scene.mass(), 1e-13);
    EXPECT_EQ(verify(tracker, 1e-13, 1e-11), std::vector<std::string>{});
    const auto steps = errors_against(exact, tracker.profile(), time);
    EXPECT_LE(steps.l1, kResolution);
    // Measured largest ratios over these scenes: 0.42 and 1.3.
    EXPECT_LE(steps.M_max, kResolution * kResolution);
    EXPECT_LE(errors_against(exact, linear_profile(tracker), time).l1, 3 * kResolution * kResolution);
    tracker.run_to_steady();
    EXPECT_NEAR(tracker.mass(), scene.mass(), 1e-13);
    const double t_star = exact_timeline(scene).t_star.value();
    EXPECT_NEAR(tracker.last_collision(), t_star, kResolution * t_star);
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, TrackerAgainstExact, testing::Range(0, kBlocks));

TEST(TrackerAgainstExactOrder, FirstInPhiSecondInMAndSecondWithLines) {
  const double coarse = 0.04, fine = 0.005;
  ProfileErrors<double> steps[2], lines[2];
  double t_star[2] = {0, 0};
  for (int number = 0; number < 100; ++number) {
    const auto [scene, time] = draw(number);
    const ExactSolution<double> exact(scene);
    const double exact_t_star = exact_timeline(scene).t_star.value();
    for (int i = 0; i < 2; ++i) {
      const TrackingSetup<double> setup(scene, i == 0 ? coarse : fine);
      LevelTracker tracker(setup);
      tracker.advance_to(time);
      const auto s = errors_against(exact, tracker.profile(), time);
      const auto l = errors_against(exact, linear_profile(tracker), time);
      steps[i].l1 += s.l1, steps[i].M_max += s.M_max, lines[i].l1 += l.l1;
      tracker.run_to_steady();
      t_star[i] += std::abs(tracker.last_collision() - exact_t_star) / std::max(exact_t_star, 1e-300);
    }
  }
  const auto order = [&](double a, double b) { return std::log(a / b) / std::log(coarse / fine); };
  EXPECT_GE(order(steps[0].l1, steps[1].l1), 0.95);
  EXPECT_GE(order(steps[0].M_max, steps[1].M_max), 1.8);
  EXPECT_GE(order(lines[0].l1, lines[1].l1), 1.8);
  EXPECT_GE(order(t_star[0], t_star[1]), 1.8);
}

TEST(TrackerAgainstExactTimes, FirstAndLastWavesAtWallsAndInterfaces) {
  support::Checked checked({"walls", "first", "last"}, 20);
  const double resolution = 0.01;
  for (int number = 0; number < 200; number += 2) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const auto [scene, time] = draw(number);
    const Timeline<double> exact = exact_timeline(scene);
    const TrackingSetup<double> setup(scene, resolution);
    LevelTracker tracker(setup);
    tracker.run_to_steady();
    const Timeline<double> tracked = tracked_timeline(tracker, scene, setup.stack);
    const auto near = [&](const std::optional<double>& a, const std::optional<double>& b, double slack,
                          const char* what) {
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_NEAR(*a, *b, slack * *b);
        checked.count(what);
      }
    };
    near(tracked.t0, exact.t0, 1.2 * resolution, "walls");
    near(tracked.t1, exact.t1, 1.2 * resolution, "walls");
    ASSERT_EQ(tracked.interfaces.size(), exact.interfaces.size());
    for (std::size_t i = 0; i < exact.interfaces.size(); ++i) {
      near(tracked.interfaces[i].first, exact.interfaces[i].first, 1.2 * resolution, "first");
      near(tracked.interfaces[i].last, exact.interfaces[i].last, resolution, "last");
    }
    EXPECT_DOUBLE_EQ(tracked.mass, exact.mass);
  }
}

// Without exact answers of their own: domains other than [0, 1] against the same scene moved to [0, 1].
TEST(TrackerAgainstExactDomain, MovedAndStretchedScenes) {
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const auto [scene, time] = draw(number);
    SceneSpec<double> moved = scene.spec();
    const auto map = [](double z) { return -3 + 4 * z; };
    auto& rate = std::get<Piecewise<double>>(moved.shear_rate);
    for (double& z : rate.breaks) z = map(z);
    for (double& z : moved.initial_breaks) z = map(z);
    moved.bottom = -3, moved.top = 1;
    const Scene<double> stretched(moved);
    const TrackingSetup<double> a(scene, kResolution), b(stretched, kResolution);
    LevelTracker tracker(a), other(b);
    tracker.advance_to(time);
    other.advance_to(4 * time);
    const auto p = tracker.profile(), q = other.profile();
    const ExactSolution<double> exact(stretched);
    for (double z : {0.05, 0.3, 0.55, 0.8, 0.95}) {
      EXPECT_NEAR(4 * p.at(z).M, q.at(map(z)).M, 1e-12);
      EXPECT_NEAR(exact.M(map(z), 4 * time), q.at(map(z)).M, 4 * kResolution * kResolution);
    }
  }
}

}  // namespace
}  // namespace shearfront
