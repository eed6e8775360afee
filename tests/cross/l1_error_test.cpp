// SPDX-License-Identifier: BSD-3-Clause
// The exactly integrated L1 error: closed forms, plain quadrature, and 50 digits.
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/digits/real110.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/scene_cast.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shearfront/solver/all.hpp"
#include "support/random_scene.hpp"
#include "support/source_examples.hpp"

namespace shearfront {
namespace {

using support::example_1;
using support::example_2;

Scene<double> one_layer(double rate) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {rate}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

double l1(const Scene<double>& scene, const Profile<double>& profile, double t) {
  return errors_against(ExactSolution<double>(scene), profile, t).l1;
}

// A fan of half-width w = a t: phi = 1/2 + (z - 1/2) / (2 w). Against the constant c the error is
// c (1/2 - w) + (1 - c)(1/2 - w) outside and w (c^2 + (1 - c)^2) inside.
TEST(L1Error, AConstantAgainstAFan) {
  for (const double w : {0.1, 0.25, 0.499}) {
    for (const double c : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const Profile<double> constant({0, 1}, {c}, {c});
      const double expected = (0.5 - w) + w * (c * c + (1 - c) * (1 - c));
      EXPECT_NEAR(l1(one_layer(1), constant, w), expected, 1e-14) << w << ' ' << c;
    }
  }
}

// The same with a line that crosses the fan: 1/2 + b (z - 1/2). Its difference from the fan is odd about 1/2:
// |b - 1/(2w)| w^2 inside, outside (1/2 - b x) over x from w to 1/2, twice, negative nowhere for b <= 1.
TEST(L1Error, ALineAgainstAFan) {
  const double w = 0.2;
  for (const double b : {0.0, 0.5, 1.0}) {
    const Profile<double> line({0, 1}, {0.5 - b / 2}, {0.5 + b / 2});
    const double inside = std::abs(b - 1 / (2 * w)) * w * w;
    const double outside = 2 * (0.5 * (0.5 - w) - b * (0.25 - w * w) / 2);
    EXPECT_NEAR(l1(one_layer(1), line, w), inside + outside, 1e-14) << b;
  }
}

// Pure grains the stable way round never move; a jump at the wrong height counts its distance, wherever the
// edges of cells are.
TEST(L1Error, TheDistanceOfAShock) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.4}, {1, 3}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {1, 0};
  const Scene<double> scene(spec);
  for (const double d : {-0.2, -1e-9, 0.0, 1e-9, 0.3}) {
    const Profile<double> shifted({0, 0.25, 0.5 + d, 1}, {1, 1, 0}, {1, 1, 0});
    EXPECT_NEAR(l1(scene, shifted, 2), std::abs(d), 1e-15) << d;
    EXPECT_NEAR(l1(scene, shifted, 0), std::abs(d), 1e-15) << d;
    EXPECT_NEAR(l1(scene, shifted, std::numeric_limits<double>::infinity()), std::abs(d), 1e-15) << d;
  }
  // Inside one cell: |1 - c| below the jump, c above it.
  const Profile<double> cell({0, 0.45, 0.7, 1}, {1, 0.3, 0}, {1, 0.3, 0});
  EXPECT_NEAR(l1(scene, cell, 2), 0.05 * 0.7 + 0.2 * 0.3, 1e-15);
}

// A moving shock: phi = 0.8 over 0.3 in one layer; speed a (0.8 + 0.3 - 1) = 0.1.
TEST(L1Error, AMovingShockInsideACell) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0.8, 0.3};
  const Scene<double> scene(spec);
  const ExactSolution<double> exact(scene);
  const double t = 0.2, z = 0.5 + 0.1 * t;
  const Profile<double> middle({0.45, 0.55}, {0.55}, {0.55});
  // Only the piece away from the walls' waves is in the profile, so compare pieces by hand.
  std::vector<double> edges{0, 0.45, 0.55, 1}, states{0, 0.55, 0};
  const double with = l1(scene, Profile<double>(edges, states, states), t);
  edges = {0, 0.45, z, 0.55, 1}, states = {0, 0.8, 0.3, 0};
  const double without = l1(scene, Profile<double>(edges, states, states), t);
  EXPECT_NEAR(with - without, 0.1 * 0.25, 1e-14);
}

