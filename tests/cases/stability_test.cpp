// SPDX-License-Identifier: BSD-3-Clause
// Double against 50 digits in every hard case of docs/evidence/stability.md: the same collisions in the same order,
// and no more digits lost than the rounding of the scene's own numbers explains. Moving these numbers by
// their rounding in 50 digits shows how much that is; a factor of 100 (two digits) is allowed on top, because
// the roundings of a run are many and a few random moves do not find the worst direction.
#include <gtest/gtest.h>

#include <algorithm>

#include "shearfront/digits/real110.hpp"
#include "support/checked.hpp"
#include "support/hard_points.hpp"
#include "support/side_by_side.hpp"

namespace shearfront {
namespace {

using support::Differences;
using support::ExactDifferences;
using support::ExactRun;
using support::HardCase;
using support::HardPoints;

constexpr double kTwoDigits = 100;
constexpr double kRounding = 0x1p-53;

void expect_explained(double error, double moved, const char* what, double rounding = kRounding) {
  EXPECT_LE(error, kTwoDigits * std::max(rounding, moved)) << what << ", by the data " << moved;
}

void expect_explained(const Differences& error, const Differences& moved, double rounding = kRounding) {
  EXPECT_EQ(error.unmatched, 0u);
  // Two collisions can change places only if their times agree up to the errors of both.
  EXPECT_LE(error.displaced_by, 2 * std::max(error.time, kRounding));
  expect_explained(error.time, moved.time, "times", rounding);
  expect_explained(error.place, moved.place, "places", rounding);
  expect_explained(error.position, moved.position, "fronts", rounding);
  expect_explained(error.M, moved.M, "M", rounding);
  expect_explained(error.t_star, moved.t_star, "t*", rounding);
}

void expect_explained(const ExactDifferences& error, const ExactDifferences& moved) {
  EXPECT_EQ(error.other_time, 0u);
  expect_explained(error.M, 0, "M");
  expect_explained(error.phi, moved.phi, "phi");
  expect_explained(error.H, moved.H, "H");
  expect_explained(error.first, moved.first, "first times");
  expect_explained(error.last, moved.last, "last times");
  expect_explained(error.dM, moved.dM, "derivatives of M");
  expect_explained(error.dphi, moved.dphi, "derivatives of phi");
}

void check(const Scene<double>& scene, double resolution, const std::vector<double>& times, int n_moves,
           double rounding = kRounding) {
  const auto oracle = support::run(scene_cast<Real110>(scene), resolution, times);
  Differences moved;
  for (int i = 1; i <= n_moves; ++i)
    moved.add(compare(
        support::run(support::perturbed(scene, static_cast<std::uint64_t>(i)), resolution, times), oracle));
  expect_explained(compare(support::run(scene, resolution, times), oracle), moved, rounding);
}

void check(const Scene<double>& scene, const std::vector<support::Point>& points, bool with_timeline,
           int n_moves) {
  const ExactRun<Real110> oracle(scene_cast<Real110>(scene), points, with_timeline);
  ExactDifferences moved;
  for (int i = 1; i <= n_moves; ++i)
    moved.add(compare(
        ExactRun<Real110>(support::perturbed(scene, static_cast<std::uint64_t>(i)), points, with_timeline),
        oracle));
  expect_explained(compare(ExactRun<double>(scene, points, with_timeline), oracle), moved);
}

TEST(Stability, TrackerKeepsItsDigitsInHardCases) {
  for (const HardCase& c : support::hard_cases()) {
    SCOPED_TRACE(c.name);
    check(c.scene, c.resolution, c.times, std::min(c.n_moves, 2), c.rounding);
  }
}

/// Beds of so many layers take a tenth of a second per point in 110 digits: a slow test looks at all of their points,
/// the quick one at every fifth.
bool has_many_layers(const HardPoints& c) { return c.scene.knots().size() > 100; }

TEST(Stability, ExactEngineKeepsItsDigitsInHardCases) {
  for (const HardPoints& c : support::hard_points()) {
    SCOPED_TRACE(c.name);
    std::vector<support::Point> points;
    for (std::size_t i = 0; i < c.points.size(); i += has_many_layers(c) ? 5 : 1)
      points.push_back(c.points[i]);
    check(c.scene, points, c.with_timeline, std::min(c.n_moves, 2));
  }
}

TEST(SlowStability, ExactEngineInAThousandLayers) {
  support::Checked checked;
  for (const HardPoints& c : support::hard_points()) {
    if (!has_many_layers(c)) continue;
    SCOPED_TRACE(c.name);
    check(c.scene, c.points, c.with_timeline, c.n_moves);
    checked.count();
  }
}

TEST(Stability, TrackerKeepsItsDigitsInRandomScenes) {
  for (std::uint64_t n = 0; n < 200; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    check(support::random_scene(n), 0.1, {support::random_time(n)}, 2);
  }
}

TEST(Stability, ExactEngineKeepsItsDigitsInRandomScenes) {
  for (std::uint64_t n = 0; n < 60; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    const Scene<double> scene = support::random_scene(n);
    check(scene, support::random_points(scene, 5, n), true, 3);
  }
}

// A front that absorbs the fronts of a fan one by one must not collect their roundings.
TEST(Stability, ErrorsDoNotGrowWithTheNumberOfCollisions) {
  const Scene<double> scene = support::shear_cell();
  for (const double resolution : {1e-2, 1e-3, 1e-4}) {
    const auto error = compare(support::run(scene, resolution, {0.5, 6}),
                               support::run(scene_cast<Real110>(scene), resolution, {0.5, 6}));
    EXPECT_LE(error.t_star, 4 * kRounding) << resolution;
    EXPECT_LE(error.M, 4 * kRounding) << resolution;
    EXPECT_LE(error.position, 8 * kRounding) << resolution;
  }
}

// Speeds that agree to 15 digits: the meeting comes out to all 16.
TEST(Stability, NearlyParallelFrontsMeetWhereTheyShould) {
  const Scene<double> scene = support::nearly_parallel_fronts();
  const auto error = compare(support::run(scene, 1, {1}), support::run(scene_cast<Real110>(scene), 1, {1}));
  EXPECT_EQ(error.unmatched, 0u);
  EXPECT_LE(error.time, 8 * kRounding);
}

TEST(SlowStability, TrackerInTenThousandLayers) { check(support::many_layers(10000, 12), 0.25, {0.03}, 1); }

TEST(SlowStability, TrackerAtResolution1em5) {
  const Scene<double> scene = support::shear_cell();
  check(scene, 1e-5, {0.5, 6}, 0);
}

TEST(SlowStability, TrackerWithTenThousandJumps) {
  check(support::many_jumps(10000, 13), 0.1, {1e-3, 0.1}, 1);
}

TEST(SlowStability, TrackerInThousandsOfRandomScenes) {
  for (std::uint64_t n = 200; n < 1800; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    check(support::random_scene(n), 0.1, {support::random_time(n)}, 2);
  }
}

TEST(SlowStability, ExactEngineInHundredsOfRandomScenes) {
  for (std::uint64_t n = 60; n < 400; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    const Scene<double> scene = support::random_scene(n);
    check(scene, support::random_points(scene, 5, n), true, 3);
  }
}

}  // namespace
}  // namespace shearfront
