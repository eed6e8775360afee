// SPDX-License-Identifier: BSD-3-Clause
// What the tracker guarantees whatever the scene; each law on random scenes with fixed seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracles/verify.hpp"
#include "shearfront/digits/real110.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "support/checked.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;
using Tracked = Tracker<LevelGrid<double>>;
using Recorded = Tracker<LevelGrid<double>, History<double>>;

constexpr double kResolution = 0.03;

Scene<double> draw(int number) {
  SceneMaker maker(support::seed_of(1000 + static_cast<std::uint64_t>(number)));
  return Scene<double>(maker.data(maker.integer(1, 6), maker.order(), 12));
}
SceneSpec<double> scaled(SceneSpec<double> spec, double factor) {
  spec.scale *= factor;
  return spec;
}
bool same(const Profile<double>& a, const Profile<double>& b) {
  return a.z() == b.z() && a.below() == b.below() && a.above() == b.above();
}

TEST(TrackerLaws, EveryEventKeepsMassRangeOrderJumpConditionsAndEntropy) {
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution);
    Tracked tracker(setup);
    const double mass = scene.mass();
    double last = 0;
    while (tracker.step()) {
      ASSERT_GE(tracker.time(), last);
      last = tracker.time();
      ASSERT_NEAR(tracker.mass(), mass, 1e-13 * std::max(mass, 1e-3));
      ASSERT_EQ(verify(tracker, 1e-13, 1e-11), std::vector<std::string>{})
          << "after event " << tracker.n_collisions();
    }
    EXPECT_TRUE(tracker.is_steady());
    const Profile<double> steady = tracker.profile();
    support::Checked checked;
    for (std::size_t i = 0; i < steady.n_cells(); ++i) {
      if (steady.z()[i + 1] - steady.z()[i] < 1e-12) continue;
      checked.count();
      EXPECT_EQ(steady.below()[i], steady.z()[i + 1] <= scene.bottom() + mass + 1e-12 ? 1.0 : 0.0);
    }
  }
}

TEST(TrackerLaws, TwoRunsAreEqualToTheBit) {
  for (int number = 0; number < 20; ++number) {
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution), again(scene, kResolution);
    Tracked a(setup), b(again);
    a.advance_to(0.7), b.advance_to(0.7);
    EXPECT_TRUE(same(a.profile(), b.profile()));
    a.run_to_steady(), b.run_to_steady();
    EXPECT_EQ(a.last_collision(), b.last_collision());
    EXPECT_EQ(a.n_collisions(), b.n_collisions());
  }
}

TEST(TrackerLaws, StoppingOnTheWayAndCopyingChangeNothing) {
  for (int number = 0; number < 20; ++number) {
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution);
    Tracked direct(setup), stopped(setup);
    direct.advance_to(1.3);
    for (const double t : {0.0, 0.1, 0.37, 0.9}) stopped.advance_to(t);
    Tracked copy = stopped;
    stopped.run_to_steady();
    copy.advance_to(1.3);
    EXPECT_TRUE(same(copy.profile(), direct.profile()));
    direct.run_to_steady();
    EXPECT_EQ(stopped.last_collision(), direct.last_collision());
    EXPECT_TRUE(same(stopped.profile(), direct.profile()));
  }
}

// A run to a time sweeps through the bed; steps go strictly by time. Events do not depend on which is chosen.
TEST(TrackerLaws, StepsInTimeEqualTheSweep) {
  for (int number = 0; number < 20; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution);
    Tracked sweep(setup), steps(setup), both(setup);
    sweep.run_to_steady();
    while (steps.step()) {
    }
    for (int i = 0; i < 30; ++i) both.step();
    both.run_to_steady();
    for (const Tracked* other : {&steps, &both}) {
      EXPECT_TRUE(same(sweep.profile(), other->profile()));
      EXPECT_EQ(sweep.last_collision(), other->last_collision());
      EXPECT_EQ(sweep.n_collisions(), other->n_collisions());
      for (std::size_t k = 0; k <= setup.stack.n_layers(); ++k) {
        EXPECT_EQ(sweep.first_wave(k), other->first_wave(k));
        EXPECT_EQ(sweep.last_wave(k), other->last_wave(k));
      }
    }
  }
}

TEST(TrackerLaws, LimitsStopARunAndSayWhy) {
  const Scene<double> scene = draw(3);
  const TrackingSetup<double> setup(scene, 1e-4);
  Tracked limited(setup), interrupted(setup), direct(setup);
  EXPECT_EQ(limited.run_to_steady({100, {}}), Status::budget_reached);
  EXPECT_EQ(limited.n_collisions(), 100u);
  EXPECT_EQ(interrupted.run_to_steady({UINT64_MAX, [](double, std::uint64_t) { return false; }}),
            Status::interrupted);
  direct.run_to_steady();
  // Going on afterwards is allowed and ends where a direct run ends.
  EXPECT_EQ(limited.run_to_steady(), Status::steady);
  EXPECT_EQ(interrupted.run_to_steady(), Status::steady);
  EXPECT_EQ(limited.last_collision(), direct.last_collision());
  EXPECT_EQ(interrupted.last_collision(), direct.last_collision());
}

