// SPDX-License-Identifier: BSD-3-Clause
// Every solver of beds without diffusion from smooth and tabulated starts: the closed form of Burgers' equation before and after
// its shock, the exact solution of layers, what is guaranteed, what is stated.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/options.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// u_t + (u^2 / 2)_x = 0 on a ring, u(x, 0) = 1/3 + 2/3 sin x.
Scene<double> burgers_ring() {
  SceneSpec<double> spec;
  spec.fluxes = {Burgers<double>{}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.top = 2 * kHalfTurn;
  spec.is_periodic = true;
  spec.initial_state = SineInitial<double>{1.0 / 3, 2.0 / 3, 2 * kHalfTurn, 0};
  return Scene<double>(spec);
}
/// In a frame that moves with 1/3 the wave is odd about x = pi, where the shock stands from t = 3/2 on; to its left u is the
/// first root of y + 2/3 sin(y) t = x.
double burgers_on_ring(double x, double t) {
  double moved = std::fmod(x - t / 3, 2 * kHalfTurn);
  if (moved < 0) moved += 2 * kHalfTurn;
  const bool is_right = moved > kHalfTurn;
  if (is_right) moved = 2 * kHalfTurn - moved;
  double lo = 0, hi = t > 1.5 ? std::acos(-1.5 / t) : kHalfTurn;
  for (int i = 0; i < 100; ++i) {
    const double y = lo + (hi - lo) / 2;
    (y + 2.0 / 3 * std::sin(y) * t < moved ? lo : hi) = y;
  }
  const double v = 2.0 / 3 * std::sin(lo);
  return 1.0 / 3 + (is_right ? -v : v);
}

double l1_from_burgers(const Profile<double>& profile, double t) {
  double sum = 0;
  for (std::size_t i = 0; i < profile.n_cells(); ++i) {
    const double lo = profile.z()[i], width = profile.z()[i + 1] - lo;
    constexpr int kPoints = 16;
    for (int k = 0; k < kPoints; ++k) {
      const double part = (k + 0.5) / kPoints;
      const double phi = profile.below()[i] + part * (profile.above()[i] - profile.below()[i]);
      sum += width / kPoints * std::abs(phi - burgers_on_ring(lo + part * width, t));
    }
  }
  return sum;
}
double burgers_error(const std::string& solver, const support::OptionNumbers& numbers, double t) {
  const Scene<double> scene = burgers_ring();
  SolverRequest request{{t}, {}};
  request.profiles = true;
  const SolverResult result = solve(scene, support::method_of(solver, numbers), request);
  EXPECT_TRUE(result.summary.usable()) << result.summary.message;
  return l1_from_burgers(result.profiles.at(0), t);
}

struct Ladder {
  std::string solver, option;
  double first;  ///< value of the option; halved, or doubled, three times
  bool is_count;
  double order_before, order_after;  ///< at least, over all three
};
class BurgersRing : public testing::TestWithParam<Ladder> {};
TEST_P(BurgersRing, HasTheOrderOfTheMethodBeforeAndAfterTheShock) {
  const Ladder& of = GetParam();
  for (const double t : {1.0, 3.0}) {
    std::vector<double> errors;
    double value = of.first;
    for (int i = 0; i < 4; ++i) {
      errors.push_back(burgers_error(of.solver, {{of.option, value}}, t));
      value *= of.is_count ? 2 : 0.5;
    }
    const double order = std::log2(errors[0] / errors[3]) / 3;
    EXPECT_GT(order, t < 1.5 ? of.order_before : of.order_after)
        << "t " << t << ": " << errors[0] << ", " << errors[1] << ", " << errors[2] << ", " << errors[3];
    EXPECT_LT(errors[3], 0.1);
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, BurgersRing,
                         testing::Values(Ladder{"front-tracking", "resolution", 0.04, false, 0.95, 0.95},
                                         Ladder{"godunov", "cells", 50, true, 0.8, 0.8},
                                         Ladder{"engquist-osher", "cells", 50, true, 0.8, 0.8}),
                         [](const auto& of) {
                           std::string name = of.param.solver;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(BurgersRing, IsRefusedByTheExactMethodOnly) {
  const Scene<double> scene = burgers_ring();
  EXPECT_NE(Method("exact").refusal(scene).find("does not vanish at both ends of its range"),
            std::string::npos)
      << Method("exact").refusal(scene);
  EXPECT_EQ(Method("front-tracking").refusal(scene), "");
  EXPECT_EQ(Method("godunov").refusal(scene), "");
}

std::vector<std::string> solvers_of_smooth_starts() {
  std::vector<std::string> names = Method::names();
  std::erase_if(names, [](const std::string& name) {
    return Method(name).guarantees().diffusion || Method(name).guarantees().has_slab;
  });
  return names;
}

/// M as the exact one to the order of the method, mass and range as promised, from any start.
TEST(SmoothStartSolvers, KeepWhatTheyGuarantee) {
  constexpr double kStepOfPhi = 0.02;
  int n_checked = 0;
  for (const std::string& name : solvers_of_smooth_starts()) {
    const Method method = support::method_of(name, {{"resolution", kStepOfPhi}, {"cells", 200}});
    const Guarantees promised = method.guarantees();
    for (std::uint64_t number = 0; number < 12; ++number) {
      SCOPED_TRACE(name + ", seed " + std::to_string(77000 + number));
      support::SceneMaker make(support::seed_of(77000 + number));
      SceneSpec<double> spec;
      spec.shear_rate = make.layers(make.integer(1, 4), make.order());
      spec.initial_state = support::random_start(make);
      const Scene<double> scene(spec);
      ASSERT_EQ(method.refusal(scene), "");
      SolverRequest request{{0, 0.2, 1.3, infinity<double>()}, {}};
      for (int i = 0; i <= 40; ++i) request.heights.push_back(i / 40.0);
      const SolverResult result = solve(scene, method, request);
      ASSERT_TRUE(result.summary.usable()) << result.summary.message;
      const ExactSolution<double> exact(scene);
      double slack = 1e-12;
      if (!promised.exact) slack = 2 * std::pow(kStepOfPhi, promised.order_M);
      // What M is off at the start, by wide steps where it is nearly level, it may be off for ever.
      double at_start = 0;
      for (std::size_t j = 0; j < request.heights.size(); ++j)
        at_start = std::max(at_start, std::abs(result.M(0, j) - exact.M(request.heights[j], 0)));
      EXPECT_LE(at_start, promised.exact ? 1e-15 : kStepOfPhi / 4);
      slack += 1.5 * at_start;
      for (std::size_t i = 0; i < request.times.size(); ++i)
        for (std::size_t j = 0; j < request.heights.size(); ++j) {
          const Sample& s = result.at(i, j);
          if (promised.bounded) {
            EXPECT_GE(s.phi, 0);
            EXPECT_LE(s.phi, 1);
          }
          if (promised.conservative && j + 1 == request.heights.size()) {
            EXPECT_NEAR(s.M, scene.mass(), 1e-13);
          }
          if (promised.exact || promised.order_M > 0) {
            EXPECT_NEAR(s.M, exact.M(request.heights[j], request.times[i]), slack)
                << "z " << request.heights[j] << " t " << request.times[i];
            ++n_checked;
          }
        }
    }
  }
  EXPECT_GT(n_checked, 4 * 12 * 41);
}

/// A start of 2 to 10 points in layers or a table of a(z): an upwind scheme of first order comes nearer to the exact M in
/// proportion to its cells; so does the tracker to the resolution, and in M to its square.
TEST(SmoothStartSolvers, ConvergeToTheExactOne) {
  std::array<double, 3> godunov{}, tracker{};
  int n = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    support::SceneMaker make(support::seed_of(78000 + number));
    SceneSpec<double> spec;
    spec.shear_rate = make.layers(make.integer(1, 3), make.order());
    if (number % 3 == 0)
      spec.shear_rate =
          Table<double>{{0, 0.4, 1}, {std::exp(make.uniform(-1, 1)), 1, std::exp(make.uniform(-1, 1))}};
    TableInitial<double> start;
    start.z = make.heights(static_cast<int>(number % 9), 0, 1);
    start.z.insert(start.z.begin(), 0), start.z.push_back(1);
    for (std::size_t i = 0; i < start.z.size(); ++i) start.values.push_back(make.uniform(0, 1));
    spec.initial_state = start;
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    SolverRequest request{{0.1, 0.4}, {}};
    for (int i = 1; i < 40; ++i) request.heights.push_back(i / 40.0);
    for (std::size_t level = 0; level < 3; ++level) {
      const double finer = std::pow(2.0, static_cast<double>(level));
      const auto cells = solve(scene, support::method_of("godunov", {{"cells", 200 * finer}}), request);
      const auto fronts =
          solve(scene, support::method_of("front-tracking", {{"resolution", 0.08 / finer}}), request);
      ASSERT_TRUE(cells.summary.usable() && fronts.summary.usable());
      for (std::size_t i = 0; i < request.times.size(); ++i)
        for (std::size_t j = 0; j < request.heights.size(); ++j) {
          const double M = exact.M(request.heights[j], request.times[i]);
          godunov[level] += std::abs(cells.M(i, j) - M);
          tracker[level] += std::abs(fronts.M(i, j) - M);
          ++n;
        }
    }
  }
  ASSERT_EQ(n, 12 * 2 * 39 * 3);
  EXPECT_GT(std::log2(godunov[0] / godunov[2]) / 2, 0.9)
      << godunov[0] << ' ' << godunov[1] << ' ' << godunov[2];
  EXPECT_GT(std::log2(tracker[0] / tracker[2]) / 2, 1.6)
      << tracker[0] << ' ' << tracker[1] << ' ' << tracker[2];
  EXPECT_LT(tracker[2] / (n / 3), 1e-3);
  EXPECT_LT(godunov[2] / (n / 3), 1e-2);
}

/// A wave in a uniform bed, before its shock: second order with limited slopes.
TEST(SmoothStartSolvers, OfSecondOrderStaySo) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_state = SineInitial<double>{0.5, 0.3, 1, 0};
  const Scene<double> scene(spec);
  const ExactSolution<double> exact(scene);
  const double t = 0.1;  // the shock comes at 0.27
  std::vector<double> errors;
  for (const double n : {100.0, 200.0, 400.0, 800.0}) {
    SolverRequest request{{t}, {}};
    for (int i = 25; i <= 75; ++i) request.heights.push_back(i / 100.0);  // where the walls are not felt
    const SolverResult result = solve(scene, support::method_of("muscl", {{"cells", n}}), request);
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    double worst = 0;
    for (std::size_t j = 0; j < request.heights.size(); ++j)
      worst += std::abs(result.M(0, j) - exact.M(request.heights[j], t));
    errors.push_back(worst);
  }
  EXPECT_GT(std::log2(errors[0] / errors[3]) / 3, 1.6)
      << errors[0] << ' ' << errors[1] << ' ' << errors[2] << ' ' << errors[3];
}

/// The steps hold the mass, are as far away as is said, and come nearer in proportion to the resolution.
TEST(SmoothStartSolvers, StepsOfTheTrackerAreAsFarAwayAsTheySay) {
  int n = 0;
  for (std::uint64_t number = 0; number < 20; ++number) {
    support::SceneMaker make(support::seed_of(79000 + number));
    SceneSpec<double> spec;
    const bool is_cubic = number % 2 == 1;
    if (is_cubic) spec.fluxes = {Cubic<double>{0.9}};
    if (number % 5 == 0) spec.solid_fraction = Piecewise<double>{{0.4}, {0.5, 0.7}};
    spec.shear_rate = make.layers(make.integer(1, 4), make.order());
    spec.initial_state = support::random_start(make);
    const Scene<double> scene(spec);
    double last = 0;
    for (const double resolution : {0.1, 0.05, 0.025}) {
      const auto check = [&](const auto& setup) {
        double mass = 0, bottom = 0, distance = 0;
        for (std::size_t i = 0; i < setup.pieces.size(); ++i) {
          const auto& piece = setup.pieces[i];
          const double phi = setup.grid.phi(piece.layer, piece.state);
          mass += phi * (piece.top - bottom);
          const int points = 200;
          for (int k = 0; k < points; ++k) {
            const double z = bottom + (piece.top - bottom) * (k + 0.5) / points;
            distance += std::abs(scene.initial_phi(z) - phi) * (piece.top - bottom) / points;
          }
          bottom = piece.top;
        }
        EXPECT_EQ(bottom, 1);
        EXPECT_NEAR(mass, scene.mass(), 1e-13) << "seed " << 79000 + number;
        EXPECT_NEAR(setup.start_distance, distance, 1e-5 + 0.02 * distance) << "seed " << 79000 + number;
        EXPECT_LE(setup.start_distance, resolution / 2);
        if (last > 1e-6) {
          EXPECT_LT(setup.start_distance, 0.8 * last) << "seed " << 79000 + number;
        }
        last = setup.start_distance;
        ++n;
      };
      if (is_cubic)
        check(TrackingSetup<double, UnimodalGrid<double>>(scene, resolution));
      else
        check(TrackingSetup<double>(scene, resolution));
    }
  }
  EXPECT_EQ(n, 60);
}

TEST(SmoothStartSolvers, TheTrackerStatesTheDistance) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_state = TableInitial<double>{{0, 1}, {0.25, 0.75}};
  const Scene<double> scene(spec);
  auto bed = track(scene, {.resolution = 0.25});
  bed.advance(0.1);
  EXPECT_NE(bed.summary().message.find("steps stand for the smooth start, an L1 distance of"),
            std::string::npos)
      << bed.summary().message;
}

// Where the start falls through the peak of the flux and the rate falls too, r g(u) has its maximum just beside: a stretch whose
// levels cannot hold its amount if that is missed. The kind of fault: a tolerance in units of a bed of height 1.
TEST(SmoothStarts, FrontsHoldTheAmountInBedsOfAnyHeight) {
  for (const double height : {1e-9, 1e-5, 1.0, 1e5}) {
    SceneSpec<double> spec;
    spec.top = height;
    Table<double> rate;
    TableInitial<double> start;
    for (const double part : {0.0, 0.5, 1.0}) rate.z.push_back(part * height);
    rate.values = {1.1, 0.5, 1.9};
    for (const double part : {0.0, 0.23, 0.26, 0.53, 1.0}) start.z.push_back(part * height);
    start.values = {0.63, 0.92, 0.07, 0.07, 0.5};
    spec.shear_rate = rate;
    spec.initial_state = start;
    const Scene<double> scene(spec);
    for (const double resolution : {0.1, 0.01}) {
      const SolverResult result =
          solve(scene, support::method_of("front-tracking", {{"resolution", resolution}}),
                SolverRequest{{0, 0.1 * height}, {height}});
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(result.M(i, 0), scene.mass(), 1e-12 * height) << height << ", " << resolution;
    }
  }
}

}  // namespace
}  // namespace shearfront
