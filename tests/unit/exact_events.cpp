// SPDX-License-Identifier: BSD-3-Clause
// What the event times mean, checked against the solution itself.
#include <gtest/gtest.h>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

Scene<double> layered_bed(std::vector<double> breaks, std::vector<double> a, std::vector<double> jumps,
                          std::vector<double> values) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{std::move(breaks), std::move(a)};
  spec.initial_breaks = std::move(jumps);
  spec.initial_values = std::move(values);
  return Scene<double>(spec);
}

TEST(ExactEvents, SteadyDataNeverMove) {
  for (const auto& [jumps, values] : std::vector<std::pair<std::vector<double>, std::vector<double>>>{
           {{}, {0}}, {{}, {1}}, {{0.5}, {1, 0}}, {{0.2, 0.5}, {1, 1, 0}}}) {
    const auto events = exact_timeline(layered_bed({0.3}, {2, 1}, jumps, values));
    EXPECT_EQ(*events.t_star, 0.0);
    EXPECT_FALSE(events.t0);
    EXPECT_FALSE(events.t1);
    EXPECT_FALSE(events.interfaces[0].first);
    EXPECT_FALSE(events.interfaces[0].last);
  }
}

/// A piece cut into many equal ones is the same piece: no path from between pure ones counts as grains that move.
TEST(ExactEvents, EqualPiecesSideBySideAreOne) {
  int n = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    SceneMaker make(support::seed_of(4900 + number));
    const std::vector<double> breaks = make.heights(1, 0.2, 0.8),
                              rates{make.uniform(0.2, 2), make.uniform(0.2, 2)};
    const double z = make.uniform(0.2, 0.8), state = make.uniform(0.2, 1);
    std::vector<double> jumps{z}, values{state, 0};
    const auto whole = exact_timeline(layered_bed(breaks, rates, jumps, values));
    const int parts = number % 2 == 0 ? 20 : 200;
    for (int i = 1; i < parts; ++i, values.push_back(0)) jumps.push_back(z + (1 - z) * i / parts);
    const auto cut = exact_timeline(layered_bed(breaks, rates, jumps, values));
    EXPECT_NEAR(*cut.t_star, *whole.t_star, 1e-12 * *whole.t_star) << "seed " << 4900 + number;
    const auto &last = cut.interfaces[0].last, &expected = whole.interfaces[0].last;
    ASSERT_EQ(last.has_value(), expected.has_value()) << "seed " << 4900 + number;
    if (!last) continue;  // no grain of the other kind comes to the interface
    EXPECT_NEAR(*last, *expected, 1e-12 * *whole.t_star) << "seed " << 4900 + number;
    ++n;
  }
  EXPECT_GT(n, 10);
}

TEST(ExactEvents, UniformMixture) {
  // phi = p everywhere: the walls' shocks meet at height p, at t = 1 / (s a) whatever p is.
  for (const double p : {0.1, 0.5, 0.9, 1e-9}) {
    const auto events = exact_timeline(layered_bed({}, {2}, {}, {p}));
    EXPECT_EQ(*events.t0, 0.0);
    EXPECT_EQ(*events.t1, 0.0);
    EXPECT_NEAR(*events.t_star, 0.5, 1e-14) << p;
  }
}

TEST(ExactEvents, WallsThatNeverSeeAWave) {
  const auto events = exact_timeline(layered_bed({}, {2}, {0.3, 0.6}, {1, 0.5, 0}));
  EXPECT_FALSE(events.t0);
  EXPECT_FALSE(events.t1);
}

TEST(ExactEvents, NullJumpsAreNoJumps) {
  const auto events = exact_timeline(layered_bed({}, {2}, {0.1, 0.5, 0.9}, {0, 0, 1, 1}));
  EXPECT_DOUBLE_EQ(*events.t0, 0.25);
  EXPECT_DOUBLE_EQ(*events.t1, 0.25);
}

TEST(ExactEvents, InterfaceThatEmitsAtOnce) {
  EXPECT_EQ(*exact_timeline(layered_bed({0.5}, {2, 1}, {}, {0.3})).interfaces[0].first, 0.0);
  EXPECT_EQ(*exact_timeline(layered_bed({0.5}, {2, 1}, {0.5}, {0, 1})).interfaces[0].first, 0.0);
  EXPECT_EQ(*exact_timeline(layered_bed({0.5}, {1, 1}, {0.5}, {0.2, 0.3})).interfaces[0].first, 0.0);
}

