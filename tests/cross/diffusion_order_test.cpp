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

}  // namespace
}  // namespace shearfront::diffusion
