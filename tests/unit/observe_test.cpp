// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/observe.hpp"

#include <gtest/gtest.h>

#include <boost/random/mersenne_twister.hpp>
#include <cmath>
#include <string>

#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

Scene<double> may(double bottom = 0, double top = 1) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{bottom + 0.29 * (top - bottom)}, {2.4, 0.31}};
  spec.initial_breaks = {(bottom + top) / 2};
  spec.initial_values = {0, 1};
  spec.bottom = bottom;
  spec.top = top;
  return Scene<double>(spec);
}

Observations observed(const ObservationPlan& plan, const Scene<double>& scene) {
  return observe(plan, scene, solve<ExactSolver>(scene, request_of(plan, scene)));
}

std::string complaints(const ObservationPlan& plan) {
  std::string all;
  for (const Complaint& complaint : find_complaints(plan, 0, 1)) all += complaint.text() + "\n";
  return all;
}

/// n rows of zeros with noise.
Observations noise(std::size_t n, double sigma, std::uint64_t seed, std::uint64_t replicate = 0) {
  Observations data;
  data.rows.resize(n);
  add_noise(data, sigma, seed, replicate);
  return data;
}

double correlation(const Observations& a, const Observations& b, std::size_t lag) {
  double sum = 0;
  for (std::size_t i = lag; i < a.rows.size(); ++i) sum += a.rows[i].value * b.rows[i - lag].value;
  return sum / static_cast<double>(a.rows.size() - lag);
}

TEST(Observe, PointsAndCumulativeAreTheSamples) {
  const Scene<double> scene = may();
  const Observations points = observed({{0, 1}, {0.75, 0.25}, Quantity::point, 0}, scene);
  ASSERT_EQ(points.rows.size(), 4u);
  EXPECT_EQ(points.rows[0].value, 1);
  EXPECT_EQ(points.rows[1].z, 0.25);
  EXPECT_EQ(points.rows[2].t, 1);
  const double expected = 0.5 + 0.25 / (2 * 0.31);  // inside the fan of the upper layer
  EXPECT_NEAR(points.rows[2].value, expected, 1e-15);
  EXPECT_FALSE(points.has_sigma());
  const Observations sums = observed({{0}, {0.75, 1}, Quantity::cumulative, 0}, scene);
  EXPECT_EQ(sums.rows[0].value, 0.25);
  EXPECT_EQ(sums.rows[1].value, 0.5);
}

/// Bins that fill the domain contain the whole mass, also where the ends of the domain are no doubles.
TEST(Observe, BinsHoldTheMass) {
  const Scene<double> scene = may(0.1, 0.7);
  for (const std::size_t n : {1U, 3U, 7U, 10U, 33U}) {
    const double width = 0.6 / static_cast<double>(n);
    ObservationPlan plan{{0, 0.3, 5}, {}, Quantity::bin, width};
    for (std::size_t i = 0; i < n; ++i) plan.depths.push_back(0.1 + width * (static_cast<double>(i) + 0.5));
    const Observations bins = observed(plan, scene);
    for (std::size_t k = 0; k < 3; ++k) {
      double mass = 0;
      for (std::size_t i = 0; i < n; ++i) mass += width * bins.rows[k * n + i].value;
      EXPECT_NEAR(mass, scene.mass(), 1e-14) << n;
    }
    EXPECT_EQ(bins.rows[0].width, width);
  }
}

TEST(Observe, BinIsTheMeanOverItsInterval) {
  const Observations bin = observed({{0}, {0.5, 0.475}, Quantity::bin, 0.1}, may());
  EXPECT_NEAR(bin.rows[0].value, 0.5, 1e-15);
  EXPECT_NEAR(bin.rows[1].value, 0.25, 1e-15);
}

TEST(Observe, PlansAreChecked) {
  EXPECT_EQ(complaints({{0, 1}, {0, 1}, Quantity::point, 0}), "");
  EXPECT_EQ(complaints({{-1, INFINITY}, {1.5}, Quantity::point, 0}),
            "times[0] = -1; must be a finite number >= 0\ntimes[1] = inf; must be a finite number >= 0\n"
            "depths[0] = 1.5; must be inside the domain [0, 1]\n");
  EXPECT_EQ(complaints({{1, 2, 1}, {0.5, 0.5}, Quantity::point, 0}),
            "times[2] = 1; must not be given twice\ndepths[1] = 0.5; must not be given twice\n");
  EXPECT_EQ(complaints({{0}, {0.95}, Quantity::bin, 0.2}),
            "depths[0] = 0.95; must leave its bin of width 0.2 inside the domain [0, 1]\n");
  EXPECT_EQ(complaints({{0}, {0.5}, Quantity::bin, 0}), "width = 0; must be > 0\n");
  EXPECT_EQ(complaints({{0}, {0.5}, Quantity::bin, 1e-12}),
            "width = 1e-12; must be at least 1e-08 of every depth\n");
  EXPECT_EQ(complaints({{0}, {0.5}, Quantity::point, 0.1}),
            "width = 0.1; must be 0 unless bins are observed\n");
  EXPECT_THROW((void)request_of({{-1}, {0.5}, Quantity::point, 0}, may()), InputError);
}

