// SPDX-License-Identifier: BSD-3-Clause
// Front tracking of measured fluxes with wiggles, in beds that are the same everywhere. The kind of fault: a restriction of
// the interface problem (two branches to be matched) laid on beds without an interface.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "oracles/verify.hpp"
#include "shearfront/model/flux/table.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/one_layer_grid.hpp"
#include "shearfront/track/setup.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// Through random points, 0 at both ends; below 0 between them unless it may change its sign.
FluxTable<double> wiggles(SceneMaker& maker, bool may_change_sign) {
  FluxTable<double> flux;
  const int n = maker.integer(5, 9);
  for (int i = 0; i <= n; ++i) {
    flux.phi.push_back(static_cast<double>(i) / n);
    const bool is_end = i == 0 || i == n;
    flux.values.push_back(is_end ? 0 : -maker.uniform(may_change_sign ? -0.25 : 0.02, 0.25));
  }
  return flux;
}

SceneSpec<> random_bed(SceneMaker& maker, bool may_change_sign) {
  SceneSpec<> spec;
  spec.fluxes = {wiggles(maker, may_change_sign)};
  spec.shear_rate = Piecewise<double>{{}, {maker.uniform(0.5, 2)}};
  if (maker.integer(0, 1) == 0) spec.solid_fraction = Piecewise<double>{{}, {0.75}};
  const auto state = [&] { return maker.integer(0, 2) == 0 ? maker.integer(0, 1) : maker.uniform(0, 1); };
  spec.initial_breaks = maker.heights(3, 0, 1);
  for (int i = 0; i < 4; ++i) spec.initial_values.push_back(state());
  const int ends = maker.integer(0, 3);
  spec.is_periodic = ends == 1;
  if (ends >= 2) spec.outside_bottom = OutsideState<double>{{0.2}, {state(), state()}};
  if (ends == 3) spec.outside_top = OutsideState<double>{{}, {state()}};
  return spec;
}

bool has_several_extrema(const SceneSpec<>& spec) { return spec.fluxes[0].extrema().size() > 1; }

TEST(SeveralExtrema, TrackerKeepsTheLaws) {
  SceneMaker maker(support::seed_of(8301));
  support::Checked checked({"walls", "open", "periodic"}, 10);
  for (int number = 0; number < 120; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const SceneSpec<> spec = random_bed(maker, number % 2 == 0);
    if (!has_several_extrema(spec)) continue;
    const Scene<> scene(spec);
    const TrackingSetup<double, OneLayerGrid<double>> setup(scene, 0.05);
    Tracker<OneLayerGrid<double>> tracker(setup);
    for (const double t : {0.0, 0.1, 0.2, 0.7, 3.0}) {
      tracker.advance_to(t);
      for (const std::string& violation : verify(tracker, 1e-12, 1e-9)) ADD_FAILURE() << violation;
      if (!spec.outside_bottom) {
        EXPECT_NEAR(tracker.mass(), scene.mass(), 1e-12);
      }
    }
    checked.count(spec.is_periodic ? "periodic" : spec.outside_bottom ? "open" : "walls");
  }
}

// Two roads: what is between them vanishes as both are refined.
TEST(SeveralExtrema, TrackerAgreesWithGodunov) {
  SceneMaker maker(support::seed_of(8302));
  support::Checked checked({""}, 10);
  double sum_coarse = 0, sum_fine = 0;
  for (int number = 0; number < 16; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const SceneSpec<> spec = random_bed(maker, number % 2 == 0);
    if (!has_several_extrema(spec)) continue;
    const Scene<> scene(spec);
    SolverRequest request{{0.4}, {}};
    request.profiles = true;
    const auto distance = [&](double fineness) {
      const support::OptionNumbers numbers{{"resolution", 0.02 / fineness}, {"cells", 200 * fineness}};
      const SolverResult tracked = solve(scene, support::method_of("front-tracking", numbers), request);
      const SolverResult cells = solve(scene, support::method_of("godunov", numbers), request);
      EXPECT_TRUE(tracked.summary.usable() && cells.summary.usable())
          << tracked.summary.message << cells.summary.message;
      return l1_distance(tracked.profiles.at(0), cells.profiles.at(0));
    };
    const double coarse = distance(1), fine = distance(4);
    EXPECT_LT(coarse, 0.04);
    EXPECT_LT(fine, 0.015);
    sum_coarse += coarse, sum_fine += fine;
    checked.count();
  }
  EXPECT_LT(sum_fine, 0.4 * sum_coarse);  // of first order but for logarithms: 1/4
}

