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

}  // namespace
}  // namespace shearfront::diffusion
