// SPDX-License-Identifier: BSD-3-Clause
// Numbers that carry derivatives: rules and functions against their closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shearfront/numeric/dual.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {
namespace {

using TwoWays = Dual<2>;

/// x = 0.3 and y = 1.7 with the unit derivatives.
TwoWays variable(std::size_t j) {
  TwoWays x(j == 0 ? 0.3 : 1.7);
  x.d[j] = 1;
  return x;
}

void expect(const TwoWays& f, double value, double by_x, double by_y) {
  EXPECT_DOUBLE_EQ(f.v, value);
  EXPECT_NEAR(f.d[0], by_x, 1e-15 * (1 + std::abs(by_x)));
  EXPECT_NEAR(f.d[1], by_y, 1e-15 * (1 + std::abs(by_y)));
}

TEST(Dual, CarriesDerivativesThroughArithmetic) {
  static_assert(Real<TwoWays>);
  const TwoWays x = variable(0), y = variable(1);
  expect(x + y, 2.0, 1, 1);
  expect(x - 2 * y, 0.3 - 2 * 1.7, 1, -2);
  expect(x * y, 0.3 * 1.7, 1.7, 0.3);
  expect(x / y, 0.3 / 1.7, 1 / 1.7, -0.3 / (1.7 * 1.7));
  expect(-x, -0.3, -1, 0);
  TwoWays z = x;
  z *= z;  // of itself
  expect(z, 0.3 * 0.3, 0.6, 0);
}

TEST(Dual, CarriesDerivativesThroughFunctions) {
  const TwoWays x = variable(0), y = variable(1);
  expect(sqrt(y), std::sqrt(1.7), 0, 0.5 / std::sqrt(1.7));
  expect(exp(x), std::exp(0.3), std::exp(0.3), 0);
  expect(expm1(x), std::expm1(0.3), std::exp(0.3), 0);
  expect(log(y), std::log(1.7), 0, 1 / 1.7);
  expect(log1p(x), std::log1p(0.3), 1 / 1.3, 0);
  expect(pow(x, y), std::pow(0.3, 1.7), 1.7 * std::pow(0.3, 0.7), std::pow(0.3, 1.7) * std::log(0.3));
  expect(abs(-y), 1.7, 0, 1);
  // Where there is no derivative it is 0, not an infinity that would spread.
  expect(sqrt(x * 0), 0, 0, 0);
  expect(pow(x - x, y), 0, 0, 0);
}

TEST(Dual, IsComparedByItsValue) {
  const TwoWays x = variable(0), y = variable(1);
  EXPECT_LT(x, y);
  EXPECT_EQ(x, TwoWays(0.3));
  EXPECT_EQ(std::max(x, y).d[1], 1);
  EXPECT_FALSE(is_finite(infinity<TwoWays>()));
  EXPECT_EQ(to_double(y), 1.7);
}

}  // namespace
}  // namespace shearfront
