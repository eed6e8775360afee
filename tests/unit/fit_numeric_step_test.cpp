// SPDX-License-Identifier: BSD-3-Clause
// Noise of computed functions, and derivatives by differences of it.
#include "shearfront/fit/numeric_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shearfront/solver/all.hpp"
#include "support/identification.hpp"
#include "support/random_scene.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Nine values of a smooth function at steps of 1e-7 with uniform noise of standard deviation sigma.
VectorXd noisy_values(support::SceneMaker& make, double sigma) {
  VectorXd values(9);
  for (Index k = 0; k < values.size(); ++k)
    values[k] = std::sin(1 + 1e-7 * static_cast<double>(k)) + sigma * make.uniform(-1, 1) * std::sqrt(3.0);
  return values;
}

TEST(ComputationalNoise, IsFoundWithinAFactorFour) {
  support::SceneMaker make(support::seed_of(1));
  for (const double sigma : {1e-13, 1e-10, 1e-6, 1e-3}) {
    int close = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const double noise = computational_noise(noisy_values(make, sigma));
      close += noise >= sigma / 4 && noise <= 4 * sigma ? 1 : 0;
    }
    EXPECT_GE(close, 170) << sigma;  // Some tables show no order with agreeing estimates.
  }
}

TEST(ComputationalNoise, IsNoneWhereThereIsNone) {
  VectorXd values(9);
  for (Index k = 0; k < values.size(); ++k) values[k] = 0.25 * static_cast<double>(k * k * k);
  EXPECT_EQ(computational_noise(values), 0);
  EXPECT_EQ(computational_noise(VectorXd::Constant(9, 0.3)), 0);
  EXPECT_EQ(computational_noise(VectorXd::Constant(3, 0.3)), 0) << "too few values";
}

TEST(NumericSteps, BalanceNoiseAndCurvature) {
  for (const double sigma : {1e-12, 1e-9, 1e-6}) {
    support::SceneMaker make(support::seed_of(2));
    const ResidualFunction residuals = [&](const VectorXd& u) -> VectorXd {
      VectorXd r(50);
      for (Index i = 0; i < r.size(); ++i)
        r[i] = std::sin(u[0] + static_cast<double>(i)) + sigma * make.uniform(-1, 1) * std::sqrt(3.0);
      return r;
    };
    const VectorXd u = VectorXd::Constant(1, 0.7), at_u = residuals(u);
    const double h = numeric_steps(residuals, u, at_u, 1e-9, 1)[0];
    EXPECT_GE(h, std::cbrt(3 * sigma) / 4) << sigma;
    EXPECT_LE(h, std::cbrt(3 * sigma) * 4) << sigma;
    const VectorXd d = difference(residuals, u, at_u, 0, h);
    for (Index i = 0; i < d.size(); ++i)
      EXPECT_NEAR(d[i], std::cos(0.7 + static_cast<double>(i)), 20 * std::cbrt(sigma * sigma)) << sigma;
  }
}

TEST(Difference, IsOneSidedWhereOneSideHasNoSolution) {
  const ResidualFunction root = [](const VectorXd& u) -> VectorXd {
    if (u[0] > 1) return {};
    return VectorXd::Constant(1, 3 * u[0]);
  };
  const VectorXd u = VectorXd::Constant(1, 1.0), at_u = root(u);
  EXPECT_NEAR(difference(root, u, at_u, 0, 1e-6)[0], 3, 1e-8);
  const ResidualFunction nowhere = [](const VectorXd&) -> VectorXd { return {}; };
  EXPECT_TRUE(std::isnan(difference(nowhere, u, at_u, 0, 1e-6)[0]));
}

Estimate fit_example_3_by_tracking(double resolution, Quantity quantity) {
  const support::Identification problem = support::example_3();
  FitSpec spec = support::fit_of(problem, support::exact_data(problem, quantity));
  spec.forward.method = Method::of<FrontTrackingSolver>({.resolution = resolution});
  spec.forward.method.prefer_smooth(spec.scene);
  return fit(spec);
}

TEST(NumericDerivatives, ServeFrontTracking) {
  const support::Identification problem = support::example_3();
  // The tracker's M is second order in the resolution.
  EXPECT_LE(problem.error(fit_example_3_by_tracking(0.01, Quantity::cumulative)), 4e-3);
  EXPECT_LE(problem.error(fit_example_3_by_tracking(0.0025, Quantity::cumulative)), 3e-4);
  EXPECT_LE(problem.error(fit_example_3_by_tracking(0.01, Quantity::point)), 4e-3);
  // The misfit of points has a kink wherever a front passes one of them, and a search may stall there, by
  // chance of the last bits of the resolution's polygon: the median of three counts.
  std::vector<double> errors;
  for (const double resolution : {0.003, 0.0025, 0.0024})
    errors.push_back(problem.error(fit_example_3_by_tracking(resolution, Quantity::point)));
  std::sort(errors.begin(), errors.end());
  EXPECT_LE(errors[1], 3e-4);
}

TEST(NumericDerivatives, EndWhereASearchWithoutThemEnds) {
  const support::Identification problem = support::example_3();
  FitSpec spec = support::fit_of(problem, support::exact_data(problem, Quantity::cumulative));
  EngquistOsherSolver::Options options;
  options.cells = 100;
  spec.forward.method = Method::of<EngquistOsherSolver>(options);
  const Estimate with = fit(spec);
  spec.search.algorithm = "nlopt:nelder-mead";
  const Estimate without = fit(spec);
  EXPECT_LE(with.misfit, without.misfit * (1 + 1e-4));
}

}  // namespace
}  // namespace shearfront::fit
