// SPDX-License-Identifier: BSD-3-Clause
// Tables as a laboratory measures them: no stairs in the answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/io/scene_file.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront {
namespace {

Scene<double> read(const std::string& name) {
  return Scene<double>(read_scene<double>(SHEARFRONT_SOURCE_DIR "/tests/cases/inputs/" + name));
}

TEST(Tables, FirstArrivalsAreSumsOfLogarithms) {
  // a: 2 to 1 over 0.3, then with the slope -4/3 from 1 up to the jump at 0.5.
  const auto events = exact_timeline(read("falling-table.toml"));
  const double t0 = 0.3 * std::log(2) + 0.75 * std::log(1 / (1 - 0.2 * 4 / 3));
  EXPECT_NEAR(*events.t0, t0, 1e-15);
}

TEST(Tables, OfAnExponentialTendToIt) {
  const Scene<double> smooth = read("exponential.toml");
  const ExactSolution<double> exact(smooth);
  ASSERT_TRUE(exact.is_exact());
  std::vector<double> M_errors, phi_errors;
  const std::vector<int> knots{32, 64, 128, 256, 1000};
  for (const int n : knots) {
    SceneSpec<double> spec = smooth.spec();
    Table<double> table;
    for (int i = 0; i < n; ++i) {
      table.z.push_back(42.0 * i / (n - 1));
      table.values.push_back(0.31 * std::exp(-table.z.back() / 13));
    }
    spec.shear_rate = table;
    const ExactSolution<double> pieces{Scene<double>(spec)};
    double M_error = 0, phi_error = 0;
    int n_points = 0;
    for (const double t : {30.0, 100.0, 300.0})
      for (int i = 1; i < 60; ++i) {
        const double z = 42.0 * i / 60 + 0.013;
        const auto a = exact.at(z, t), b = pieces.at(z, t);
        M_error = std::max(M_error, std::abs(a.M - b.M));
        if (std::abs(a.phi - b.phi) > 0.05) continue;  // a shock between
        phi_error += std::abs(a.phi - b.phi);
        ++n_points;
      }
    EXPECT_GE(n_points, 170);
    M_errors.push_back(M_error / 42);
    phi_errors.push_back(phi_error / n_points);
  }
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_NEAR(std::log2(M_errors[k - 1] / M_errors[k]), 2, 0.2) << knots[k];
    EXPECT_GT(std::log2(phi_errors[k - 1] / phi_errors[k]), 1.4) << knots[k];
  }
  EXPECT_LT(M_errors.back(), 1e-6);
}

/// Inside a fan phi rises with the height, in every step: a staircase would keep it constant in each of its layers.
TEST(Tables, HaveFansWithoutBlocks) {
  const ExactSolution<double> exact(read("bed-42mm.toml"));
  const int n = 4200;
  int n_steps = 0;
  for (const double t : {20.0, 60.0, 200.0}) {
    auto path = exact.path(0, t);
    double phi = exact.phi(0, t);
    for (int i = 1; i <= n; ++i) {
      const double z = 42.0 * i / n, next = exact.phi(z, t);
      const auto other = exact.path(z, t);
      const bool is_same = other.kind == exact::PathKind::fan && path.kind == other.kind &&
                           path.source == other.source && path.turned == other.turned &&
                           path.upward == other.upward;
      if (is_same) {
        EXPECT_GT(next, phi) << "z " << z << " t " << t;
        EXPECT_LT(next, phi + 0.02) << "z " << z << " t " << t;
        ++n_steps;
      }
      path = other;
      phi = next;
    }
  }
  EXPECT_GT(n_steps, 3000);
}

/// Godunov's scheme on 12800 cells, extrapolated: 7.9505.
TEST(Tables, TwoThroatsLetGrainsThroughOneAfterTheOther) {
  EXPECT_NEAR(*exact_timeline(read("two-throats.toml")).t_star, 7.950504, 1e-6);
}

/// All values of a measured shear rate from exact data, the start a bed of flat pieces in which fans stand still at their source.
TEST(Tables, AllValuesAreFoundAgain) {
  const SceneSpec<double> truth = read("bed-42mm.toml").spec();
  const ObservationPlan plan{
      {10, 30, 60, 70, 80, 90, 100, 120, 240},
      {0.3, 0.7, 1.1, 1.4, 2, 3, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40},
      Quantity::cumulative,
      0};
  SceneSpec<double> start = truth;
  const std::vector<double> wanted = std::get<Table<double>>(truth.shear_rate).values;
  std::get<Table<double>>(start.shear_rate).values = {0.2, 0.2,  0.2,  0.15, 0.15, 0.1,
                                                      0.1, 0.06, 0.06, 0.03, 0.03, 0.01};
  const fit::Estimate estimate =
      fit::fit(support::fit_of(start, support::observed(truth, plan, 0, 1, false), {"shear_rate.values"}));
  ASSERT_TRUE(estimate.usable());
  ASSERT_EQ(estimate.parameters.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(estimate.parameters[i].estimate, wanted[i], 1e-9) << i;
}

}  // namespace
}  // namespace shearfront
