// SPDX-License-Identifier: BSD-3-Clause
// Where the minimising path begins to be of another kind, both kinds are the path up to rounding. The kind of fault: each kind
// ended, by rounding, one double before the other began, and at that double M was that of a third: 0.347 instead of 0.327. Or at a place
// of another kind begins what is no path at all, one that rests at a throat behind a jump that it cannot pass: M 3e-3 off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "support/checked.hpp"
#include "support/curved_scenes.hpp"
#include "support/refinement_scenes.hpp"

namespace shearfront {
namespace {

/// Whether M is continuous at the `n` doubles on both sides of z.
void expect_no_gap(const ExactSolution<double>& exact, double z, double t, int n) {
  double at = z;
  for (int i = 0; i < n; ++i) at = std::nextafter(at, 0);
  double before = exact.M(at, t);
  for (int i = 0; i < 2 * n; ++i) {
    at = std::nextafter(at, 1);
    const double M = exact.M(at, t);
    EXPECT_NEAR(M, before, 1e-13) << "z " << number_text(at) << ", t " << number_text(t);
    before = M;
  }
}

void check_changes(support::SceneKind kind, int n_scenes) {
  support::Checked checked;
  for (int number = 0; number < n_scenes; ++number) {
    const std::uint64_t seed = support::seed_of(9100 + static_cast<std::uint64_t>(number));
    SCOPED_TRACE(std::string(kind.name) + ", seed " + std::to_string(seed));
    support::SceneMaker make(seed);
    const Scene<double> scene(kind.draw(make));
    const ExactSolution<double> exact(scene);
    make.uniform(0, 1);
    const double t = make.uniform(0.7, 2);
    constexpr int kParts = 48;
    for (int i = 0; i < kParts; ++i) {
      double lo = static_cast<double>(i) / kParts, hi = static_cast<double>(i + 1) / kParts;
      const auto family = [&](double z) {
        const auto path = exact.path(z, t);
        return std::tuple(path.kind, path.upward, path.source, path.turned, path.interface);
      };
      const auto below = family(lo);
      if (below == family(hi)) continue;
      while (std::nextafter(lo, hi) < hi) {
        const double middle = lo + (hi - lo) / 2;
        (family(middle) == below ? lo : hi) = middle;
      }
      expect_no_gap(exact, hi, t, 12);
      checked.count();
    }
  }
}

/// From 3 to 60 points between which a(z) changes little, falling for most of the way up or down, with jumps.
SceneSpec<double> many_points(support::SceneMaker& make) {
  SceneSpec<double> spec =
      support::random_curved_spec(support::seed_of(static_cast<std::uint64_t>(make.integer(0, 1 << 30))));
  double value = std::exp(make.uniform(-1, 1));
  Table<double> table{{0}, {value}};
  const auto add = [&](double z) {
    value *= std::exp(make.uniform(-0.3, 0.1));
    table.z.push_back(z);
    table.values.push_back(value);
  };
  for (const double z : make.heights(make.integer(3, 60), 0, 1)) {
    add(z);
    if (make.integer(0, 15) == 0) add(z);
  }
  add(1);
  if (make.integer(0, 1) == 0) std::reverse(table.values.begin(), table.values.end());
  spec.shear_rate = std::move(table);
  return spec;
}
SceneSpec<double> many_points_and_a_cubic(support::SceneMaker& make) {
  SceneSpec<double> spec = many_points(make);
  spec.fluxes = {Cubic<double>{make.uniform(0.05, 0.5)}};
  for (double& value : spec.initial_values)
    if (value == 0.5) value = spec.fluxes.front().extrema().front();
  return spec;
}
SceneSpec<double> any_flux(support::SceneMaker& make) {
  return support::random_curved_flux_spec(
      support::seed_of(static_cast<std::uint64_t>(make.integer(0, 1 << 30))));
}

TEST(ExactPathChanges, LeaveNoGapInTables) {
  check_changes({"many points", many_points}, 150);
  check_changes({"many points, a cubic flux", many_points_and_a_cubic}, 60);
  check_changes({"any flux", any_flux}, 150);
}
TEST(ExactPathChanges, LeaveNoGapInAThroat) {
  check_changes({"chute", support::kinds::chute}, 150);
  check_changes({"throat", support::kinds::throat}, 150);
}
TEST(ExactPathChanges, LeaveNoGapInLayers) {
  check_changes({"layers", support::kinds::layers}, 150);
  check_changes({"jumps of everything", support::kinds::jumps_of_everything}, 150);
}

}  // namespace
}  // namespace shearfront
