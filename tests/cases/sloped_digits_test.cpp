// SPDX-License-Identifier: BSD-3-Clause
// Pieces whose rate is nearly constant, or falls by many orders, against 110 digits. The kind of fault: a sum of terms that
// have a pole where the slope is 0 or where r = 4 H, and a rate as its value at an end less nearly all of it. Each is right
// on paper. Derivatives are compared with the largest of the same point, so a few units of rounding are all there may be:
// of the closed forms none loses more, whatever the slope.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "support/checked.hpp"
#include "support/hard_points.hpp"

namespace shearfront {
namespace {

using support::ExactDifferences;
using support::ExactRun;

/// The points include the jump itself, where paths of a fan turn next to their start.
void expect_all_digits(const DepthFunction<double>& a, const std::vector<double>& times, int n_moves) {
  SceneSpec<double> spec;
  spec.shear_rate = a;
  ExactDifferences worst, moved;
  for (const auto& [jumps, states] :
       {std::pair(std::vector<double>{0.5}, std::vector<double>{0, 1}),
        std::pair(std::vector<double>{0.25, 0.625}, std::vector<double>{0.7, 0.2, 0.6})}) {
    spec.initial_breaks = jumps;
    spec.initial_values = states;
    const Scene<double> scene(spec);
    const auto points = support::points_at(times);
    const ExactRun<Real110> oracle(scene_cast<Real110>(scene), points, false);
    worst.add(compare(ExactRun<double>(scene, points, false), oracle));
    for (int i = 1; i <= n_moves; ++i)
      moved.add(
          compare(ExactRun<Real110>(support::perturbed(scene, static_cast<std::uint64_t>(i)), points, false),
                  oracle));
  }
  EXPECT_LE(worst.other_path, 2u);  // within rounding of a shock
  const double u = 0x1p-53;
  EXPECT_LE(worst.M, 8 * u);
  // At the edge of a fan they change with the rounding of the scene by more than their own.
  EXPECT_LE(worst.phi, 64 * std::max(u, moved.phi));
  EXPECT_LE(worst.H, 64 * std::max(u, moved.H));
  EXPECT_LE(worst.dM, 64 * u);
  EXPECT_LE(worst.dphi, 64 * u);
}

TEST(SlopedDigits, NearlyConstantPiecesLoseNone) {
  const std::vector<double> times{0.1, 1};
  for (const double part : {1e-3, 1e-9, 1e-12}) {
    SCOPED_TRACE(part);
    expect_all_digits(Table<double>{{0, 1}, {1, 1 - part}}, times, 0);
    expect_all_digits(Table<double>{{0, 1}, {1 - part, 1}}, times, 0);
    expect_all_digits(Exponential<double>{1, 1 / part}, times, 0);
    expect_all_digits(Chute<double>{1, 1 / part, 0}, times, 0);  // rises in all of the bed
  }
}

TEST(SlopedDigits, SteepPiecesLoseNone) {
  expect_all_digits(Table<double>{{0, 1}, {1, 1e-14}}, {0.1, 2, 20}, 1);
  for (const double decay : {0.1, 0.01}) {
    SCOPED_TRACE(decay);
    const double slow = std::exp(0.5 / decay);  // about 1 / a next to the jump
    expect_all_digits(Exponential<double>{1, decay}, {0.1 * slow, 30 * slow}, 1);
    expect_all_digits(Chute<double>{1 / slow, decay, 0}, {0.1, 30}, 1);
  }
}

/// Both ends of a piece that happens to be flat are numbers of the bed: phi at the place of the jump changes with its slope
/// by t / 8, for logit p rises by b t there and p starts at 1/2 - b t / 8. (It was 0.)
TEST(SlopedDigits, AFlatPieceHasAllDerivatives) {
  SceneSpec<double> spec;
  spec.shear_rate = Table<double>{{0, 1}, {1, 1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const ExactSolution<double> solution{Scene<double>(spec)};
  const Derivatives<double> derivatives(solution);
  const auto named = entries(solution.scene().spec());
  const auto at = derivatives.at(0.5, 0.4);
  support::Checked checked;
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (named[i].field != "shear_rate.values") continue;
    EXPECT_NEAR(at.phi[i], named[i].index == 0 ? -0.05 : 0.05, 1e-15);
    EXPECT_NEAR(at.M[i], 0.05, 1e-15);
    checked.count();
  }
}

}  // namespace
}  // namespace shearfront
