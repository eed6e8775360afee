// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/residual_structure.hpp"

#include <gtest/gtest.h>

#include <boost/random/exponential_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <functional>
#include <numbers>

namespace shearfront::fit {
namespace {

using Engine = boost::random::mt19937_64;

/// Data of so many times and heights whose value is minus the residual: the prediction is 0.
Observations residuals(int n_times, int n_heights, const std::function<double(double, double)>& value) {
  Observations data;
  for (int i = 0; i < n_times; ++i)
    for (int j = 0; j < n_heights; ++j) {
      Observation o;
      o.t = 1 + i;
      o.z = (j + 0.5) / n_heights;
      o.value = value(o.t, o.z);
      data.rows.push_back(o);
    }
  return data;
}

std::optional<ResidualStructure> structure_of(const Observations& data) {
  return residual_structure(data, std::vector<double>(data.rows.size(), 0.0));
}

double alarm_rate(int n, const std::function<double(double, double)>& value, int n_times = 8,
                  int n_heights = 15) {
  int alarms = 0;
  for (int b = 0; b < n; ++b)
    alarms += structure_of(residuals(n_times, n_heights, value))->is_structured ? 1 : 0;
  return static_cast<double>(alarms) / n;
}

// 2000 trials at the level 1 %: standard deviation 0.22 %. The three tests are not independent, so a little
// below 1 % is expected.
TEST(FitResidualStructure, FalseAlarmsAtTheLevel) {
  Engine engine(1);
  boost::random::normal_distribution<double> normal;
  const double rate = alarm_rate(2000, [&](double, double) { return normal(engine); });
  EXPECT_LE(rate, 0.0166);
  EXPECT_GE(rate, 0.0034);
}

TEST(FitResidualStructure, UnequalVariancesAndGrossErrorsAreNoStructure) {
  Engine engine(2);
  boost::random::normal_distribution<double> normal;
  int k = 0;
  const auto value = [&](double, double z) {
    const double noise = normal(engine) * (z > 0.6 ? 10 : 1);
    return ++k % 40 == 0 ? noise + std::copysign(1000, normal(engine)) : noise;
  };
  EXPECT_LE(alarm_rate(1000, value), 0.019);  // 1 % + 3 standard deviations
}

TEST(FitResidualStructure, SkewedNoiseIsNoStructure) {
  Engine engine(3);
  boost::random::exponential_distribution<double> waiting;
  EXPECT_LE(alarm_rate(1000, [&](double, double) { return waiting(engine) - 1; }), 0.03);
}

TEST(FitResidualStructure, SeesASineOfTheSizeOfTheNoise) {
  Engine engine(4);
  boost::random::normal_distribution<double> normal;
  const auto value = [&](double, double z) {
    return 1.5 * std::sin(2 * std::numbers::pi * z) + normal(engine);
  };
  EXPECT_GE(alarm_rate(200, value), 0.95);
  EXPECT_EQ(alarm_rate(50, [&](double,
                               double z) { return 3 * std::sin(2 * std::numbers::pi * z) + normal(engine); }),
            1);
}

TEST(FitResidualStructure, CorrelationsOfKnownSequences) {
  // Alternating over the heights, equal over the times: correlations -1 and 1.
  const auto s = structure_of(
      residuals(10, 10, [](double, double z) { return static_cast<int>(z * 10) % 2 == 0 ? 1.0 : -1.0; }));
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->lag1_height, -1, 1e-12);
  EXPECT_NEAR(s->lag1_time, 1, 1e-12);
  // 10 runs each, (9 + 1) expected 6, variance 4 * 5 * 5 * (50 - 10) / (100 * 9) / ... = 20 / 9 each.
  EXPECT_NEAR(s->runs_z_score, 10 * 4 / std::sqrt(10 * 20.0 / 9), 1e-12);
  EXPECT_TRUE(s->is_structured);
}

TEST(FitResidualStructure, RunsAreCountedAsByWaldAndWolfowitz) {
  // + + - - - + with 3 zeros between: n+ = 3, n- = 3, 3 runs; E = 4, Var = 18 * 12 / (36 * 5) = 1.2.
  const double pattern[] = {1, 0, 2, -1, -3, 0, -2, 5, 0};
  int k = 0;
  const auto s = structure_of(residuals(6, 9, [&](double, double) { return pattern[k++ % 9]; }));
  ASSERT_TRUE(s);
  EXPECT_NEAR(s->runs_z_score, 6 * (3 - 4) / std::sqrt(6 * 1.2), 1e-12);
}

TEST(FitResidualStructure, TooFewPairsGiveNothing) {
  EXPECT_FALSE(structure_of(residuals(1, 19, [](double, double z) { return z - 0.5; })));
  const auto s = structure_of(residuals(1, 21, [](double, double z) { return z - 0.5; }));
  ASSERT_TRUE(s);
  EXPECT_TRUE(std::isnan(s->lag1_time));
  EXPECT_TRUE(s->is_structured);
  EXPECT_FALSE(structure_of({}));
}

TEST(FitResidualStructure, RoundingIsNoStructure) {
  const Observations data = residuals(10, 10, [](double t, double z) { return t * z; });
  std::vector<double> predicted;
  for (const Observation& o : data.rows) predicted.push_back(o.value * (1 + 1e-12));
  EXPECT_FALSE(residual_structure(data, predicted));
}

TEST(FitResidualStructure, MissingPredictionsAreSkipped) {
  Engine engine(5);
  boost::random::normal_distribution<double> normal;
  const Observations data = residuals(10, 10, [&](double, double) { return normal(engine); });
  std::vector<double> predicted(data.rows.size(), 0.0);
  predicted[7] = predicted[50] = std::nan("");
  const auto s = residual_structure(data, predicted);
  ASSERT_TRUE(s);
  EXPECT_LT(std::abs(s->lag1_height), 0.3);
  EXPECT_FALSE(s->is_structured);
}

}  // namespace
}  // namespace shearfront::fit
