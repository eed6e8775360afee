// SPDX-License-Identifier: BSD-3-Clause
// Where the minimising path begins to be of another kind, both kinds are the path up to rounding. The kind of fault: each kind
// ended, by rounding, one double before the other began, and at that double M was that of a third: 0.347 instead of 0.327.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "support/checked.hpp"
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
        return std::tuple(path.kind, path.upward, path.source, path.turned);
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
