// SPDX-License-Identifier: BSD-3-Clause
// Riemann problems inside layers and at interfaces against brute force that knows only the theorems.
#include "shearfront/riemann/in_layer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "oracles/polygon_stack.hpp"
#include "shearfront/riemann/interface.hpp"
#include "shearfront/track/level_grid.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// A random polygon on [0, 1] with f(0) = f(1) = 0: any shape.
Polygon<double> random_polygon(SceneMaker& maker, int n) {
  Polygon<double> p;
  for (int i = 0; i <= n; ++i) {
    p.phi.push_back(static_cast<double>(i) / n);
    p.flux.push_back(i == 0 || i == n ? 0.0 : maker.uniform(-1, 1));
  }
  return p;
}

std::vector<std::pair<State, State>> fronts(const PolygonStack<double>& grid, State l, State r) {
  std::vector<std::pair<State, State>> result;
  solve_in_layer(grid, 0, l, r, [&](State a, State b) { result.emplace_back(a, b); });
  return result;
}

TEST(InLayer, FollowsTheEnvelopeOfAnyPolygon) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SceneMaker maker(support::seed_of(seed));
    const PolygonStack<double> grid({0, 1}, {random_polygon(maker, maker.integer(2, 12))});
    const State n = grid.n_states(0);
    const State l = maker.integer(0, n - 1), r = maker.integer(0, n - 1);
    const auto waves = fronts(grid, l, r);
    if (l == r) {
      EXPECT_TRUE(waves.empty());
      continue;
    }
    ASSERT_FALSE(waves.empty());
    EXPECT_EQ(waves.front().first, l);
    EXPECT_EQ(waves.back().second, r);
    double last = -1e300;
    const int side = l < r ? 1 : -1;
    for (std::size_t i = 0; i < waves.size(); ++i) {
      const auto [a, b] = waves[i];
      if (i > 0) {
        EXPECT_EQ(waves[i - 1].second, a);
      }
      const double speed = (grid.flux(0, b) - grid.flux(0, a)) / (grid.phi(0, b) - grid.phi(0, a));
      EXPECT_NEAR(grid.speed(0, a, b), speed, 1e-12);
      EXPECT_GT(grid.speed(0, a, b), last) << "seed " << seed;
      last = grid.speed(0, a, b);
      // The chord lies below (l < r) or above (l > r) the graph between its ends.
      for (State s = std::min(a, b); s <= std::max(a, b); ++s) {
        const double chord = grid.flux(0, a) + speed * (grid.phi(0, s) - grid.phi(0, a));
        EXPECT_GE(side * (grid.flux(0, s) - chord), -1e-12) << "seed " << seed;
      }
    }
  }
}

// All states the two envelopes can reach, from the definition: for l the fluxes F for which l | u has only
// waves of speed
// <= 0, for r those for which u | r has only waves of speed >= 0.
struct Reach {
  std::vector<State> below, above;
};
template <class Grid>
Reach reach(const Grid& grid, State l, State r) {
  Reach result;
  for (State u = 0; u < grid.n_states(0); ++u) {
    bool ok = true;
    solve_in_layer(grid, 0, l, u, [&](State a, State b) { ok = ok && grid.speed(0, a, b) <= 0; });
    if (ok) result.below.push_back(u);
  }
  for (State u = 0; u < grid.n_states(1); ++u) {
    bool ok = true;
    solve_in_layer(grid, 1, u, r, [&](State a, State b) { ok = ok && grid.speed(1, a, b) >= 0; });
    if (ok) result.above.push_back(u);
  }
  return result;
}