TEST(Observe, EqualSpacing) {
  EXPECT_EQ(equal_spacing({0.5}), std::nullopt);
  EXPECT_EQ(equal_spacing({0.25, 0.75, 0.5}), 0.25);
  EXPECT_EQ(equal_spacing({0.1, 0.2, 0.3, 0.4}), 0.1);
  EXPECT_EQ(equal_spacing({0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 0.95}), 0.1);
  EXPECT_NEAR(equal_spacing({0, 1.0 / 3, 2.0 / 3}).value(), 1.0 / 3, 1e-15);
  EXPECT_EQ(equal_spacing({0.1, 0.2, 0.31}), std::nullopt);
  EXPECT_EQ(equal_spacing({0.5, 0.5}), std::nullopt);
  std::vector<double> many;
  for (int i = 0; i < 1000; ++i) many.push_back(1e6 + 1e-3 * (2 * i + 1));
  EXPECT_EQ(equal_spacing(many), 2e-3);
}

TEST(Noise, IsReproducible) {
  const Observations a = noise(1000, 0.1, 7), b = noise(1000, 0.1, 7), longer = noise(1001, 0.1, 7);
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(a.rows[i].value, b.rows[i].value);
    EXPECT_EQ(a.rows[i].value, longer.rows[i].value);
    EXPECT_EQ(a.rows[i].sigma, 0.1);
  }
  EXPECT_NE(a.rows[0].value, noise(1, 0.1, 8).rows[0].value);
  EXPECT_NE(a.rows[0].value, noise(1, 0.1, 7, 1).rows[0].value);
}

/// The generator is the documented one: Matsumoto & Nishimura's 10000th number, as the C++ standard states
/// it.
TEST(Noise, GeneratorIsTheStandardOne) {
  boost::random::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042U);
}

/// Snapshot: a change of these numbers would change everybody's synthetic data.
TEST(Noise, Snapshot) {
  EXPECT_EQ(stream_seed(0, 0), 12035550249420947055U);
  EXPECT_EQ(stream_seed(1, 0), 6791897765849424158U);
  const Observations data = noise(3, 1, 1);
  EXPECT_EQ(data.rows[0].value, -0.86978418746455999);
  EXPECT_EQ(data.rows[1].value, -0.19473038653323846);
  EXPECT_EQ(data.rows[2].value, -0.86752400175103495);
}

/// Moments and the distribution function of 1e5 numbers, with bounds at five standard errors; the seed is
/// fixed.
TEST(Noise, IsStandardNormal) {
  constexpr std::size_t kN = 100000;
  const Observations data = noise(kN, 1, 20);
  const double n = kN, five = 5 / std::sqrt(n);
  double mean = 0, square = 0, fourth = 0;
  std::vector<double> below(5, 0.0);
  const std::vector<double> at{-2, -1, 0, 1, 2};
  for (const Observation& o : data.rows) {
    mean += o.value / n;
    square += o.value * o.value / n;
    fourth += std::pow(o.value, 4) / n;
    for (std::size_t k = 0; k < at.size(); ++k) below[k] += o.value < at[k] ? 1 / n : 0;
  }
  EXPECT_NEAR(mean, 0, five);
  EXPECT_NEAR(square, 1, std::sqrt(2.0) * five);
  EXPECT_NEAR(fourth, 3, std::sqrt(96.0) * five);
  for (std::size_t k = 0; k < at.size(); ++k)
    EXPECT_NEAR(below[k], std::erfc(-at[k] / std::sqrt(2.0)) / 2, five / 2);
}

TEST(Noise, ReplicatesAndRowsAreIndependent) {
  constexpr std::size_t kN = 100000;
  const double five = 5 / std::sqrt(static_cast<double>(kN));
  const Observations first = noise(kN, 1, 1);
  for (std::uint64_t replicate = 1; replicate < 6; ++replicate)
    EXPECT_NEAR(correlation(first, noise(kN, 1, 1, replicate), 0), 0, five) << replicate;
  EXPECT_NEAR(correlation(first, noise(kN, 1, 2), 0), 0, five);
  EXPECT_NEAR(correlation(first, noise(kN, 1, 2), 1), 0, five);
  EXPECT_NEAR(correlation(first, first, 1), 0, five);
}

TEST(Noise, ZeroChangesNothing) {
  const Observations data = noise(2, 0, 1);
  EXPECT_EQ(data.rows[1].value, 0);
  EXPECT_FALSE(data.has_sigma());
}

TEST(Noise, ClipKeepsToTheRange) {
  Observations points;
  points.rows = {{0, 0.5, -0.1, 0, 0.1}, {0, 0.5, 0.4, 0, 0.1}, {0, 0.5, 1.1, 0, 0.1}};
  clip(points, may());
  EXPECT_EQ(points.rows[0].value, 0);
  EXPECT_EQ(points.rows[1].value, 0.4);
  EXPECT_EQ(points.rows[2].value, 1);
  EXPECT_EQ(points.rows[2].sigma, 0.1);
  Observations sums;
  sums.quantity = Quantity::cumulative;
  sums.rows = {{0, 2, 5}, {0, 2, -5}};
  clip(sums, may(1, 3));
  EXPECT_EQ(sums.rows[0].value, 1);
  EXPECT_EQ(sums.rows[1].value, 0);
}

}  // namespace
}  // namespace shearfront
