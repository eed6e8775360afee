// SPDX-License-Identifier: BSD-3-Clause
// Front tracking in beds without walls: open and periodic ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/setup.hpp"
#include "support/any_flux.hpp"

namespace shearfront {
namespace {

using support::draw;
using support::name_of;
using support::SceneMaker;
using support::unimodal_fluxes;

/// n copies of the bed on top of each other, as many layers and jumps.
SceneSpec<double> repeated(const SceneSpec<double>& spec, int n) {
  SceneSpec<double> all = spec;
  auto& a = std::get<Piecewise<double>>(all.shear_rate);
  const auto& one = std::get<Piecewise<double>>(spec.shear_rate);
  all.is_periodic = false;
  all.top = n;
  for (int i = 1; i < n; ++i) {
    a.breaks.push_back(i), all.initial_breaks.push_back(i);
    for (const double z : one.breaks) a.breaks.push_back(i + z);
    for (const double z : spec.initial_breaks) all.initial_breaks.push_back(i + z);
    a.values.insert(a.values.end(), one.values.begin(), one.values.end());
    all.initial_values.insert(all.initial_values.end(), spec.initial_values.begin(),
                              spec.initial_values.end());
  }
  return all;
}

// What the walls do has not reached the middle copy yet.
TEST(Ends, APeriodicBedIsTheMiddleOfManyCopies) {
  SceneMaker maker(support::seed_of(8104));
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 4; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      SceneSpec<double> spec = draw(maker, flux, 1 + number, 2);
      for (double& a : std::get<Piecewise<double>>(spec.shear_rate).values) a = maker.uniform(0.5, 1);
      spec.is_periodic = true;
      const int n = 11;
      SolverRequest request{{0.4, 2.5}, {}, false, false, false}, many = request;
      for (int i = 0; i < 50; ++i) request.heights.push_back((i + 0.31) / 50);
      for (const double z : request.heights) many.heights.push_back(z + 5);
      const FrontTrackingSolver::Options options{.resolution = 0.05};
      const auto periodic = solve<FrontTrackingSolver>(Scene<double>(spec), request, options);
      const auto copies = solve<FrontTrackingSolver>(Scene<double>(repeated(spec, n)), many, options);
      ASSERT_EQ(periodic.samples.size(), 100u) << periodic.summary.message;
      ASSERT_EQ(copies.samples.size(), 100u) << copies.summary.message;
      for (std::size_t i = 0; i < 100; ++i)
        EXPECT_NEAR(periodic.samples[i].phi, copies.samples[i].phi, 1e-12) << i;
    }
}

/// Whether a wave that has left a bed from 0 to 1 turns, caught up by one that left later; those that leave
/// the walls at `bottom` and `top` are not meant.
bool turns(const std::vector<FrontSegment<double>>& fronts, double bottom, double top) {
  return std::any_of(fronts.begin(), fronts.end(), [&](const auto& f) {
    return (f.z_begin > 1 && f.z_begin < top && f.z_end < f.z_begin) ||
           (f.z_begin < 0 && f.z_begin > bottom && f.z_end > f.z_begin);
  });
}

// The bed goes on beyond its ends in the state that lies outside: then the ends are not there, as long as all
// that leaves goes on leaving. (An end knows only the state outside, not what has gone there.)
TEST(Ends, AnOpenEndNextToItsOwnStateIsNotThere) {
  SceneMaker maker(support::seed_of(8105));
  int n_compared = 0;
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 4; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      SceneSpec<double> spec = draw(maker, flux, 1 + number, 3), wide = spec;
      const double fastest = 4 * 2.5, t = 0.8;  // of a up to 4; |f'| <= 2.5 on all samples
      wide.bottom = -fastest * t, wide.top = 1 + fastest * t;
      spec.outside_bottom = OutsideState<double>{{}, {spec.initial_values.front()}};
      spec.outside_top = OutsideState<double>{{}, {spec.initial_values.back()}};
      SolverRequest request{{0.2, t}, {}, false, false, false};
      for (int i = 0; i < 50; ++i) request.heights.push_back((i + 0.31) / 50);
      const FrontTrackingSolver::Options options{.resolution = 0.05};
      const auto open = solve<FrontTrackingSolver>(Scene<double>(spec), request, options);
      request.fronts = true;
      const auto all = solve<FrontTrackingSolver>(Scene<double>(wide), request, options);
      ASSERT_EQ(open.samples.size(), 100u) << open.summary.message;
      ASSERT_EQ(all.samples.size(), 100u) << all.summary.message;
      if (turns(all.fronts, wide.bottom, wide.top)) continue;
      ++n_compared;
      for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(open.samples[i].phi, all.samples[i].phi, 1e-12) << i;
    }
  EXPECT_GT(n_compared, 60);
}

