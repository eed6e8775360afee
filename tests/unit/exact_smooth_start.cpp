// SPDX-License-Identifier: BSD-3-Clause
// The exact solution of smooth and tabulated starts: closed forms, characteristics by another road, symmetry, contraction,
// integrals, event times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_share_integral.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/track.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

using support::bed_with;
using support::table_start;

const Piecewise<double> kUniform{{}, {1}};

/// phi = alpha + beta z moves with 2 phi - 1: phi = alpha + beta y, y = (z - (2 alpha - 1) t) / (1 + 2 beta t), and M follows.
TEST(SmoothStart, ALineStaysALine) {
  for (const double beta : {0.5, -0.5, 0.0625}) {
    const double alpha = 0.5 - beta / 2;  // 1/2 in the middle, which rests
    const ExactSolution<double> exact(
        Scene<double>(bed_with(kUniform, table_start({0, 1}, {alpha, alpha + beta}))));
    EXPECT_TRUE(exact.is_exact());
    int n = 0;
    for (const double t : {0.0, 1e-9, 0.01, 0.1, 0.25})
      for (const double z : {0.4, 0.5, 0.55, 0.6}) {
        const double y = 0.5 + (z - 0.5) / (1 + 2 * beta * t);
        EXPECT_NEAR(exact.phi(z, t), alpha + beta * y, 1e-15) << "z " << z << " t " << t;
        ++n;
      }
    EXPECT_EQ(n, 20);
  }
}

/// Where a start passes the peak of a triangular flux in a flat piece, the states beside it part with the speeds of both sides, and
/// leave the peak between them: phi(z, t) = phi(z -+ t, 0) outside of |z - 1/2| < t.
TEST(SmoothStart, ThePeakOfAKinkSpreadsInAFlatPiece) {
  SceneSpec<double> spec =
      bed_with(Table<double>{{0, 0.2, 0.8, 1}, {2, 1, 1, 2}}, table_start({0, 1}, {0.9, 0.1}));
  spec.fluxes = {Triangular<double>{}};
  const ExactSolution<double> exact{Scene<double>(spec)};
  const auto start = [](double z) { return 0.9 - 0.8 * z; };
  int n = 0;
  for (const double t : {1e-6, 0.05, 0.1, 0.2})
    for (const double away : {-0.25, -0.1, -0.03, -1e-7, 0.0, 1e-7, 0.03, 0.1, 0.25}) {
      const bool is_between = std::abs(away) < t;
      const double y = is_between ? 0.5 : away > 0 ? 0.5 + away - t : 0.5 + away + t;
      EXPECT_NEAR(exact.phi(0.5 + away, t), start(y), 1e-13) << away << ' ' << t;
      const double M = is_between ? 0.35 - t / 2 + away / 2 : exact.M(0.5 + away, t);
      EXPECT_NEAR(exact.M(0.5 + away, t), M, 1e-14) << away << ' ' << t;
      ++n;
    }
  EXPECT_EQ(n, 36);
}

/// Two waves of one bed: the closed form is the root of y + (2 phi(y) - 1) t = z, M by Lax and Hopf's minimum on a grid.
TEST(SmoothStart, AWaveIsTheRootOfItsCharacteristic) {
  const SineInitial<double> wave{0.5, 0.3, 0.8, 0.1};
  const ExactSolution<double> exact(Scene<double>(bed_with(kUniform, wave)));
  const double t_shock = 0.8 / (4 * std::numbers::pi * 0.3);  // 1 / (2 max |phi'|)
  int n = 0;
  for (const double part : {0.2, 0.7, 0.95, 1.3, 2.0})
    for (int i = 0; i <= 40; ++i) {
      const double t = part * t_shock, z = 0.301 + 0.4 * i / 40;
      double M = 1e300, y_best = 0;  // by the formula, on a grid, then refined
      const auto value = [&](double y) {
        const double v = (z - y) / t;
        return wave.integral(0, y) + t * (v + 1) * (v + 1) / 4;
      };
      for (double y = std::max(0.0, z - t); y <= std::min(1.0, z + t); y += 1e-5)
        if (value(y) < M) M = value(y), y_best = y;
      double lo = y_best - 2e-5, hi = y_best + 2e-5;
      for (int k = 0; k < 60; ++k) {
        const double y = lo + (hi - lo) / 2;
        (y + (2 * wave.value(y) - 1) * t < z ? lo : hi) = y;
      }
      const double y = lo + (hi - lo) / 2;
      const bool is_inside = std::abs(y - y_best) < 1.9e-5;
      if (!is_inside) continue;  // the wall's own path
      EXPECT_NEAR(exact.M(z, t), value(y), 4e-16) << "z " << z << " t " << t;
      EXPECT_NEAR(exact.phi(z, t), wave.value(y), 1e-12) << "z " << z << " t " << t;
      ++n;
    }
  EXPECT_GT(n, 150);
}

