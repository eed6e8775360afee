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

TEST(DiffusionOrder, PeriodicBurgers) {
  for (const double mu : {1.0, 0.1, 0.01}) {
    // For mu = 0.01 the front, 0.04 wide, takes more cells than the smooth cases.
    const std::size_t coarse = mu < 0.1 ? 1000 : 100;
    Errors last;
    for (const std::size_t n : {coarse, 2 * coarse}) {
      const Errors error = support::burgers_errors(n, 2.0 / static_cast<double>(n), mu, 2);
      if (n > coarse) {
        EXPECT_NEAR(std::log2(last.max / error.max), 2, 0.05) << mu;
        EXPECT_NEAR(std::log2(last.l2 / error.l2), 2, 0.05) << mu;
        EXPECT_NEAR(std::log2(last.h1 / error.h1), 2, 0.05) << mu;
      }
      last = error;
    }
  }
}

}  // namespace
}  // namespace shearfront::diffusion
