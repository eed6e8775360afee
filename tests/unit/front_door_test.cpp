// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/shearfront.hpp"
#include "shearfront/track/setup.hpp"

namespace shearfront {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

SceneSpec<> two_layers() {
  SceneSpec<> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

TEST(Track, ChoosesTheGridOfTheFlux) {
  SceneSpec<> spec = two_layers();
  spec.fluxes = {Cubic<double>{}};
  const Scene<> scene(spec);
  EXPECT_THROW(TrackingSetup<double>(scene, 0.01), InputError);
  Tracking bed = track(scene, {.resolution = 0.005});
  ASSERT_EQ(bed.advance(0.5), Status::ok);
  const SolverResult grid = solve(scene, "godunov", {.times = {0.5}, .profiles = true});
  EXPECT_LT(l1_distance(bed.profile(), grid.profiles.at(0)), 0.01);
  EXPECT_NEAR(bed.profile().mass(), scene.mass(), 1e-12);
}

TEST(Track, KeepsTheEndsOfTheScene) {
  SceneSpec<> spec = two_layers();
  spec.initial_values = {0.5, 1};
  spec.outside_bottom = OutsideState<double>{{}, {0.8}};
  const Scene<> scene(spec);
  Tracking open = track(scene);
  open.advance(0.1);
  // Of 0.8 (1 - 0.8) a, small grains leave through the bottom.
  EXPECT_NEAR(open.profile().mass(), scene.mass() - 0.1 * 2.4 * 0.8 * 0.2, 1e-12);
  EXPECT_FALSE(open.timeline());
  EXPECT_EQ(open.summary().status, Status::unsupported);
}

TEST(Track, RecordsAreClosedWhenTheyAreRead) {
  Tracking bed = track(Scene<>(two_layers()), {.resolution = 0.05, .history = true});
  bed.advance(1);
  const auto early = bed.fronts();
  EXPECT_EQ(bed.fronts().size(), early.size());
  for (const FrontSegment<double>& front : early) EXPECT_LE(front.t_end, 1);
  const std::size_t n_early = bed.collisions().size();
  EXPECT_EQ(bed.advance(kForever), Status::steady);
  EXPECT_GE(bed.fronts().size(), early.size());
  EXPECT_GT(bed.collisions().size(), n_early);
  EXPECT_EQ(bed.collisions().front().boundary, 1U);  // the fan reaches the interface first
}

// The kind of fault: work that grows without a bound on its memory.
TEST(Track, StopsWithTooManyFronts) {
  Tracking free = track(Scene<>(two_layers()), {.resolution = 0.02});
  EXPECT_EQ(free.advance(kForever), Status::steady);
  const std::uint64_t most = free.summary().fronts_max;
  for (const std::uint64_t allowed : {std::uint64_t{10}, most - 1, most}) {  // 10: fewer than leave the jump
    Tracking bed = track(Scene<>(two_layers()), {.resolution = 0.02, .max_fronts = allowed});
    if (allowed == most) {
      EXPECT_EQ(bed.advance(kForever), Status::steady);
      continue;
    }
    EXPECT_EQ(bed.advance(kForever), Status::budget_reached);
    EXPECT_NE(bed.summary().message.find("fronts, more than allowed"), std::string::npos)
        << bed.summary().message;
    EXPECT_FALSE(bed.timeline());
  }
}

TEST(Track, IsAValue) {
  Tracking bed = track(Scene<>(two_layers()));
  bed.advance(0.5);
  Tracking other = bed;
  other.advance(2);
  EXPECT_EQ(bed.time(), 0.5);
  bed.advance(2);
  EXPECT_EQ(l1_distance(bed.profile(), other.profile()), 0);
  bed = track(Scene<>(two_layers()));
  EXPECT_EQ(bed.time(), 0);
}

TEST(Track, RefusesWithAReason) {
  SceneSpec<> spec = two_layers();
  spec.diffusion = Diffusion<double>{0.01, {}, false};
  const Scene<> scene(spec);
  EXPECT_FALSE(Tracking::refusal(scene).empty());
  EXPECT_THROW((void)track(scene), InputError);
  EXPECT_THROW((void)track(Scene<>(two_layers()), {.resolution = 0}), InputError);
}

TEST(EventTimes, AreThoseOfTheFirstMethodThatKnowsThem) {
  const Scene<> scene(two_layers());
  const Timeline<double> times = event_times(scene);
  EXPECT_NEAR(*times.t1, 0.5 / 0.31, 1e-14);
  EXPECT_NEAR(*event_times(scene, "front-tracking").t_star, *times.t_star, 1e-12);
  EXPECT_THROW((void)event_times(scene, "godunov"), InputError);
  SceneSpec<> spec = two_layers();
  spec.diffusion = Diffusion<double>{0.01, {}, false};
  EXPECT_THROW((void)event_times(Scene<>(spec)), InputError);
}

TEST(SolverResult, IsReadByTimeAndHeight) {
  const SolverResult result =
      solve(Scene<>(two_layers()), "exact", {.times = {0.5, 6}, .heights = {0.1, 0.5, 0.9}});
  EXPECT_EQ(result.M(1, 2), result.samples[5].M);
  EXPECT_EQ(result.phi(0, 1), result.samples[1].phi);
}

}  // namespace
}  // namespace shearfront