// States beyond both ends that change often, more of them than the grid makes vertices of.
TEST(Ends, ChangingStatesAgreeWithGodunov) {
  SceneMaker maker(support::seed_of(8106));
  for (const Flux<double>& flux : {Flux<double>(Quadratic<double>{}), Flux<double>(Lwr<double>{}),
                                   Flux<double>(Triangular<double>{0.25, 1})}) {
    SCOPED_TRACE(name_of(flux));
    SceneSpec<double> spec = draw(maker, flux, 3, 3);
    OutsideState<double> bottom, top;
    for (int i = 0; i < 50; ++i) {
      bottom.values.push_back(maker.uniform(0, 1)), top.values.push_back(maker.uniform(0, 1));
      if (i > 0) bottom.breaks.push_back(0.04 * i), top.breaks.push_back(0.04 * i + 0.01);
    }
    spec.outside_bottom = bottom, spec.outside_top = top;
    const Scene<double> scene(spec);
    SolverRequest request{{0.5, 2.5}, {}, false, false, false};
    for (int i = 1; i <= 20; ++i) request.heights.push_back(i / 20.0);
    const auto tracked = solve<FrontTrackingSolver>(scene, request, {.resolution = 0.002});
    ASSERT_EQ(tracked.samples.size(), 40u) << tracked.summary.message;
    double coarse_error = 0, fine_error = 0;
    for (const std::uint64_t cells : {200U, 1600U}) {
      const auto grid = solve<GodunovSolver>(scene, request, {{.cells = cells}});
      ASSERT_EQ(grid.samples.size(), 40u) << grid.summary.message;
      double& error = cells == 200 ? coarse_error : fine_error;
      for (std::size_t i = 0; i < 40; ++i)
        error = std::max(error, std::abs(grid.samples[i].M - tracked.samples[i].M));
    }
    EXPECT_LT(fine_error, 2e-3);
    EXPECT_LT(fine_error, 0.5 * coarse_error);  // jumps of a straight branch spread like the root of a width
  }
}

TEST(Ends, TheLastStateComesAfterTheLastChange) {
  SceneSpec<double> spec;
  spec.fluxes = {Lwr<double>{}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0};
  spec.outside_bottom = OutsideState<double>{{3}, {0, 0.25}};
  spec.outside_top = OutsideState<double>{{}, {0}};
  const TrackingSetup<double> setup(Scene<double>(spec), 0.1);
  Tracker<LevelGrid<double>> tracker(setup);
  ASSERT_EQ(tracker.advance_to(3.5), Status::ok);
  EXPECT_GT(tracker.mass(), 0.05);
  ASSERT_EQ(tracker.run_to_steady(), Status::steady);
  EXPECT_GE(tracker.time(), 4);  // the fan from 0 to 1/4 crosses the bed after t = 3
  EXPECT_NEAR(tracker.mass(), 0.25, 1e-15);
  // A change that sets nothing off: time does not run back.
  spec.outside_bottom = OutsideState<double>{{3}, {0, 0}};
  const TrackingSetup<double> quiet(Scene<double>(spec), 0.1);
  Tracker<LevelGrid<double>> still(quiet);
  ASSERT_EQ(still.run_to_steady(), Status::steady);
  EXPECT_EQ(still.time(), 3);
}

// Red and green: cars wait behind a light at the upper end (state outside: jam while it is red), and the
// queue dissolves in a fan from 1 to 1/2 when it turns green.
TEST(Ends, TrafficLight) {
  SceneSpec<double> spec;
  spec.fluxes = {Lwr<double>{}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.2};
  spec.outside_bottom = OutsideState<double>{{}, {0.2}};
  spec.outside_top = OutsideState<double>{{1}, {1, 0}};
  SolverRequest request{{0.5, 1, 1.4}, {}, false, false, true};
  const auto result = solve<FrontTrackingSolver>(Scene<double>(spec), request, {.resolution = 0.001});
  ASSERT_EQ(result.profiles.size(), 3u);
  // The end of the queue moves with (0 - 0.16) / (1 - 0.2) = -0.2.
  EXPECT_NEAR(result.profiles[0].at(0.89).phi, 0.2, 1e-15);
  EXPECT_NEAR(result.profiles[0].at(0.91).phi, 1, 1e-15);
  EXPECT_NEAR(result.profiles[0].mass(), 0.2 * 0.9 + 0.1, 1e-14);
  EXPECT_NEAR(result.profiles[1].mass(), 0.2 * 0.8 + 0.2, 1e-14);
  // 0.4 later: the fan 1 - 2 rho = (z - 1) / 0.4 reaches down to 0.6, the queue is gone at 1.25, and where
  // the two meet the end of the queue speeds up: (z_q - 1) = 0.4 (1 - 2 rho_q) with z_q from the jump
  // condition.
  for (const double z : {0.85, 0.9, 0.95, 0.99})
    EXPECT_NEAR(result.profiles[2].at(z).phi, 0.5 * (1 - (z - 1) / 0.4), 2e-3) << z;
  // What has left: capacity 1/4 since t = 1; what came in: 0.16.
  EXPECT_NEAR(result.profiles[2].mass(), 0.2 + 0.16 * 1.4 - 0.25 * 0.4, 1e-13);
}

}  // namespace
}  // namespace shearfront