TEST(TrackerLaws, RestartFromAStateEqualsTheDirectRun) {
  for (int number = 0; number < 20; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution);
    Tracked direct(setup);
    direct.advance_to(0.4);
    const auto state = direct.snapshot();
    std::vector<Piece<double>> pieces;
    for (std::size_t i = 0; i < state.state.size(); ++i)
      if (state.z[i + 1] > state.z[i]) pieces.push_back({state.layer[i], state.z[i + 1], state.state[i]});
    Tracked restarted(setup.grid, pieces, setup.ends);
    direct.advance_to(1.4);
    restarted.advance_to(1.0);
    EXPECT_LE(l1_distance(direct.profile(), restarted.profile()), 1e-12);
  }
}

TEST(TrackerLaws, ObserversSeeAllAndDoNotSteer) {
  support::Checked checked;
  for (int number = 0; number < 10; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution);
    Tracked silent(setup);
    Recorded watched(setup);
    silent.run_to_steady(), watched.run_to_steady();
    EXPECT_EQ(silent.last_collision(), watched.last_collision());
    EXPECT_TRUE(same(silent.profile(), watched.profile()));
    const History<double> history = watched.record();
    std::uint64_t after_start = 0;
    std::size_t born = 0;
    double last = 0;
    for (const auto& c : history.collisions()) {
      EXPECT_GE(c.t, last);
      last = c.t;
      after_start += c.incoming.empty() ? 0 : 1;
      born += c.outgoing.size();
      // A collision takes over the outermost states.
      if (!c.incoming.empty() && !c.outgoing.empty() && c.boundary == CollisionView<double>::kNoBoundary) {
        checked.count();
        EXPECT_EQ(c.incoming.front().below, c.outgoing.front().below);
        EXPECT_EQ(c.incoming.back().above, c.outgoing.back().above);
      }
    }
    EXPECT_EQ(after_start, watched.n_collisions());
    EXPECT_EQ(history.segments().size(), born);
    for (const auto& s : history.segments()) {
      EXPECT_GE(s.t_end, s.t_begin);
      const double speed = setup.grid.rate(s.layer) * (s.phi_below + s.phi_above - 1);
      EXPECT_NEAR(s.z_end - s.z_begin, speed * (s.t_end - s.t_begin), 1e-11 * (1 + s.t_end));
    }
  }
}

TEST(TrackerLaws, TwiceTheScaleHalvesEveryTimeExactly) {
  for (int number = 0; number < 20; ++number) {
    const Scene<double> scene = draw(number), fast(scaled(scene.spec(), 2.0));
    const TrackingSetup<double> setup(scene, kResolution), fast_setup(fast, kResolution);
    Recorded a(setup), b(fast_setup);
    a.run_to_steady(), b.run_to_steady();
    const auto &slow_events = a.observer().collisions(), &fast_events = b.observer().collisions();
    ASSERT_EQ(slow_events.size(), fast_events.size());
    for (std::size_t i = 0; i < slow_events.size(); ++i) {
      EXPECT_EQ(slow_events[i].t, 2 * fast_events[i].t);
      EXPECT_EQ(slow_events[i].z, fast_events[i].z);
    }
  }
}

TEST(TrackerLaws, UpsideDownIsTheSameProblem) {
  for (int number = 0; number < 30; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    SceneSpec<double> spec = scene.spec();
    auto& rate = std::get<Piecewise<double>>(spec.shear_rate);
    const auto flip = [](std::vector<double>& z) {
      std::reverse(z.begin(), z.end());
      for (double& x : z) x = 1 - x;
    };
    flip(rate.breaks), flip(spec.initial_breaks), flip(spec.initial_values);
    std::reverse(rate.values.begin(), rate.values.end());
    const Scene<double> mirror(spec);
    const TrackingSetup<double> setup(scene, kResolution), mirror_setup(mirror, kResolution);
    Tracked a(setup), b(mirror_setup);
    for (const double t : {0.2, 1.0, 4.0}) {
      a.advance_to(t), b.advance_to(t);
      const Profile<double> p = a.profile(), q = b.profile();
      std::vector<double> z(q.z().rbegin(), q.z().rend()), phi(q.below().rbegin(), q.below().rend());
      for (double& x : z) x = 1 - x;
      for (double& x : phi) x = 1 - x;
      EXPECT_LE(l1_distance(p, Profile<double>(z, phi, phi)), 1e-11);
    }
  }
}