/// Runge and Kutta's way along dz/dt = s a (2 p - 1), dp/dt = s a' p (1 - p) from where the path is said to start.
TEST(SmoothStart, PathsInAnExponentialBedAreCharacteristics) {
  const double decay = 0.4, s = 1.5;
  for (const auto& start : std::vector<InitialState<double>>{
           SineInitial<double>{0.5, 0.4, 0.7, 0.2}, KinkInitial<double>{0.9, 0.1, 0.4, 0.1},
           table_start({0, 0.3, 0.6, 1}, {0.2, 0.9, 0.3, 0.7})}) {
    SceneSpec<double> spec = bed_with(Exponential<double>{1, decay}, start);
    spec.scale = s;
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    int n = 0;
    for (const double t : {0.05, 0.2, 0.6, 1.5})
      for (int i = 1; i < 20; ++i) {
        const double z_end = i / 20.0;
        const auto path = exact.path(z_end, t);
        if (path.kind != exact::PathKind::constant) continue;
        const auto at = exact.at(z_end, t);
        double z = path.foot, p = scene.initial_share(z);
        const int steps = 2000;
        const double dt = t / steps;
        const auto slope = [&](double height, double state) {
          const double a = std::exp(-height / decay);
          return std::pair(s * a * (2 * state - 1), -s * a / decay * state * (1 - state));
        };
        for (int k = 0; k < steps; ++k) {
          const auto [z1, p1] = slope(z, p);
          const auto [z2, p2] = slope(z + dt / 2 * z1, p + dt / 2 * p1);
          const auto [z3, p3] = slope(z + dt / 2 * z2, p + dt / 2 * p2);
          const auto [z4, p4] = slope(z + dt * z3, p + dt * p3);
          z += dt / 6 * (z1 + 2 * z2 + 2 * z3 + z4);
          p += dt / 6 * (p1 + 2 * p2 + 2 * p3 + p4);
        }
        EXPECT_NEAR(z, z_end, 1e-10) << "z " << z_end << " t " << t;
        EXPECT_NEAR(at.phi, p, 1e-9) << "z " << z_end << " t " << t;
        ++n;
      }
    EXPECT_GT(n, 25);
  }
}

InitialState<double> mirrored(const InitialState<double>& start) {
  struct Mirror {
    InitialState<double> operator()(const KinkInitial<double>& m) const {
      return KinkInitial<double>{1 - m.above, 1 - m.below, 1 - m.centre, m.width};
    }
    InitialState<double> operator()(const SineInitial<double>& m) const {
      return SineInitial<double>{1 - m.mean, m.amplitude, m.wavelength, 1 - m.origin};
    }
    InitialState<double> operator()(const TableInitial<double>& m) const {
      TableInitial<double> turned;
      for (std::size_t i = m.z.size(); i-- > 0;) {
        turned.z.push_back(1 - m.z[i]);
        turned.values.push_back(1 - m.values[i]);
      }
      return turned;
    }
  };
  return std::visit(Mirror{}, start);
}

