// SPDX-License-Identifier: BSD-3-Clause
// Beds that linear pieces stand for, against the same beds in another guise that is solved exactly.
#include <gtest/gtest.h>

#include <any>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"

namespace shearfront {
namespace {

SceneSpec<double> mixed() {
  SceneSpec<double> spec;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0.1, 0.9};
  return spec;
}

const std::vector<double> kTimes{0.1, 0.4, 1, 2, 4};

/// exp(-3 z) in a bed of temperature 4 exp(-z / 1.5) is the exponential shear rate exp(-z / 0.3) of scale 2.
SceneSpec<double> exponential_in_disguise(SceneSpec<double> spec) {
  spec.shear_rate = Exponential<double>{1, 1.0 / 3};
  spec.temperature = Exponential<double>{4, 1.5};
  return spec;
}
/// The root of a line is neither linear nor exponential.
SceneSpec<double> chute_with_temperature(SceneSpec<double> spec) {
  spec.shear_rate = Chute<double>{0.5, 0.2, 0.4};
  spec.temperature = Table<double>{{0, 1}, {4, 1}};
  return spec;
}

TEST(Tolerance, BoundsMBesideATemperature) {
  auto spec = mixed();
  spec.shear_rate = Exponential<double>{1, 0.3};
  spec.scale = 2;
  const ExactSolution<double> exact{Scene<double>(spec)};
  ASSERT_TRUE(exact.is_exact());
  spec.scale = 1;
  spec = exponential_in_disguise(spec);
  for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
    const ExactSolution<double> pieces(Scene<double>(spec), {.tolerance = tolerance});
    EXPECT_FALSE(pieces.is_exact());
    EXPECT_TRUE(pieces.meets_tolerance());
    EXPECT_EQ(pieces.resolution(), ExactSolution<double>::kFirstPieces);  // of the right form
    for (const double t : kTimes)
      for (int i = 1; i < 50; ++i) EXPECT_NEAR(pieces.M(i / 50.0, t), exact.M(i / 50.0, t), 4e-15);
  }
}

/// 8192 pieces stand for the truth: they are off by 1/64 of what 1024 are at most.
TEST(Tolerance, BoundsMBesideALinearTemperature) {
  const auto spec = chute_with_temperature(mixed());
  const ExactSolution<double> exact(Scene<double>(spec), {.layers = 8192});
  std::size_t n_last = 0;
  for (const double tolerance : {1e-3, 1e-5, 1e-6, 1e-7}) {
    const ExactSolution<double> pieces(Scene<double>(spec), {.tolerance = tolerance});
    EXPECT_FALSE(pieces.is_exact());
    EXPECT_TRUE(pieces.meets_tolerance());
    EXPECT_GE(pieces.n_layers(), n_last);
    n_last = pieces.n_layers();
    for (const double t : kTimes)
      for (int i = 1; i < 50; ++i)
        EXPECT_NEAR(pieces.M(i / 50.0, t), exact.M(i / 50.0, t), tolerance) << "z " << i / 50.0 << " t " << t;
  }
  EXPECT_GT(n_last, 128u);
}

/// c = 0.6 exp(-z / 2) under a constant shear rate: with dy = c dz the rate is a (0.6 - y / 2), one linear piece.
TEST(Tolerance, BoundsMOfASmoothSolidFraction) {
  const double decay = 2, c0 = 0.6, height = c0 * decay * -std::expm1(-1 / decay);
  auto image = mixed();
  const auto y = [&](double z) { return c0 * decay * -std::expm1(-z / decay); };
  image.top = height;
  image.initial_breaks = {y(0.5)};
  image.shear_rate = Table<double>{{0, height}, {3 * c0, 3 * (c0 - height / decay)}};
  const ExactSolution<double> exact{Scene<double>(image)};
  ASSERT_TRUE(exact.is_exact());
  auto spec = mixed();
  spec.shear_rate = Piecewise<double>{{}, {3}};
  spec.solid_fraction = Exponential<double>{c0, decay};
  for (const double tolerance : {1e-4, 1e-6}) {
    const ExactSolution<double> pieces(Scene<double>(spec), {.tolerance = tolerance});
    EXPECT_TRUE(pieces.meets_tolerance());
    for (const double t : kTimes)
      for (int i = 1; i < 50; ++i) {
        const double z = i / 50.0;
        EXPECT_NEAR(pieces.M(z, t), exact.M(y(z), t), tolerance) << "z " << z << " t " << t;
      }
  }
}

TEST(Tolerance, IsSaidToBeMissed) {
  auto spec = mixed();
  spec = chute_with_temperature(spec);
  const Scene<double> scene(spec);
  const ExactSolution<double> pieces(scene, {.tolerance = 1e-13});
  EXPECT_FALSE(pieces.meets_tolerance());
  EXPECT_EQ(pieces.resolution(), ExactSolution<double>::kMostPieces);
  const auto run = ExactSolver::start(scene, {.tolerance = 1e-13}, {});
  run->advance(1);
  (void)run->field().at(0.3);
  EXPECT_NE(run->summary().message.find("although the tolerance of 1e-13 takes more"), std::string::npos)
      << run->summary().message;
}

/// The last grain passes the top of a throat: event times change by less than is stated when pieces are quartered.
TEST(Tolerance, StatesTheErrorOfEventTimes) {
  auto spec = chute_with_temperature(mixed());
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  const auto exact = exact_timeline(ExactSolution<double>(scene, {.layers = 8192}));
  const ExactSolution<double> pieces(scene);
  EXPECT_LT(pieces.n_layers(), 2048u);
  const auto times = exact_timeline(pieces);
  const double stated = timeline_error(pieces, times);
  EXPECT_GT(stated, 0);
  EXPECT_LT(stated, 1e-3);
  for (const auto member : {&Timeline<double>::t0, &Timeline<double>::t1, &Timeline<double>::t_star})
    EXPECT_NEAR(*(times.*member), *(exact.*member), stated);
}

/// A fit asks for the solution again and again: with the pieces of the first time.
TEST(Tolerance, ChoosesPiecesOncePerFit) {
  auto spec = mixed();
  spec = chute_with_temperature(spec);
  std::any memory;
  const std::vector<Place> places{{0.5, 0.3}, {1, 0.6}};
  const auto first = ExactSolver::linearise(Scene<double>(spec), {}, places, {}, memory);
  const auto again = ExactSolver::linearise(Scene<double>(spec), {}, places, {}, memory);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(first.samples[i].M, again.samples[i].M);
}

}  // namespace
}  // namespace shearfront
