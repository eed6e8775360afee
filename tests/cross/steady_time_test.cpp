// SPDX-License-Identifier: BSD-3-Clause
// Beds that come to rest late or never, because the flux has little or no slope at a pure state. The kind of fault: the last
// event of a polygon was called the last event of the bed, and moved away as the polygon was refined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/track.hpp"

namespace shearfront {
namespace {

SceneSpec<> upside_down(const Flux<double>& flux) {
  SceneSpec<> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

Timeline<double> times(const SceneSpec<>& spec, double resolution) {
  Tracking bed = track(Scene<>(spec), {.resolution = resolution});
  const auto timeline = bed.timeline();
  EXPECT_TRUE(timeline && bed.summary().usable()) << bed.summary().message;
  return timeline.value_or(Timeline<double>{});
}

const std::vector<double> kResolutions{0.1, 0.01, 0.001};

TEST(SteadyTime, NeverWhereTheFluxIsFlatAtAPureState) {
  SceneSpec<> column = upside_down(RichardsonZaki<double>{4.65});
  column.initial_breaks.clear();
  column.initial_values = {0.15};
  SceneSpec<> rising = upside_down(LwrCubic<double>{1, 1});
  rising.initial_values = {1, 0};
  for (const SceneSpec<>& spec : {column, upside_down(Cubic<double>{1}), rising})
    for (const double resolution : kResolutions) {
      SCOPED_TRACE(std::string(spec.fluxes[0].name()) + ", resolution " + std::to_string(resolution));
      EXPECT_FALSE(times(spec, resolution).t_star);
      Tracking bed = track(Scene<>(spec), {.resolution = resolution});
      (void)bed.timeline();
      EXPECT_NE(bed.summary().message.find("never rests"), std::string::npos) << bed.summary().message;
    }
}

// From the bottom pure grains grow no faster than f'(1) = 1 - gamma: not up to z = 1/2 before 1 / (2 (1 - gamma)). A fan
// that lasts has that speed at its edge, so for little slopes the time is hardly later.
TEST(SteadyTime, LateWhereTheSlopeIsLittle) {
  for (const double gamma : {0.99, 0.999, 0.9999})
    for (const double resolution : kResolutions) {
      const double earliest = 0.5 / (1 - gamma);
      const auto t = times(upside_down(Cubic<double>{gamma}), resolution).t_star;
      ASSERT_TRUE(t);
      EXPECT_GE(*t, earliest * (1 - 1e-10));
      EXPECT_LE(*t, earliest * 1.01);
    }
}

// The last change at an interface below the steady height is that of the state 1, which never comes; the one above it sees
// pure states 0, which come in finite time.
TEST(SteadyTime, TheLastChangeAtAnInterface) {
  SceneSpec<> spec = upside_down(Cubic<double>{1});
  spec.shear_rate = Piecewise<double>{{0.2, 0.7}, {1, 2, 0.5}};
  std::optional<double> above;
  for (const double resolution : kResolutions) {
    const Timeline<double> timeline = times(spec, resolution);
    ASSERT_EQ(timeline.interfaces.size(), 2U);
    EXPECT_TRUE(timeline.interfaces[0].first);
    EXPECT_FALSE(timeline.interfaces[0].last);
    ASSERT_TRUE(timeline.interfaces[1].last);
    if (above) {
      EXPECT_NEAR(*timeline.interfaces[1].last, *above, 0.01);
    }
    above = timeline.interfaces[1].last;
  }
}

TEST(SteadyTime, AtOnceWhereNothingMoves) {
  SceneSpec<> spec = upside_down(Cubic<double>{1});
  spec.initial_breaks = {0.3};
  spec.initial_values = {1, 0};
  EXPECT_EQ(times(spec, 0.01).t_star, 0.0);
}

// Flat below z = 0.3, where all is pure at the start; what sinks settles above it, where the flux has a slope.
TEST(SteadyTime, OnlyLayersThatFillCount) {
  SceneSpec<> spec = upside_down(Cubic<double>{1});
  spec.fluxes = {Cubic<double>{1}, Quadratic<double>{}};
  spec.flux_breaks = {0.3};
  spec.initial_breaks = {0.3, 0.6};
  spec.initial_values = {1, 0, 1};
  for (const double resolution : kResolutions) {
    const auto t = times(spec, resolution).t_star;
    ASSERT_TRUE(t);
    // A bed 0.7 high over a bottom at 0.3: (sqrt(0.3) + sqrt(0.4))^2 by May et al. (2010), z0 = 0.3 and h = 0.7.
    EXPECT_NEAR(*t, 0.7 + 2 * std::sqrt(0.3 * 0.4), 0.02 * resolution / 0.1 + 1e-6);
  }
}

// Fluxes with a slope at both pure states: nothing but the tracker's time.
TEST(SteadyTime, TheTimeOfTheTrackerWhereItConverges) {
  EXPECT_NEAR(*times(upside_down(Quadratic<double>{}), 0.001).t_star, 2, 1e-5);
}

// The time that grid methods give with the steady state: by then M is that of the steady state, which was not so a crossing of
// the bed before; it comes to t* of the exact solution as cells become narrower, and not before it.
TEST(SteadyTime, GridMethodsSayWhenTheyHadComeToRest) {
  const Scene<> scene(upside_down(Quadratic<double>{}));
  constexpr double kExact = 2, kNear = 1e-9;
  int n_checked = 0;
  for (const char* name : {"godunov", "engquist-osher", "muscl"}) {
    double coarsest = 0, finest = 0;
    for (const std::uint64_t cells : {50U, 100U, 200U}) {
      SCOPED_TRACE(std::string(name) + " with " + std::to_string(cells));
      Method method(name);
      method.set("cells", cells);
      SolverRequest request;
      request.times = {std::numeric_limits<double>::infinity()};
      for (int i = 1; i < 100; ++i) request.heights.push_back(0.01 * i);
      const SolverResult steady = solve(scene, method, request);
      ASSERT_TRUE(steady.summary.rest_time);
      const double t = *steady.summary.rest_time;
      EXPECT_GT(t, kExact);
      finest = t - kExact;
      if (coarsest == 0) coarsest = finest;
      const auto distance_at = [&](double time) {
        request.times = {time};
        const SolverResult then = solve(scene, method, request);
        EXPECT_FALSE(then.summary.rest_time);
        double largest = 0;
        for (std::size_t j = 0; j < request.heights.size(); ++j)
          largest = std::max(largest, std::abs(then.M(0, j) - steady.M(0, j)));
        return largest;
      };
      EXPECT_LE(distance_at(t), kNear);
      EXPECT_GT(distance_at(t - 1.0 / 8), kNear);
      ++n_checked;
    }
    EXPECT_LT(finest, coarsest) << name;
    EXPECT_LT(finest, 0.1 * kExact) << name;
  }
  EXPECT_EQ(n_checked, 9);
}

// 1500 cells had no such time.
TEST(SteadyTime, FineGridsSayWhenTheyHadComeToRest) {
  const Scene<> scene(upside_down(Quadratic<double>{}));
  constexpr double kExact = 2;
  double coarser = kExact;
  for (const std::uint64_t cells : {400U, 2000U}) {
    Method method("godunov");
    method.set("cells", cells);
    SolverRequest request;
    request.times = {std::numeric_limits<double>::infinity()};
    request.heights = {0.5};
    const SolverResult steady = solve(scene, method, request);
    ASSERT_TRUE(steady.summary.rest_time) << cells;
    EXPECT_GT(*steady.summary.rest_time, kExact);
    EXPECT_LT(*steady.summary.rest_time - kExact, coarser / 2);  // of order between 1/2 and 1 in the cells
    coarser = *steady.summary.rest_time - kExact;
    EXPECT_EQ(steady.phi(0, 0), solve(scene, method, {request.times, {0.5}}).phi(0, 0));
  }
}

// With diffusion nothing has an end; the scheme says when what was left was less than its tolerance.
TEST(SteadyTime, CrankNicolsonSaysWhenItHadComeToRest) {
  SceneSpec<> spec = upside_down(Quadratic<double>{});
  spec.diffusion.emplace().D = 0.05;
  const Scene<> scene(spec);
  SolverRequest request;
  request.times = {std::numeric_limits<double>::infinity()};
  request.heights = {0.1, 0.3, 0.5, 0.7, 0.9};
  const SolverResult steady = solve(scene, "crank-nicolson", request);
  ASSERT_TRUE(steady.summary.rest_time);
  request.times = {*steady.summary.rest_time};
  const SolverResult then = solve(scene, "crank-nicolson", request);
  for (std::size_t j = 0; j < request.heights.size(); ++j)
    EXPECT_NEAR(then.phi(0, j), steady.phi(0, j), 1e-4);  // ten tolerances
}

}  // namespace
}  // namespace shearfront