TEST(Interface, ConvexFluxesEveryPairOfStates) {
  for (const double a_below : {2.4, 0.31, 1.0})
    for (const double a_above : {0.31, 2.4, 1.0}) {
      const LayerStack<double> stack({0, 0.5, 1}, {a_below, a_above}, 1.0, {true});
      const auto grid = LevelGrid<double>::exact_levels(stack, 0.11, {{0, 0.3}, {1, 0.77}}).grid;
      for (State l = 0; l < grid.n_states(0); ++l)
        for (State r = 0; r < grid.n_states(1); ++r) {
          const StatePair s = solve_interface(grid, 0, l, r);
          // One flux on both sides, reached by waves that leave the interface.
          ASSERT_EQ(grid.flux_rank(0, s.below), grid.flux_rank(1, s.above));
          const Reach can = reach(grid, l, r);
          ASSERT_TRUE(std::binary_search(can.below.begin(), can.below.end(), s.below));
          ASSERT_TRUE(std::binary_search(can.above.begin(), can.above.end(), s.above));
          // Supply and demand: F* = max of the one-sided minima.
          const auto f = [](double a, double phi) { return a * phi * (phi - 1); };
          const double expected =
              std::max(f(a_below, std::max(grid.phi(0, l), 0.5)), f(a_above, std::min(grid.phi(1, r), 0.5)));
          ASSERT_NEAR(grid.flux(0, s.below), expected, 1e-15);
          // Minimal jump: no state of that flux on the envelope is nearer to l, none nearer to r.
          for (const State u : can.below) {
            if (grid.flux_rank(0, u) == grid.flux_rank(0, s.below)) {
              ASSERT_LE(std::abs(s.below - l), std::abs(u - l));
            }
          }
          for (const State u : can.above) {
            if (grid.flux_rank(1, u) == grid.flux_rank(1, s.above)) {
              ASSERT_LE(std::abs(s.above - r), std::abs(u - r));
            }
          }
          // At rest means at rest: the outcome is its own solution.
          ASSERT_EQ(solve_interface(grid, 0, s.below, s.above), s);
        }
    }
}

TEST(Interface, CrossingOfEnvelopesEqualsSupplyAndDemand) {
  // The general algorithm on the same polygons: a second road to every outcome.
  const LayerStack<double> stack({0, 0.5, 1}, {2.4, 0.31}, 1.0, {true});
  const auto grid = LevelGrid<double>::exact_levels(stack, 0.07, {{0, 0.3}}).grid;
  std::vector<Polygon<double>> polygons(2);
  for (std::size_t k = 0; k < 2; ++k)
    for (State i = 0; i < grid.n_states(k); ++i) {
      polygons[k].phi.push_back(grid.phi(k, i));
      polygons[k].flux.push_back(grid.flux(k, i));
    }
  const PolygonStack<double> general({0, 0.5, 1}, polygons);
  ASSERT_EQ(general.n_states(0), grid.n_states(0));
  ASSERT_EQ(general.n_states(1), grid.n_states(1));
  for (State l = 0; l < grid.n_states(0); ++l)
    for (State r = 0; r < grid.n_states(1); ++r)
      ASSERT_EQ(solve_interface(grid, 0, l, r), solve_interface(general, 0, l, r)) << l << " | " << r;
  for (State i = 0; i < grid.n_states(0); ++i)
    ASSERT_EQ(solve_bottom_wall(grid, i), solve_bottom_wall(general, i));
  for (State i = 0; i < grid.n_states(1); ++i) ASSERT_EQ(solve_top_wall(grid, i), solve_top_wall(general, i));
}

TEST(Interface, ConcaveFluxesMirrorConvexOnes) {
  // phi -> flux negated and turned upside down is the same problem (traffic): f_concave = -f, layers
  // exchanged.
  Polygon<double> slow, fast;
  for (int i = 0; i <= 20; ++i) {
    const double phi = i / 20.0;
    slow.phi.push_back(phi), fast.phi.push_back(phi);
    slow.flux.push_back(phi * (1 - phi)), fast.flux.push_back(2 * phi * (1 - phi));
  }
  Polygon<double> slow_convex = slow, fast_convex = fast;
  for (double& f : slow_convex.flux) f = -f;
  for (double& f : fast_convex.flux) f = -f;
  const PolygonStack<double> concave({0, 0.5, 1}, {fast, slow}),
      convex({0, 0.5, 1}, {slow_convex, fast_convex});
  for (State l = 0; l < concave.n_states(0); ++l)
    for (State r = 0; r < concave.n_states(1); ++r) {
      const StatePair a = solve_interface(concave, 0, l, r), b = solve_interface(convex, 0, r, l);
      ASSERT_EQ(a.below, b.above);
      ASSERT_EQ(a.above, b.below);
    }
}

}  // namespace
}  // namespace shearfront