TEST(L1Error, AnExactFanIsWithoutError) {
  FrontTrackingSolver::Options options{.resolution = 1e-4};
  options.reconstruct = Reconstruction::linear;
  SolverRequest request;
  request.times = {0.5};
  request.profiles = true;
  const auto result = solve<FrontTrackingSolver>(example_1(), request, options);
  EXPECT_LT(l1(example_1(), result.profiles.at(0), 0.5), 2e-15);
}

// A shock or kink is looked for to the last bit: there the exact solution must not have a hole either.
TEST(L1Error, OfAConstantAboveAllIsTheMassBetween) {
  const ExactSolution<double> exact(example_2());
  for (int i = 1; i <= 400; ++i) {
    const double t = 1.3 * i / 400;
    const auto errors = errors_against(exact, Profile<double>({0, 0.1, 0.9, 1}, {2, 2, 2}, {2, 2, 2}), t);
    EXPECT_NEAR(errors.l1, 1.5, errors.l1_bound) << t;
  }
}

double by_quadrature(const ExactSolution<double>& exact, const Profile<double>& profile, double t, int n) {
  CompensatedSum<double> sum;
  const double bottom = profile.z().front(), height = profile.z().back() - bottom;
  for (int i = 0; i < n; ++i) {
    const double z = bottom + height * ((i + 0.5) / n);
    sum += std::abs(profile.at(z).phi - exact.phi(z, t)) / n * height;
  }
  return sum.value();
}

struct Resolution {
  double track;
  std::uint64_t cells;
};

Profile<double> solved(const Scene<double>& scene, double t, const Resolution& resolution,
                       Reconstruction lines, bool tracked) {
  SolverRequest request;
  request.times = {t};
  request.profiles = true;
  if (!tracked) return solve<GodunovSolver>(scene, request, {{.cells = resolution.cells}}).profiles.at(0);
  FrontTrackingSolver::Options options{.resolution = resolution.track};
  options.reconstruct = lines;
  return solve<FrontTrackingSolver>(scene, request, options).profiles.at(0);
}

void expect_quadrature(const Scene<double>& scene, double t, int n) {
  const ExactSolution<double> exact(scene);
  for (const bool tracked : {false, true}) {
    for (const Reconstruction lines : {Reconstruction::constant, Reconstruction::linear}) {
      const Profile<double> profile = solved(scene, t, {0.07, 61}, lines, tracked);
      const auto errors = errors_against(exact, profile, t);
      // The midpoint rule misses up to half a step times the variation of the difference.
      const double variation = 2.0 * (1.0 + 2.0 * static_cast<double>(scene.initial_breaks().size()));
      EXPECT_NEAR(errors.l1, by_quadrature(exact, profile, t, n), 5 * variation / n);
      EXPECT_LT(errors.l1_bound, 1e-11);
    }
  }
}