TEST(SmoothStart, UpsideDownIsTheSame) {
  int n = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    support::SceneMaker make(support::seed_of(74000 + number));
    Piecewise<double> a = make.layers(make.integer(1, 4), make.order()), turned;
    for (std::size_t i = a.breaks.size(); i-- > 0;) turned.breaks.push_back(1 - a.breaks[i]);
    turned.values.assign(a.values.rbegin(), a.values.rend());
    const InitialState<double> start = support::random_start(make);
    const ExactSolution<double> one(Scene<double>(bed_with(a, start)));
    const ExactSolution<double> other(Scene<double>(bed_with(turned, mirrored(start))));
    for (int i = 0; i < 20; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-4, 2));
      EXPECT_NEAR(one.M(z, t), one.mass() - ((1 - z) - other.M(1 - z, t)), 2e-14)
          << "seed " << 74000 + number << " z " << z << " t " << t;
      ++n;
    }
  }
  EXPECT_EQ(n, 800);
}

double l1_between(const ExactSolution<double>& u, const ExactSolution<double>& v, double t) {
  double sum = 0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) sum += std::abs(u.phi((i + 0.5) / n, t) - v.phi((i + 0.5) / n, t)) / n;
  return sum;
}

TEST(SmoothStart, SolutionsDoNotMoveApart) {
  for (std::uint64_t number = 0; number < 4; ++number) {
    support::SceneMaker make(support::seed_of(75000 + number));
    const auto a = make.layers(3, make.order());
    const ExactSolution<double> u(Scene<double>(bed_with(a, support::random_start(make)))),
        v(Scene<double>(bed_with(a, support::random_start(make))));
    double last = l1_between(u, v, 0);
    EXPECT_GT(last, 0.01);
    for (const double t : {0.1, 0.3, 1.0, 3.0}) {
      const double now = l1_between(u, v, t);
      EXPECT_LE(now, last + 2e-3) << "seed " << 75000 + number << " t " << t;  // 2e-3: shocks between points
      last = now;
    }
  }
}

/// Where the start is pure up to a height its edge moves as a pure state does.
TEST(SmoothStart, EdgesOfPureStatesArriveAsTheyDo) {
  const auto events = [](const SceneSpec<double>& spec) { return exact_timeline(Scene<double>(spec)); };
  auto spec = bed_with(Piecewise<double>{{0.2}, {2, 0.5}}, table_start({0, 0.4, 0.7, 1}, {0, 0, 1, 1}));
  auto times = events(spec);
  EXPECT_NEAR(*times.interfaces[0].first, 0.2 / 0.5, 1e-15);
  EXPECT_NEAR(*times.t0, 0.2 / 0.5 + 0.2 / 2, 1e-15);
  EXPECT_NEAR(*times.t1, 0.3 / 0.5, 1e-15);
  EXPECT_NEAR(times.mass, 0.45, 1e-15);
  // Steps of the same kind: later with a gentler start, by as much as the formula says.
  auto steps = spec;
  steps.initial_state.reset();
  steps.initial_breaks = {0.55};
  steps.initial_values = {0, 1};
  EXPECT_GT(*times.t_star, 0);
  EXPECT_NE(*times.t_star, *events(steps).t_star);
  // A state that is neither pure nor constant beside an interface or a wall changes at once.
  spec.initial_state = table_start({0, 1}, {0.2, 0.8});
  times = events(spec);
  EXPECT_EQ(*times.t0, 0);
  EXPECT_EQ(*times.t1, 0);
  EXPECT_EQ(*times.interfaces[0].first, 0);
  // phi = 1 at the bottom and 0 at the top stay.
  spec.initial_state = table_start({0, 1}, {1, 0});
  times = events(spec);
  EXPECT_FALSE(times.t0 || times.t1);
  EXPECT_EQ(*times.interfaces[0].first, 0);
  EXPECT_GT(*times.t_star, 0);
}

