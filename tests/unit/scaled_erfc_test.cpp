// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/numeric/scaled_erfc.hpp"
#include "shearfront/digits/real110.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "shearfront/numeric/scaled_sum.hpp"
#include "support/closeness.hpp"

namespace shearfront {
namespace {

TEST(ScaledErfc, AgreesWithTheProductInMoreDigits) {
  for (double x = 0; x < 60; x = x * 1.07 + 0.03) {
    const Real110 wide(x), reference = exp(Real110(wide * wide)) * boost::math::erfc(wide);
    EXPECT_LT(support::relative_error(Real110(scaled_erfc(x)), reference), 6 * unit_roundoff<double>()) << x;
    EXPECT_LT(support::relative_error(Real110(scaled_erfc(Real110(x))), reference), 1e-48) << x;
  }
}

// Against Boost's, which are other formulas.
TEST(ErfOfManyDigits, AgreesWithBoost) {
  const auto error = [](const Real110& x, const Real110& reference) {
    return support::relative_error(x, reference);
  };
  for (const double x :
       {-40.0, -5.0, -1.25, -1e-6, 1e-300, 1e-9, 0.3, 1.0, 1.2, 2.0, 3.7, 4.9999, 5.0, 12.0}) {
    const Real110 wide(x);
    EXPECT_LT(error(erf_of(wide), boost::math::erf(wide)), 1e-105) << x;
    EXPECT_LT(error(erfc_of(wide), boost::math::erfc(wide)), 1e-94) << x;
  }
  EXPECT_EQ(erf_of(Real110(0)), 0);
  EXPECT_EQ(erfc_of(Real110(0)), 1);
}

TEST(ScaledErfc, FollowsTheAsymptoticSeriesFarOut) {
  for (const double x : {1e3, 1e7, 1e9, 1e30, 1e200}) {
    const double leading = 1 / (std::sqrt(std::acos(-1.0)) * x);
    EXPECT_NEAR(scaled_erfc(x) / leading, 1 - 0.5 / x / x + 0.75 / x / x / x / x, 1e-15) << x;
  }
}

TEST(ScaledErfc, JoinsItsTwoFormulas) {
  const Real110 below = scaled_erfc(Real110(5) - Real110("1e-45")), above = scaled_erfc(Real110(5));
  EXPECT_LT(support::relative_error(below, above), 1e-45);
}

TEST(ScaledSum, AddsTermsWhoseExponentialsOverflow) {
  ScaledSum<double> sum, other;
  for (const double e : {-3000.0, 2000.0, 1990.0}) sum.add(2.0, e);
  other.add(-1.0, 1995.0);
  other.add(3.0, 1995.0);
  EXPECT_NEAR(sum.over(other), (1 + std::exp(-10.0)) * std::exp(5.0), 1e-12);
  EXPECT_EQ(sum.exponent(), 2000.0);
  EXPECT_TRUE(sum.drowns(1900.0, 50.0));
  EXPECT_FALSE(sum.drowns(1960.0, 50.0));
}

}  // namespace
}  // namespace shearfront