TEST(L1Error, IsTheIntegralOnRandomScenes) {
  for (std::uint64_t number = 0; number < 12; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    support::SceneMaker maker(support::seed_of(9100 + number));
    const Scene<double> scene(maker.data(maker.integer(1, 6), maker.order(), 6));
    expect_quadrature(scene, maker.uniform(0.05, 4), 20'000);
  }
  for (const double t : {0.03, 0.2, 0.6, 1.0}) expect_quadrature(example_2(), t, 20'000);
}

// c(z) itself makes states of a profile, not its means over the pieces that stand for the bed: lines through the exact solution
// leave what lines leave. (They left 2.9e-4 more at 64 pieces, 3.6e-5 at 1024, whatever the number of lines.)
TEST(L1Error, OfLinesThroughTheSolutionWhereTheSolidFractionVaries) {
  SceneSpec<double> spec = example_2().spec();
  spec.solid_fraction = Table<double>{{0, 0.5, 1}, {0.62, 0.55, 0.4}};
  const ExactSolution<double> exact(Scene<double>(spec), {.layers = 64, .tolerance = 1e-6});
  constexpr double kTime = 0.4;
  for (const int n : {500, 1000}) {
    std::vector<double> z, below, above;
    for (int i = 0; i <= n; ++i) z.push_back(static_cast<double>(i) / n);
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      below.push_back(exact.at(z[i], kTime).phi);
      above.push_back(exact.at(z[i + 1], kTime).phi);
    }
    const Profile<double> lines(z, below, above);
    const double l1 = errors_against(exact, lines, kTime).l1;
    EXPECT_LT(l1, 0.3 / n) << n;  // of the cell with the shock, of kinks at the ends of fans and pieces
    EXPECT_NEAR(l1, by_quadrature(exact, lines, kTime, 50'000), 0.01 * l1) << n;
  }
}

TEST(SlowL1Error, IsTheIntegralOfAMillionPoints) {
  support::SceneMaker maker(support::seed_of(9200));
  expect_quadrature(Scene<double>(maker.data(5, support::SceneMaker::Order::random, 5)), 0.7, 1'000'000);
  expect_quadrature(example_1(), 3, 1'000'000);
}

// Coarse lines through curved fans: the difference changes its sign more than once in a cell.
TEST(L1Error, SeveralChangesOfSignInACell) {
  const ExactSolution<double> exact(example_2());
  for (const double t : {0.1, 0.25}) {
    for (const double shift : {-0.01, -1e-3, -1e-4, 0.0, 1e-4, 1e-3, 0.01}) {
      std::vector<double> z, below, above;
      for (int i = 0; i <= 10; ++i) z.push_back(i / 10.0);
      for (int i = 0; i < 10; ++i) {
        below.push_back(exact.phi(z[static_cast<std::size_t>(i)], t) + shift);
        above.push_back(exact.phi(z[static_cast<std::size_t>(i) + 1] - 1e-9, t) + shift);
      }
      const Profile<double> profile(z, below, above);
      EXPECT_NEAR(errors_against(exact, profile, t).l1, by_quadrature(exact, profile, t, 50'000), 2e-5);
    }
  }
}

template <class To>
Profile<To> cast(const Profile<double>& p) {
  const auto numbers = [](const std::vector<double>& xs) { return std::vector<To>(xs.begin(), xs.end()); };
  return {numbers(p.z()), numbers(p.below()), numbers(p.above())};
}

TEST(L1Error, KeepsItsBoundAgainstFiftyDigits) {
  for (std::uint64_t number = 0; number < 6; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    support::SceneMaker maker(support::seed_of(9300 + number));
    const Scene<double> scene(number == 0 ? example_2().spec()
                                          : maker.data(maker.integer(1, 4), maker.order(), 3));
    const double t = maker.uniform(0.1, 2);
    for (const bool tracked : {false, true}) {
      const Profile<double> profile = solved(scene, t, {0.1, 40}, Reconstruction::linear, tracked);
      const auto errors = errors_against(ExactSolution<double>(scene), profile, t);
      const ExactSolution<Real110> precise(scene_cast<Real110>(scene));
      const auto truth = errors_against(precise, cast<Real110>(profile), Real110(t));
      EXPECT_NEAR(errors.l1, to_double(truth.l1), errors.l1_bound);
      EXPECT_NEAR(errors.M_max, to_double(truth.M_max), 1e-14);
      EXPECT_LT(to_double(truth.l1_bound), 1e-45);
    }
  }
}

}  // namespace
}  // namespace shearfront