/// Uniform bed, phi = 1 - z: all characteristics meet at (1/2, 1/2), and nothing moves afterwards.
TEST(SmoothStart, AFocusIsTheSteadyState) {
  const ExactSolution<double> exact(Scene<double>(bed_with(kUniform, table_start({0, 1}, {1, 0}))));
  EXPECT_NEAR(*exact_timeline(exact).t_star, 0.5, 1e-14);
  EXPECT_NEAR(exact.phi(0.5 - 1e-9, 0.5 - 1e-8), 0.5 + 1e-9 / (2e-8), 1e-7);
  EXPECT_EQ(exact.phi(0.4999, 0.6), 1);
  EXPECT_EQ(exact.phi(0.5001, 0.6), 0);
}

TEST(SmoothStart, LastChangesAreThoseOfManyCells) {
  int n = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    support::SceneMaker make(support::seed_of(76000 + number));
    // One draw after the other: the same scenes with every compiler.
    const InitialState<double> start = support::random_start(make);
    const auto order = make.order();
    const int n_layers = make.integer(1, 3);
    const SceneSpec<double> spec = bed_with(make.layers(n_layers, order), start);
    const auto smooth = exact_timeline(Scene<double>(spec));
    const auto cells = exact_timeline(Scene<double>(support::as_cells(spec, 2000).spec));
    ASSERT_TRUE(smooth.t_star && cells.t_star);
    EXPECT_NEAR(*smooth.t_star, *cells.t_star, 2e-4 * *cells.t_star) << "seed " << 76000 + number;
    for (std::size_t i = 0; i < smooth.interfaces.size(); ++i)
      if (smooth.interfaces[i].last && cells.interfaces[i].last) {
        EXPECT_NEAR(*smooth.interfaces[i].last, *cells.interfaces[i].last, 2e-4 * *cells.t_star)
            << "seed " << 76000 + number;
        ++n;
      }
  }
  EXPECT_GT(n, 5);
}

/// int (1 - phi) phi dz and the L1 distance from a profile, against sums over many points.
TEST(SmoothStart, IntegralsAreThoseOfItsValues) {
  const ShareFunction g{[](double x) { return x * (1 - x); }, {}};
  for (const auto& spec :
       {bed_with(Piecewise<double>{{0.3, 0.6}, {2, 0.5, 1}}, SineInitial<double>{0.5, 0.4, 0.7, 0.2}),
        bed_with(Exponential<double>{1, 0.5}, table_start({0, 0.3, 0.6, 1}, {0.2, 0.9, 0.3, 0.7})),
        bed_with(Piecewise<double>{{0.3}, {0.5, 2}}, KinkInitial<double>{0.9, 0.1, 0.4, 0.05})}) {
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    const Profile<double> flat({0, 0.5, 1}, {0.5, 0.25}, {0.5, 0.75});
    for (const double t : {0.0, 0.1, 0.5, 2.0}) {
      double mixed = 0, distance = 0;
      const int n = 8000;
      for (int i = 0; i < n; ++i) {
        const double z = (i + 0.5) / n, phi = exact.phi(z, t);
        mixed += g.value(phi) / n;
        distance += std::abs(phi - flat.at(z).phi) / n;
      }
      EXPECT_NEAR(share_integral(exact, t, g), mixed, 2e-4) << "t " << t;
      EXPECT_NEAR(errors_against(exact, flat, t).l1, distance, 4e-4) << "t " << t;
    }
  }
}

TEST(SmoothStart, SaysWhatIsExactAndWhatIsSearched) {
  const auto message = [](const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    const auto run = ExactSolver::start(scene, {}, {});
    run->advance(0.3);
    (void)run->field().at(0.4);
    return run->summary().message;
  };
  const SineInitial<double> wave{0.5, 0.4, 0.7, 0.2};
  EXPECT_EQ(message(bed_with(Piecewise<double>{{0.3}, {2, 0.5}}, wave)), "exact to rounding");
  const std::string sloped = message(bed_with(Exponential<double>{1, 0.5}, wave));
  EXPECT_NE(
      sloped.find("exact for paths from a smooth start, looked for in 32 parts of it; estimated error of M"),
      std::string::npos)
      << sloped;
}

}  // namespace
}  // namespace shearfront