// f = -|sin|-like through (0, 0), (1/4, -1), (1/2, -1/2), (3/4, -1), (1, 0), times 1/4: 1 | 0 in the middle of an endless
// bed is one shock at rest, for the chord of its upper envelope is f = 0; 0 | 1 has the lower envelope through both
// minima, whose chord has the slope 0: a shock at rest between the states 1/4 and 3/4.
TEST(SeveralExtrema, TwoMinimaHoldAShockAtRest) {
  SceneSpec<> spec;
  spec.fluxes = {FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.25, -0.125, -0.25, 0}}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  spec.outside_bottom = OutsideState<double>{{}, {0}};
  spec.outside_top = OutsideState<double>{{}, {1}};
  Tracking bed = track(Scene<>(spec), {.resolution = 0.01});
  bed.advance(0.1);
  const Profile<double> profile = bed.profile();
  EXPECT_EQ(profile.at(0.5 - 1e-9).phi, 0.25);
  EXPECT_EQ(profile.at(0.5 + 1e-9).phi, 0.75);
  spec.initial_values = {1, 0};
  spec.outside_bottom->values = {1}, spec.outside_top->values = {0};
  Tracking still = track(Scene<>(spec), {.resolution = 0.01});
  EXPECT_EQ(still.advance(10), Status::steady);
  EXPECT_EQ(still.summary().collisions, 0U);
}

// A level piece is no rise: such a table is not taken for a monotone one.
TEST(SeveralExtrema, LevelPiecesAreSeen) {
  const FluxTable<double> flat{{0, 0.25, 0.5, 0.75, 1}, {0, -0.25, -0.25, -0.125, 0}};
  EXPECT_EQ(flat.extrema(), (std::vector<double>{0.25, 0.5}));
  SceneSpec<> spec;
  spec.fluxes = {flat};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.375};
  spec.initial_values = {0.125, 0.875};
  const Scene<> scene(spec);
  SolverRequest request{{0.5}, {}};
  request.profiles = true;
  const SolverResult tracked =
      solve(scene, support::method_of("front-tracking", {{"resolution", 0.002}}), request);
  const SolverResult cells = solve(scene, support::method_of("godunov", {{"cells", 4000}}), request);
  ASSERT_TRUE(tracked.summary.usable()) << tracked.summary.message;
  EXPECT_LT(l1_distance(tracked.profiles.at(0), cells.profiles.at(0)), 2e-3);
}

TEST(SeveralExtrema, EventTimesWhereGrainsGoOneWay) {
  SceneSpec<> spec;
  spec.fluxes = {FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.25, -0.125, -0.25, 0}}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  EXPECT_TRUE(track(Scene<>(spec)).timeline());
  spec.fluxes = {FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.25, 0.125, -0.25, 0}}};
  Tracking both_ways = track(Scene<>(spec));
  EXPECT_FALSE(both_ways.timeline());
  EXPECT_EQ(both_ways.summary().status, Status::unsupported);
}

TEST(SeveralExtrema, InLayersTheyAreRefused) {
  SceneSpec<> spec;
  spec.fluxes = {FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.25, -0.125, -0.25, 0}}};
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 2}};
  spec.initial_values = {0.5};
  EXPECT_NE(Tracking::refusal(Scene<>(spec)).find("has several extrema"), std::string::npos);
}

}  // namespace
}  // namespace shearfront
