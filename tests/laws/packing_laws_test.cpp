// SPDX-License-Identifier: BSD-3-Clause
// Beds whose solid fraction c(z) and granular temperature T(z) vary: what front tracking keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "oracles/verify.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/solid_profile.hpp"
#include "shearfront/track/tracker.hpp"
#include "support/random_scene.hpp"
#include "support/solid_scene.hpp"

namespace shearfront {
namespace {

using support::Grains, support::SceneMaker;

/// A profile with values from `least` to `most`, in layers or linear between points.
DepthFunction<double> draw_profile(SceneMaker& maker, double least, double most) {
  const int n = maker.integer(1, 4);
  std::vector<double> heights = maker.heights(n, 0, 1), values;
  for (int i = 0; i <= n + 1; ++i) values.push_back(maker.uniform(least, most));
  if (maker.integer(0, 1) == 0) {
    values.pop_back();
    return Piecewise<double>{heights, values};
  }
  heights.insert(heights.begin(), 0), heights.push_back(1);
  return Table<double>{heights, values};
}

Scene<double> draw_scene(SceneMaker& maker) {
  SceneSpec<double> spec;
  spec.fluxes = {support::flux_of(maker.integer(0, 1) == 0 ? Grains::small : Grains::large)};
  spec.shear_rate = Piecewise<double>{{}, {maker.uniform(0.2, 2)}};
  spec.solid_fraction = draw_profile(maker, 0.3, 0.7);
  spec.temperature = draw_profile(maker, 0.1, 4);
  spec.initial_breaks = maker.heights(2, 0, 1);
  for (int i = 0; i < 3; ++i)
    spec.initial_values.push_back(maker.integer(0, 1) == 0 ? maker.integer(0, 1) : maker.uniform(0, 1));
  return Scene<double>(spec);
}

/// How far phi leaves [0, c] of its layer; 0 if it does not.
template <class AnyTracker>
double overshoot(const AnyTracker& tracker, const LayerStack<double>& stack) {
  const auto snapshot = tracker.snapshot();
  double most = 0;
  for (std::size_t i = 0; i < snapshot.state.size(); ++i) {
    const double phi = tracker.grid().phi(snapshot.layer[i], snapshot.state[i]);
    most = std::max({most, phi - stack.solid_fraction(snapshot.layer[i]), -phi});
  }
  return most;
}

TEST(PackingLaws, NoOvershootAndNoLossOver1000Profiles) {
  SceneMaker maker(support::seed_of(7301));
  for (int number = 0; number < 1000; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw_scene(maker);
    const TrackingSetup<double> setup(scene, staircase(scene, 8), 0.25, GridKind::levels);
    Tracker<LevelGrid<double>> tracker(setup);
    const double mass = tracker.mass();
    EXPECT_NEAR(mass, scene.mass(), 1e-14);
    for (const double t : {0.05, 0.5, 3.0}) {
      tracker.advance_to(t);
      EXPECT_EQ(overshoot(tracker, setup.stack), 0);
      EXPECT_NEAR(tracker.mass(), mass, 1e-13);
      if (number < 100)
        for (const std::string& violation : verify(tracker, 1e-12, 1e-12)) ADD_FAILURE() << violation;
    }
  }
}

// Layers carry x = phi / c; where c is smooth the solution is x c(z), not x times the mean of a layer.
TEST(PackingLaws, SolutionsInASmoothPackingFillItAndKeepTheMass) {
  SceneMaker maker(support::seed_of(7302));
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneSpec<double> spec = draw_scene(maker).spec();
    if (number % 3 == 0) {
      spec.solid_fraction = Exponential<double>{0.7, maker.uniform(0.2, 2)};
    } else {
      spec.solid_fraction = Table<double>{{0, 0.3, maker.uniform(0.4, 1), 1},
                                          {maker.uniform(0.3, 0.7), maker.uniform(0.3, 0.7), 0.5, 0.3}};
    }
    spec.initial_breaks = maker.heights(2, 0, 1);
    const Scene<double> scene(spec);
    SolverRequest request{{0.05, 0.5, infinity<double>()}, {0, 0.2, 0.71, 1}};
    request.profiles = true;
    const FrontTrackingSolver::Options options{.resolution = 0.1};
    const SolverResult result = solve<FrontTrackingSolver>(scene, request, options);
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    for (const Profile<double>& profile : result.profiles) {
      EXPECT_LE(support::overshoot(scene, profile), 0);
      EXPECT_NEAR(profile.mass(), scene.mass(), 1e-14);
      EXPECT_TRUE(std::is_sorted(profile.z().begin(), profile.z().end()));
      for (const double phi : profile.below()) EXPECT_GE(phi, 0);
    }
    if (number % 3 != 0) {  // an exponential is not quite its chords
      EXPECT_NEAR(mixing(scene, result.profiles[2]).parameter, 0, 1e-12);
    }
    EXPECT_NEAR(result.samples.back().M, scene.mass(), 1e-14);
  }
}

// M is that of the staircase at its interfaces and of second order in its layers between.
TEST(PackingLaws, MassBelowAFrontIsThatOfItsLayers) {
  SceneMaker maker(support::seed_of(7303));
  for (int number = 0; number < 40; ++number) {
    SceneSpec<double> spec = draw_scene(maker).spec();
    spec.solid_fraction = Table<double>{{0, 1}, {maker.uniform(0.3, 0.7), maker.uniform(0.3, 0.7)}};
    const Scene<double> scene(spec);
    const TrackingSetup<double> setup(scene, staircase(scene, 8), 0.25, GridKind::levels);
    Tracker<LevelGrid<double>> tracker(setup);
    tracker.advance_to(0.3);
    const Profile<double> layers = tracker.profile(), smooth = solid_profile(tracker, scene, setup.stack);
    ASSERT_EQ(layers.n_cells(), smooth.n_cells());
    for (std::size_t i = 0; i < layers.z().size(); ++i) {
      EXPECT_NEAR(smooth.cumulative()[i], layers.cumulative()[i], 1e-14);
      // At most c' h / c / 8 of a layer h = 1/8 high, |c'| < 0.4 and c > 0.3.
      EXPECT_NEAR(smooth.z()[i], layers.z()[i], 0.4 / 0.3 / 8 / 64);
    }
  }
}

// With x = phi / c constant c and T only change the unit of time: x(z, t) of rate S sqrt(T).
TEST(PackingLaws, ConstantPackingAndTemperatureAreTheQuadraticFlux) {
  for (const Grains grains : {Grains::small, Grains::large}) {
    SceneSpec<double> spec;
    spec.fluxes = {support::flux_of(grains)};
    spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
    spec.solid_fraction = Piecewise<double>{{}, {0.64}};
    spec.temperature = Piecewise<double>{{}, {4}};
    spec.initial_breaks = {0.5};
    spec.initial_values = {0, 1};
    SceneSpec<double> plain = spec;
    plain.fluxes = {Quadratic<double>{}};
    plain.solid_fraction.reset(), plain.temperature.reset();
    if (grains == Grains::large) plain.initial_values = {1, 0};  // of the small grains between the large ones
    const TrackingSetup<double> setup(Scene<double>(spec), 0.01), other(Scene<double>(plain), 0.01);
    Tracker<LevelGrid<double>> packed(setup), quadratic(other);
    for (const double t : {0.1, 0.7, 2.0}) {
      packed.advance_to(t), quadratic.advance_to(2 * t);
      const Profile<double> a = packed.profile(), b = quadratic.profile();
      for (int i = 0; i < 200; ++i) {
        const double z = (i + 0.37) / 200, x = a.at(z).phi / 0.64;
        EXPECT_NEAR(grains == Grains::small ? x : 1 - x, b.at(z).phi, 1e-14) << z << " " << t;
      }
    }
  }
}

}  // namespace
}  // namespace shearfront
