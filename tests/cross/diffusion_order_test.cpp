// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "support/diffusion_problems.hpp"

namespace shearfront::diffusion {
namespace {

using support::Errors;

TEST(DiffusionOrder, Kink) {
  // Halving dt and dz from 0.005: the source's sequence from 0.02 on begins with kinks of one cell's width.
  Errors last;
  for (std::size_t n = 200; n <= 1600; n *= 2) {
    const Errors error = support::kink_errors(n, 1.0 / static_cast<double>(n));
    if (n > 200) {
      EXPECT_NEAR(std::log2(last.max / error.max), 2, 0.05) << n;
      EXPECT_NEAR(std::log2(last.l2 / error.l2), 2, 0.05) << n;
      EXPECT_NEAR(std::log2(last.h1 / error.h1), 2, 0.05) << n;
    }
    last = error;
  }
}

class DiffusionOrderOfBurgers : public ::testing::TestWithParam<double> {};

TEST_P(DiffusionOrderOfBurgers, IsTwo) {
  const double mu = GetParam();
  // For mu = 0.01 the front, 0.04 wide, takes more cells than the smooth cases.
  const std::size_t coarse = mu < 0.1 ? 1000 : 100;
  const Errors first = support::burgers_errors(coarse, 2.0 / static_cast<double>(coarse), mu, 2);
  const Errors second = support::burgers_errors(2 * coarse, 1.0 / static_cast<double>(coarse), mu, 2);
  EXPECT_NEAR(std::log2(first.max / second.max), 2, 0.05);
  EXPECT_NEAR(std::log2(first.l2 / second.l2), 2, 0.05);
  EXPECT_NEAR(std::log2(first.h1 / second.h1), 2, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Viscosities, DiffusionOrderOfBurgers, ::testing::Values(1.0, 0.1, 0.01));

/// Largest error at t = 0.1, 0.5, 1 and 2 from 0.55 between walls, dt = 0.2 dz.
double uniform_error(double diffusivity, std::size_t n) {
  const Problem problem = support::uniform_problem(1, n, 1, diffusivity, 0.55);
  Options options;
  options.dt = 0.2 / static_cast<double>(n);
  CrankNicolson run(problem, options);
  double largest = 0;
  for (const double t : {0.1, 0.5, 1.0, 2.0}) {
    run.advance_to(t);
    largest = std::max(largest,
                       Errors(run.states(), support::uniform_start_means(problem, t), problem.width()).max);
  }
  return largest;
}

TEST(DiffusionOrder, UniformStart) {
  EXPECT_LE(uniform_error(0.5, 500), 1e-6);
  EXPECT_LE(uniform_error(0.1, 500), 5e-6);
  EXPECT_LE(uniform_error(0.02, 500), 6e-5);
  for (const double d : {0.5, 0.1, 0.02, 0.002}) {
    const std::size_t n = d < 0.01 ? 500 : 200;
    EXPECT_NEAR(std::log2(uniform_error(d, n) / uniform_error(d, 2 * n)), 2, 0.15) << d;
  }
}

}  // namespace
}  // namespace shearfront::diffusion
