// SPDX-License-Identifier: BSD-3-Clause
// First arrivals in layered beds by front tracking are those of the exact solution, however coarse the grid of states.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/track.hpp"
#include "support/random_scene.hpp"
#include "support/source_examples.hpp"

namespace shearfront {
namespace {

/// Layers of a, some with a flux that is no parabola, some with layers of c; pure states and others.
SceneSpec<double> random_layered_arrivals(std::uint64_t seed) {
  support::SceneMaker maker(support::seed_of(seed));
  SceneSpec<double> spec;
  Piecewise<double> rate{maker.heights(maker.integer(1, 6), 0, 1), {}};
  for (std::size_t i = 0; i <= rate.breaks.size(); ++i) rate.values.push_back(maker.uniform(0.2, 4));
  spec.shear_rate = rate;
  if (seed % 2 == 0) {
    spec.initial_breaks = maker.heights(1, 0.1, 0.9);
    spec.initial_values = {0, 1};
  } else {
    spec.initial_breaks = maker.heights(maker.integer(1, 4), 0, 1);
    for (std::size_t i = 0; i <= spec.initial_breaks.size(); ++i) {
      const int kind = maker.integer(0, 2);
      spec.initial_values.push_back(kind < 2 ? kind : maker.uniform(0, 1));
    }
  }
  if (seed % 3 == 1) spec.fluxes = {Cubic<double>{maker.uniform(0.01, 0.5)}};
  if (seed % 5 == 2) spec.solid_fraction = Piecewise<double>{maker.heights(1, 0.2, 0.8), {0.6, 0.5}};
  return spec;
}

TEST(FirstArrivals, AreExactInLayersAtEveryResolution) {
  int n = 0;
  double lateness = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Scene<double> scene(random_layered_arrivals(seed));
    const Timeline<double> exact = exact_timeline(scene),
                           tracked = *Tracking(scene, {.resolution = 0.1}).timeline(),
                           late = *Tracking(scene, {.resolution = 0.1, .edges = FanEdges::secant}).timeline();
    const auto same = [&](const std::optional<double>& t, const std::optional<double>& wanted,
                          const std::optional<double>& of_polygon) {
      ASSERT_EQ(t.has_value(), wanted.has_value()) << seed;
      if (!t) return;
      EXPECT_NEAR(*t, *wanted, 1e-13 * *exact.t_star) << seed;
      EXPECT_GE(*of_polygon, *t) << seed;
      lateness += (*of_polygon - *t) / *exact.t_star;
      ++n;
    };
    same(tracked.t0, exact.t0, late.t0);
    same(tracked.t1, exact.t1, late.t1);
    ASSERT_EQ(tracked.interfaces.size(), exact.interfaces.size()) << seed;
    for (std::size_t k = 0; k < exact.interfaces.size(); ++k)
      same(tracked.interfaces[k].first, exact.interfaces[k].first, late.interfaces[k].first);
  }
  EXPECT_GE(n, 400);
  EXPECT_GE(lateness / n, 2e-3);  // what the polygon alone would have
}

// A fan of the polygon is late by its resolution; that of the grid of the source paper too, which has other rates.
TEST(FirstArrivals, SecantsAreLate) {
  const Scene<double> scene = support::example_1();
  const Timeline<double> exact = exact_timeline(scene);
  for (const GridKind grid : {GridKind::levels, GridKind::singular_mapping}) {
    const auto t_c = [&](FanEdges edges) {
      return *Tracking(scene, {.resolution = 0.04, .grid = grid, .edges = edges})
                  .timeline()
                  ->interfaces[0]
                  .first;
    };
    if (grid == GridKind::levels)
      EXPECT_NEAR(t_c(FanEdges::characteristic), *exact.interfaces[0].first, 1e-14);
    EXPECT_GE(t_c(FanEdges::secant), t_c(FanEdges::characteristic) * 1.02);
  }
}

}  // namespace
}  // namespace shearfront