TEST(ExactEvents, TransparentInterfaceSeesEdgesAndShocks) {
  // phi = 0.2 around an interface of equal a: its characteristics come down with speed 0.6.
  // Jump 0.2 | 0.1 at 0.9: shock with speed 0.7 (down) arrives first; jump 0.2 | 0.6: the fan's edge, 0.6.
  EXPECT_NEAR(*exact_timeline(layered_bed({0.5}, {1, 1}, {0.6}, {0.2, 0.1})).interfaces[0].first, 0.1 / 0.7,
              1e-13);
  EXPECT_NEAR(*exact_timeline(layered_bed({0.5}, {1, 1}, {0.6}, {0.2, 0.6})).interfaces[0].first, 0.1 / 0.6,
              1e-13);
  // Standing shock 0.7 | 0.3 (a equal): both sides come in with speed 0.4; from below first.
  EXPECT_NEAR(*exact_timeline(layered_bed({0.5}, {1, 1}, {0.45, 0.5}, {0.65, 0.7, 0.3})).interfaces[0].first,
              0.05 / 0.4, 1e-13);
}

TEST(ExactEvents, InterfaceThatActsAsAWall) {
  // 1 below, 0 above the interface; small grains fall onto it from 0.7.
  const auto events = exact_timeline(layered_bed({0.3}, {2, 1}, {0.3, 0.7}, {1, 0, 1}));
  EXPECT_NEAR(*events.interfaces[0].first, 0.4, 1e-14);
  EXPECT_EQ(*events.interfaces[0].last, *events.interfaces[0].first);
}

TEST(ExactEvents, InterfaceOfTwoPureSides) {
  const auto events = exact_timeline(layered_bed({0.2, 0.8}, {2, 1, 4}, {0.5}, {0, 1}));
  EXPECT_NEAR(*events.interfaces[0].first, 0.3, 1e-14);
  EXPECT_NEAR(*events.interfaces[1].first, 0.3, 1e-14);
}

// However few grains there are they move: where the amount at an interface changes for the last time it changes for the first time.
TEST(ExactEvents, TracesOfGrainsMove) {
  SceneMaker make(support::seed_of(5400));
  int n_moving = 0, n_never = 0;
  for (int n = 0; n < 400; ++n) {
    auto spec = make.data(make.integer(2, 4), make.order(), 4);
    if (make.integer(0, 1) == 0) {  // a table with the same knots
      const auto layers = std::get<Piecewise<double>>(spec.shear_rate);
      Table<double> table{layers.breaks, layers.values};
      table.z.insert(table.z.begin(), 0);
      table.z.push_back(1);
      table.values.push_back(make.integer(0, 1) == 0 ? table.values.back() : make.uniform(0.1, 4));
      if (make.integer(0, 1) == 0) table.values[1] = table.values[0];
      spec.shear_rate = table;
    }
    for (double& phi : spec.initial_values) {
      const double trace = make.integer(0, 2) == 0 ? 0 : std::pow(10, make.uniform(-25, -10));
      phi = phi == 1 ? 1 - trace : trace;
    }
    for (const auto& times : exact_timeline(Scene<double>(spec)).interfaces) {
      ASSERT_EQ(times.first.has_value(), times.last.has_value()) << "scene " << n << ", z = " << times.z;
      (times.first ? n_moving : n_never) += 1;
      if (times.first) {
        EXPECT_LE(*times.first, *times.last) << "scene " << n << ", z = " << times.z;
      }
    }
  }
  EXPECT_GT(n_moving, 100);
  EXPECT_GT(n_never, 20);
}

/// Random scenes at rest at some interfaces: states {0, 1}, equal neighbouring a, mirrored states.
SceneSpec<double> with_resting_interfaces(SceneMaker& make) {
  const int n = make.integer(2, 5);
  auto spec = make.data(n, make.order(), 6);
  auto& a = std::get<Piecewise<double>>(spec.shear_rate);
  for (std::size_t k = 1; k < a.values.size(); ++k)
    if (make.integer(0, 1) == 0) a.values[k] = a.values[k - 1];
  if (make.integer(0, 2) == 0)
    for (double& phi : spec.initial_values) phi = make.integer(0, 1);
  if (make.integer(0, 2) == 0) {  // a mirrored pair at the first interface
    const double z = a.breaks[0], p = make.uniform(0.5, 1);
    std::vector<double> jumps{z}, values;
    for (const double x : spec.initial_breaks)
      if (std::abs(x - z) > 1e-3) jumps.push_back(x);
    std::sort(jumps.begin(), jumps.end());
    for (std::size_t i = 0; i <= jumps.size(); ++i) values.push_back(make.uniform(0, 1));
    const auto at = static_cast<std::size_t>(std::find(jumps.begin(), jumps.end(), z) - jumps.begin());
    values[at] = p;
    values[at + 1] = 1 - p;
    a.values[1] = a.values[0];
    spec.initial_breaks = jumps;
    spec.initial_values = values;
  }
  return spec;
}