// Two data on one grid: the tracker solves one polygonal problem exactly, whose solutions never move apart in
// L1.
TEST(TrackerLaws, DataNeverMoveApartAndKeepTheirOrder) {
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker(support::seed_of(2000 + static_cast<std::uint64_t>(number)));
    SceneSpec<double> u = maker.data(maker.integer(1, 6), maker.order(), 12), v = u, w = u;
    for (std::size_t i = 0; i < u.initial_values.size(); ++i) {
      v.initial_values[i] = maker.uniform(0, 1);
      w.initial_values[i] = std::max(u.initial_values[i], v.initial_values[i]);
    }
    const Scene<double> scene_u(u), scene_v(v), scene_w(w);
    const LayerStack<double> stack = exact_layers(scene_u);
    const auto pieces_u = initial_pieces(scene_u, stack), pieces_v = initial_pieces(scene_v, stack),
               pieces_w = initial_pieces(scene_w, stack);
    std::vector<LayerState<double>> states = pieces_u.states;
    states.insert(states.end(), pieces_v.states.begin(), pieces_v.states.end());
    states.insert(states.end(), pieces_w.states.begin(), pieces_w.states.end());
    const auto built = LevelGrid<double>::exact_levels(stack, kResolution, states);
    const std::size_t n = pieces_u.states.size();
    const auto part = [&](std::size_t i) {
      const auto begin = built.states.begin() + static_cast<std::ptrdiff_t>(i * n);
      return std::vector<State>(begin, begin + static_cast<std::ptrdiff_t>(n));
    };
    Tracked a(built.grid, on_grid(pieces_u, part(0)), Ends<double>{}),
        b(built.grid, on_grid(pieces_v, part(1)), Ends<double>{}),
        c(built.grid, on_grid(pieces_w, part(2)), Ends<double>{});
    double last = l1_distance(a.profile(), b.profile());
    for (double t = 0.01; t < 100; t *= 1.5) {
      a.advance_to(t), b.advance_to(t), c.advance_to(t);
      const double now = l1_distance(a.profile(), b.profile());
      EXPECT_LE(now, last + 1e-12);
      last = now;
      // w >= u at the start, so for ever: the distance is the difference of the masses.
      EXPECT_NEAR(l1_distance(a.profile(), c.profile()), c.mass() - a.mass(), 1e-11);
    }
  }
}

TEST(TrackerLaws, LinesConserveMassAndStayBetweenTheirNeighbours) {
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    const TrackingSetup<double> setup(scene, kResolution);
    Tracked tracker(setup);
    for (const double t : {0.0, 0.05, 0.3, 1.0, 3.0, 50.0}) {
      tracker.advance_to(t);
      const Profile<double> lines = linear_profile(tracker);
      EXPECT_NEAR(lines.mass(), scene.mass(), 1e-13);
      for (std::size_t i = 0; i < lines.n_cells(); ++i) {
        EXPECT_GE(std::min(lines.below()[i], lines.above()[i]), 0);
        EXPECT_LE(std::max(lines.below()[i], lines.above()[i]), 1);
      }
    }
  }
}

TEST(TrackerLaws, LinesAreExactForAFanInItsFirstLayer) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {0.7}};
  spec.initial_breaks = {0.4};
  spec.initial_values = {0.1, 0.9};
  const Scene<double> scene(spec);
  const TrackingSetup<double> setup(scene, 0.1);
  Tracked tracker(setup);
  const double t = 0.2;
  tracker.advance_to(t);
  const Profile<double> lines = linear_profile(tracker);
  // phi = 1/2 + (z - z0) / (2 a t) inside the fan.
  for (double x = -0.79; x < 0.8; x += 0.01) EXPECT_NEAR(lines.at(0.4 + 0.7 * t * x).phi, 0.5 + x / 2, 1e-14);
}

// The oracle: the same run in 50 digits. Events come in the same order, and double loses a few units of the
// last place.
TEST(TrackerLaws, DoubleAgreesWithFiftyDigits) {
  for (int number = 0; number < 12; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene = draw(number);
    const Scene<Real110> fine = scene_cast<Real110>(scene);
    const TrackingSetup<double> setup(scene, 0.1);
    const TrackingSetup<Real110> fine_setup(fine, Real110(0.1));
    Recorded a(setup);
    Tracker<LevelGrid<Real110>, History<Real110>> b(fine_setup);
    a.run_to_steady(), b.run_to_steady();
    EXPECT_EQ(a.n_collisions(), b.n_collisions());
    EXPECT_NEAR(a.last_collision(), to_double(b.last_collision()), 1e-13 * a.last_collision());
    EXPECT_EQ(a.record().segments().size(), b.record().segments().size());
  }
}

}  // namespace
}  // namespace shearfront
