// SPDX-License-Identifier: BSD-3-Clause
// What must hold for curved fronts in any bed: mass, order, range, restart, symmetry, an end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/track/curved_field.hpp"
#include "shearfront/track/curved_reconstruct.hpp"
#include "shearfront/track/track.hpp"
#include "shearfront/track/tracker.hpp"
#include "support/curved_scenes.hpp"

namespace shearfront {
namespace {

using CurvedTracker = Tracker<LevelCurves, NoObserver, CurvedSystem<NoObserver>>;

constexpr double kMassSlack = 1e-12;  // heights are 1
constexpr std::uint64_t kMostEvents = 200'000;

/// A bed under way with all that its laws need to be seen.
struct CurvedRun {
  Scene<double> scene;
  std::shared_ptr<const CurvedBed> bed;
  CurvedTracker tracker;
  double unit_time;

  CurvedRun(const SceneSpec<double>& spec, double resolution)
      : scene(spec),
        bed(make(scene, resolution)),
        tracker(CurvedSystem<NoObserver>(bed->grid, bed->scene.problem, {}, SIZE_MAX)) {
    double rate = 0;
    for (const RatePiece& piece : bed->scene.problem.pieces) rate = std::max({rate, piece.low, piece.high});
    unit_time = 1 / rate;
  }
  static std::shared_ptr<const CurvedBed> make(const Scene<double>& scene, double resolution) {
    CurvedScene curved = curved_scene(scene);
    LevelPlan plan = plan_levels(curved.problem, resolution);
    return std::make_shared<const CurvedBed>(std::move(curved), std::move(plan), resolution);
  }
  Status advance(double t) {
    RunLimits limits;
    limits.max_collisions = kMostEvents;
    return tracker.advance_to(t, limits);
  }
  [[nodiscard]] CurvedSnapshot snapshot() const { return snapshot_of(tracker.system(), tracker.time()); }
};

struct CurvedLaws {
  long n_scenes = 0, n_times = 0;
  double worst_mass = 0, worst_order = 0;
  std::uint64_t n_events = 0;
};

/// Positions as they are, before rounding is cut off.
double disorder(const CurvedRun& run) {
  double worst = 0, last = -INFINITY;
  const auto& fronts = run.tracker.system().fronts();
  fronts.for_each([&](FrontIndex i, const CurvedNode& node) {
    const double z = fronts.is_boundary(i) ? node.z : position_of(run.bed->grid, node, run.tracker.time());
    worst = std::max(worst, last - z);
    last = z;
  });
  return worst;
}

void check_curved_state(const CurvedRun& run, CurvedLaws& laws, const std::string& label) {
  const CurvedSnapshot snapshot = run.snapshot();
  const double mass = run.scene.mass(), order = disorder(run),
               amount = run.bed->scene.amount_of(snapshot.z.back(), snapshot.below.back()),
               lost = std::abs(amount - mass), highest = run.scene.range_at(0.5).highest;
  EXPECT_LE(lost, kMassSlack) << label;
  EXPECT_LE(order, 1e-12) << label;
  laws.worst_mass = std::max(laws.worst_mass, lost);
  laws.worst_order = std::max(laws.worst_order, order);
  const Profile<double> steps = *CurvedField(run.bed, snapshot).profile(),
                        lines =
                            CurvedReconstruction(*run.bed, run.tracker.system().fronts(), snapshot).profile();
  for (const Profile<double>* profile : {&steps, &lines}) {
    EXPECT_NEAR(profile->mass(), mass, kMassSlack) << label;
    for (const auto* side : {&profile->below(), &profile->above()}) {
      EXPECT_GE(*std::min_element(side->begin(), side->end()), 0) << label;
      if (!run.scene.spec().solid_fraction) {
        EXPECT_LE(*std::max_element(side->begin(), side->end()), highest) << label;
      }
    }
  }
  ++laws.n_times;
}

using RandomSpec = SceneSpec<double> (*)(std::uint64_t);

void check_curved_laws(RandomSpec random, std::uint64_t seed, double resolution, CurvedLaws& laws) {
  const std::string label = "seed " + std::to_string(seed) + ", resolution " + std::to_string(resolution);
  const SceneSpec<double> spec = random(seed);
  CurvedRun run(spec, resolution);
  for (const double t : {0.0, 0.1, 0.4, 1.0, 2.5}) {
    ASSERT_TRUE(run.advance(t * run.unit_time) != Status::budget_reached) << label;
    check_curved_state(run, laws, label + ", t = " + std::to_string(t * run.unit_time));
  }
  ASSERT_EQ(run.advance(infinity<double>()), Status::steady) << label;
  check_curved_state(run, laws, label + ", at rest");
  for (const State state : run.snapshot().state) EXPECT_EQ(run.bed->grid.level(state), 0u) << label;
  laws.n_events += run.tracker.n_collisions();
  ++laws.n_scenes;
}

void check_many(std::uint64_t from, int n, double resolution,
                RandomSpec random = support::random_curved_spec) {
  CurvedLaws laws;
  for (int i = 0; i < n && !testing::Test::HasFailure(); ++i)
    check_curved_laws(random, support::seed_of(from + static_cast<std::uint64_t>(i)), resolution, laws);
  EXPECT_EQ(laws.n_scenes, n);
  EXPECT_EQ(laws.n_times, 6 * n);
  EXPECT_GT(laws.n_events, static_cast<std::uint64_t>(n));
  std::printf("%ld scenes, %llu events: mass to %.1e, order to %.1e\n", laws.n_scenes,
              static_cast<unsigned long long>(laws.n_events), laws.worst_mass, laws.worst_order);
}

TEST(CurvedLaws, MassOrderRangeAndAnEnd) { check_many(1, 400, 0.07); }
TEST(CurvedLaws, MassOrderRangeAndAnEndOfFineLevels) { check_many(100'001, 20, 0.006); }
TEST(CurvedLaws, MassOrderRangeAndAnEndOfCoarseLevels) { check_many(200'001, 300, 0.5); }
TEST(CurvedLaws, MassOrderRangeAndAnEndOfOtherFluxes) {
  check_many(400'001, 100, 0.07, support::random_curved_flux_spec);
}
TEST(SlowCurvedLaws, MassOrderRangeAndAnEnd) { check_many(300'001, 4'000, 0.05); }
TEST(SlowCurvedLaws, MassOrderRangeAndAnEndOfOtherFluxes) {
  check_many(500'001, 1'000, 0.05, support::random_curved_flux_spec);
}

TEST(CurvedLaws, StopsOnTheWayChangeNothing) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const SceneSpec<double> spec = support::random_curved_spec(support::seed_of(seed));
    CurvedRun direct(spec, 0.05), stopped(spec, 0.05);
    const double t = 2 * direct.unit_time;
    direct.advance(t);
    for (int i = 1; i < 7; ++i) stopped.advance(t * i / 7);
    stopped.advance(t);
    const CurvedSnapshot a = direct.snapshot(), b = stopped.snapshot();
    EXPECT_EQ(a.z, b.z) << seed;
    EXPECT_EQ(a.state, b.state) << seed;
    EXPECT_EQ(a.below, b.below) << seed;
    CurvedTracker copy = direct.tracker;
    copy.run_to_steady();
    stopped.advance(infinity<double>());
    EXPECT_EQ(copy.last_collision(), stopped.tracker.last_collision()) << seed;
    EXPECT_EQ(copy.n_collisions(), stopped.tracker.n_collisions()) << seed;
  }
}

// u(z, t) of a bed is 1 - u(1 - z, t) of the bed upside down. Levels are chosen alike, so what differs is rounding.
TEST(CurvedLaws, UpsideDownIsTheMirrorImage) {
  int n_times = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const SceneSpec<double> spec = support::random_curved_spec(support::seed_of(seed));
    CurvedRun run(spec, 0.05), turned(support::turned_over(spec), 0.05);
    for (const double t : {0.3, 1.0, 2.0}) {
      run.advance(t * run.unit_time);
      turned.advance(t * run.unit_time);
      const CurvedField a(run.bed, run.snapshot()), b(turned.bed, turned.snapshot());
      for (int i = 0; i <= 20; ++i) {
        const double z = 0.05 * i;
        // M(z) = m - (1 - z) + M_mirror(1 - z).
        EXPECT_NEAR(a.at(z).M, run.scene.mass() - (1 - z) + b.at(1 - z).M, 1e-11)
            << "seed " << seed << ", t = " << t * run.unit_time << ", z = " << z;
      }
      ++n_times;
    }
  }
  EXPECT_EQ(n_times, 300);
}

TEST(CurvedLaws, EqualInputGivesEqualOutput) {
  const Scene<double> scene(support::random_curved_spec(support::seed_of(5)));
  Tracking a(scene, {.resolution = 0.01, .history = true}), b(scene, {.resolution = 0.01, .history = true});
  a.advance(0.7);
  b.advance(0.7);
  EXPECT_EQ(a.profile().z(), b.profile().z());
  EXPECT_EQ(a.fronts().size(), b.fronts().size());
  EXPECT_EQ(a.collisions().size(), a.summary().collisions);
}

}  // namespace
}  // namespace shearfront