void check_first_and_last(std::uint64_t first_seed, std::uint64_t count) {
  int arrivals = 0;
  for (std::uint64_t n = first_seed; n < first_seed + count; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    const auto scene = scene_cast<Real110>(Scene<double>(with_resting_interfaces(make)));
    const ExactSolution<Real110> solution(scene);
    const auto events = exact_timeline(scene);
    const Real110 near("1e-12"), tiny("1e-6");
    for (const auto& times : events.interfaces) {
      const auto moved = [&](const Real110& t, const Real110& distance) {
        for (const Real110& z : {Real110(times.z - distance), Real110(times.z + distance)})
          if (abs(to_double(Real110(solution.phi(z, t) - scene.initial_phi(z)))) > 1e-13) return true;
        return false;
      };
      const Real110 late = 1000;
      if (!times.first) {
        EXPECT_FALSE(moved(late, near)) << "seed " << seed << " z " << times.z;
        continue;
      }
      ++arrivals;
      if (*times.first > 0) {
        EXPECT_FALSE(moved(*times.first * (1 - tiny), near)) << "seed " << seed << " z " << times.z;
      }
      // Just after the arrival the change at an edge is of the order of the step in time.
      EXPECT_TRUE(moved(*times.first * (1 + tiny) + near * 1000, near))
          << "seed " << seed << " z " << times.z;
      ASSERT_TRUE(times.last) << "seed " << seed;
      EXPECT_GE(*times.last, *times.first) << "seed " << seed << " z " << times.z;
      const Real110 target = std::min(Real110(times.z - scene.bottom()), solution.mass());
      EXPECT_EQ(solution.M(times.z, *times.last * (1 + Real110("1e-40"))), target) << "seed " << seed;
      if (*times.last > *times.first) {
        EXPECT_LT(solution.M(times.z, *times.last * (1 - Real110("1e-9"))), target) << "seed " << seed;
      }
      EXPECT_LE(*times.last, *events.t_star * (1 + Real110("1e-45"))) << "seed " << seed;
    }
    const Real110& star = *events.t_star;
    if (star > 0) {
      EXPECT_LT(solution.M(events.steady_height, star * (1 - Real110("1e-9"))), solution.mass())
          << "seed " << seed;
      EXPECT_EQ(solution.M(events.steady_height, star * (1 + Real110("1e-40"))), solution.mass())
          << "seed " << seed;
    }
    const auto in_double = exact_timeline(scene_cast<double>(scene));
    // M is good to some 4u, and t* is where M with slope H reaches the mass.
    const double H =
        star > 0 ? to_double(solution.H(events.steady_height, star * (1 - Real110("1e-9")))) : 1.0;
    EXPECT_NEAR(*in_double.t_star, to_double(star), 4e-15 * to_double(star) + 1e-15 / H) << "seed " << seed;
  }
  EXPECT_GT(arrivals, 0);
}

TEST(ExactEvents, FirstAndLastWaveBracketTheMotion) { check_first_and_last(1, 60); }
TEST(SlowExactEvents, FirstAndLastWaveBracketTheMotionOfManyScenes) { check_first_and_last(1000, 1500); }

TEST(ExactEvents, MirroredSceneHasMirroredEvents) {
  for (std::uint64_t n = 1; n <= 50; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    const Scene<double> scene(make.data(4, make.order(), 4));
    SceneSpec<double> mirror = scene.spec();
    auto& a = std::get<Piecewise<double>>(mirror.shear_rate);
    for (auto* z : {&a.breaks, &mirror.initial_breaks}) {
      std::reverse(z->begin(), z->end());
      for (double& x : *z) x = 1 - x;
    }
    std::reverse(a.values.begin(), a.values.end());
    std::reverse(mirror.initial_values.begin(), mirror.initial_values.end());
    for (double& phi : mirror.initial_values) phi = 1 - phi;
    const auto events = exact_timeline(scene), mirrored = exact_timeline(Scene<double>(mirror));
    EXPECT_NEAR(*events.t_star, *mirrored.t_star, 1e-12 * *events.t_star) << "seed " << seed;
    EXPECT_EQ(events.t0.has_value(), mirrored.t1.has_value()) << "seed " << seed;
    if (events.t0 && mirrored.t1) {
      EXPECT_NEAR(*events.t0, *mirrored.t1, 1e-12) << "seed " << seed;
    }
    for (std::size_t i = 0; i < events.interfaces.size(); ++i) {
      const auto& one = events.interfaces[i];
      const auto& two = mirrored.interfaces[events.interfaces.size() - 1 - i];
      EXPECT_EQ(one.first.has_value(), two.first.has_value()) << "seed " << seed;
      if (one.last && two.last) {
        EXPECT_NEAR(*one.last, *two.last, 1e-11 * *one.last) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace shearfront
