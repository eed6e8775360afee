// SPDX-License-Identifier: BSD-3-Clause
// The general engine: fluxes that are neither convex nor concave, against a Godunov scheme that shares
// nothing with it.
#include <gtest/gtest.h>

#include <cmath>

#include "oracles/polygon_stack.hpp"
#include "oracles/verify.hpp"
#include "shearfront/track/tracker.hpp"
#include "support/checked.hpp"
#include "support/godunov.hpp"

namespace shearfront {
namespace {

// Asymmetric segregation, non-convex for gamma > 1/2 (Gajjar & Gray 2014).
double cubic(double phi) { return -phi * (1 - phi) * (1 - 0.9 * phi); }

Polygon<double> polygon_of(double rate, int n) {
  Polygon<double> p;
  for (int i = 0; i <= n; ++i) {
    const double phi = static_cast<double>(i) / n;
    p.phi.push_back(phi);
    p.flux.push_back(i == 0 || i == n ? 0.0 : rate * cubic(phi));
  }
  return p;
}

double l1_to_cells(const Profile<double>& profile, const std::vector<double>& u) {
  std::vector<double> z;
  for (std::size_t j = 0; j <= u.size(); ++j)
    z.push_back(static_cast<double>(j) / static_cast<double>(u.size()));
  return l1_distance(profile, Profile<double>(z, u, u));
}

TEST(NonConvex, OneLayerAgainstGodunov) {
  const PolygonStack<double> grid({0, 1}, {polygon_of(1, 200)});
  Tracker<PolygonStack<double>> tracker(grid, {{0, 0.5, 0}, {0, 1, grid.nearest(0, 1)}}, Ends<double>{});
  const double mass = tracker.mass();
  for (const double t : {0.2, 0.6}) {
    tracker.advance_to(t);
    EXPECT_EQ(verify(tracker, 1e-13, 1e-10), std::vector<std::string>{});
    EXPECT_NEAR(tracker.mass(), mass, 1e-13);
    const auto initial = [](double z) { return z < 0.5 ? 0.0 : 1.0; };
    const double coarse =
        l1_to_cells(tracker.profile(), support::godunov_any_flux(cubic, 1, initial, t, 250));
    const double fine = l1_to_cells(tracker.profile(), support::godunov_any_flux(cubic, 1, initial, t, 1000));
    EXPECT_LE(fine, 0.012);
    EXPECT_LE(fine, 0.5 * coarse);
  }
  EXPECT_EQ(tracker.run_to_steady(), Status::steady);
  EXPECT_NEAR(tracker.mass(), mass, 1e-13);
}

TEST(NonConvex, CompoundWaveOfARiemannProblem) {
  // 0 | 1 for gamma = 0.9: a fan from 0 up to the tangent point phi*, f'(phi*) = f(phi*) / (phi* - 1), then a
  // shock to 1. With f = -phi (1 - phi)(1 - g phi) that is 2 g phi^2 - (1 + g) phi ... solved below by
  // bisection.
  const auto f_prime = [](double p) { return -(1 - 2 * (1 + 0.9) * p + 3 * 0.9 * p * p); };
  double lo = 0.3, hi = 0.95;
  for (int i = 0; i < 100; ++i) {
    const double mid = (lo + hi) / 2;
    (f_prime(mid) - cubic(mid) / (mid - 1) < 0 ? lo : hi) = mid;
  }
  const int n = 400;
  const PolygonStack<double> grid({0, 1}, {polygon_of(1, n)});
  Tracker<PolygonStack<double>> tracker(grid, {{0, 0.6, 0}, {0, 1, grid.nearest(0, 1)}}, Ends<double>{});
  tracker.advance_to(0.1);
  double largest_jump = 0, at = 0, below = 0;
  const Profile<double> profile = tracker.profile();
  for (std::size_t i = 1; i < profile.n_cells(); ++i)
    if (const double jump = profile.below()[i] - profile.below()[i - 1]; jump > largest_jump)
      largest_jump = jump, at = profile.z()[i], below = profile.below()[i - 1];
  EXPECT_NEAR(below, lo, 2.0 / n);
  EXPECT_NEAR(at, 0.6 + 0.1 * f_prime(lo), 1e-3);
}

TEST(NonConvex, TwoLayersKeepEveryGuarantee) {
  const PolygonStack<double> grid({0, 0.4, 1}, {polygon_of(2.4, 60), polygon_of(0.31, 60)});
  Tracker<PolygonStack<double>> tracker(
      grid, {{0, 0.4, 0}, {1, 0.5, 0}, {1, 0.8, grid.nearest(1, 1)}, {1, 1, grid.nearest(1, 0.25)}},
      Ends<double>{});
  const double mass = tracker.mass();
  support::Checked checked({""}, 10);
  while (tracker.step()) {
    checked.count();
    ASSERT_EQ(verify(tracker, 1e-13, 1e-10), std::vector<std::string>{});
    ASSERT_NEAR(tracker.mass(), mass, 1e-13);
  }
  const Profile<double> steady = tracker.profile();
  EXPECT_NEAR(steady.at(mass - 1e-9).phi, 1, 0);
  EXPECT_NEAR(steady.at(mass + 1e-9).phi, 0, 0);
}

}  // namespace
}  // namespace shearfront
