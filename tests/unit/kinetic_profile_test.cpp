// SPDX-License-Identifier: BSD-3-Clause
// The granular temperature of a sheared bed: values of an independent integration (Runge-Kutta of the Riccati equation in extended precision,
// 40 000 and 80 000 steps alike in all digits given), limits and laws.
#include "shearfront/model/depth/kinetic.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/airy.hpp>
#include <cmath>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using SolvedCell = KineticProfile<double>;

struct Row {
  double length, load, nu, stress, w0, w25, w50, w75, t0, t1, u50;
};
const std::vector<Row> kRows{
    {0.2, 1, 6.4442394413, 1.2888478883, 1.0928233486e-1, 1.6161517293e-1, 3.4798822855e-1, 0.7051883049,
     3.095683073, 0.7926430055, 0.1565637329},
    {0.1, 1, 11.8048441642, 1.1804844164, 4.2921786260e-3, 1.6127314691e-2, 1.0112997782e-1, 0.4644308813,
     44.80849763, 1.5653003293, 3.685655140e-2},
    {0.1, 0.2, 3.1135901661, 1.5567950830, 2.6439882952e-4, 1.5733435771e-3, 1.8625968622e-2, 0.1978950644,
     598.1772068, 5.6149334088, 4.263156280e-3},
    {0.05, 5, 103.7840771507, 1.0378407715, 2.5338768997e-3, 1.4063092636e-2, 1.0869490477e-1, 0.5042515234,
     63.68573623, 1.4457275600, 4.412995523e-2},
    {0.022159, 5.377, 247.7220514297, 1.0208802190, 4.2258704289e-7, 4.9897792764e-5, 5.3314991291e-3,
     0.1872487766, 1.646533923e5, 12.2266389420, 1.681120926e-3},
};

/// The velocity at a height over that of the lid: u' ~ w / p. Simpson's rule.
double velocity(const SolvedCell& profile, double height) {
  const int n = 2000;
  const auto part = [&](double z) { return profile.value(z) / (profile.bed().load + profile.bed().lid - z); };
  const auto integral = [&](double to) {
    double sum = part(0) + part(to);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * part(to * i / n);
    return sum * to / n / 3;
  };
  return integral(height) / integral(1);
}

TEST(KineticProfile, HasTheValuesOfAnIndependentIntegration) {
  for (const Row& row : kRows) {
    const SolvedCell profile({row.length, row.load, 0, 1});
    const auto expect = [&](double value, double reference) {
      EXPECT_NEAR(value, reference, 1e-9 * reference) << row.length << ' ' << row.load;
    };
    expect(profile.nu(), row.nu);
    expect(profile.stress(), row.stress);
    expect(profile.value(0), row.w0);
    expect(profile.value(0.25), row.w25);
    expect(profile.value(0.5), row.w50);
    expect(profile.value(0.75), row.w75);
    expect(profile.value(1), 1);
    expect(profile.slowness(0, 0.5, false).moment[0], row.t0);
    expect(profile.slowness(0.5, 1, false).moment[0], row.t1);
    expect(velocity(profile, 0.5), row.u50);
  }
}

TEST(KineticProfile, IsAiryFunctionUnderAHeavyLid) {
  const double zero = 1.0187929716474710890;  // of Ai', with the other sign
  const SolvedCell profile({4e-4, 1e4, 0, 1});
  const double d = std::cbrt(4e-4 * 4e-4 * 1e4 / 2), order = d / 1e4;
  for (const double s : {0.05, 0.1, 0.2, 0.35, 0.5}) {
    const double airy = boost::math::airy_ai(s / d - zero) / boost::math::airy_ai(-zero);
    EXPECT_NEAR(profile.value(1 - s), airy, 5 * order) << s;
  }
  EXPECT_NEAR(profile.stress(), 1 + zero * order, 5 * order * order);
}

TEST(KineticProfile, IsConstantWhereConductionIsEasyOrTheLidHeavy) {
  for (const auto& bed : {SolvedCell::Bed{1e3, 1, 0, 1}, SolvedCell::Bed{0.2, 1e7, 0, 1}}) {
    const double bend = 1 / (bed.length * bed.length) / bed.load;  // w''/w is of that order
    EXPECT_NEAR(SolvedCell(bed).value(0), 1, bend);
  }
}

TEST(KineticProfile, StressIsBetweenItsBounds) {
  support::SceneMaker make(support::seed_of(2101));
  for (int n = 0; n < 50; ++n) {
    const double length = std::exp(make.uniform(-4, 2)), load = std::exp(make.uniform(-5, 5));
    if (SolvedCell::n_nodes({length, load, 0, 1}) > SolvedCell::kMostNodes) continue;
    const double stress = SolvedCell({length, load, 0, 1}).stress();
    const double pressures = load + 0.5, inverse = std::log((load + 1) / load);
    EXPECT_GE(stress, 1) << length << ' ' << load;
    EXPECT_LE(stress, std::sqrt(pressures / inverse) / load * (1 + 1e-12)) << length << ' ' << load;
  }
}

/// Lengths in another unit.
TEST(KineticProfile, KnowsNoUnit) {
  for (const double unit : {2.0, 1e3, 1e-3}) {
    const SolvedCell one({0.1, 0.7, 0, 1}), other({0.1 * unit, 0.7 * unit, 0, unit});
    EXPECT_NEAR(other.stress(), one.stress(), 1e-14);
    for (const double z : {0.0, 0.3, 0.8})
      EXPECT_NEAR(other.value(z * unit), one.value(z), 1e-13 * one.value(z)) << unit << ' ' << z;
  }
}

/// Against 110 digits, over a contrast of 1e19.
TEST(KineticProfile, LosesNothingOverAnyContrast) {
  const double length = 0.015;
  const SolvedCell profile({length, 1, 0, 1});
  const KineticProfile<Real110> exact({Real110(length), Real110(1), Real110(0), Real110(1)});
  EXPECT_LT(profile.value(0), 1e-18);
  for (const double z : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    const double reference = to_double(exact.value(Real110(z)));
    EXPECT_NEAR(profile.value(z), reference, 1e-12 * reference) << z;
  }
  EXPECT_NEAR(profile.stress(), to_double(exact.stress()), 1e-15);
}

/// w depends on differences of heights and on ratios of lengths only.
TEST(KineticProfile, DerivativesKnowItsSymmetries) {
  support::SceneMaker make(support::seed_of(2102));
  for (int n = 0; n < 20; ++n) {
    const double length = make.uniform(0.05, 0.5), load = make.uniform(0.1, 5),
                 ground = make.uniform(-0.5, 0), lid = make.uniform(1, 1.5), z = make.uniform(0, 1);
    const SolvedCell profile({length, load, ground, lid});
    const auto v = profile.with_derivatives(z);
    const double h = 1e-3, slope = (8 * (profile.value(z + h) - profile.value(z - h)) -
                                    (profile.value(z + 2 * h) - profile.value(z - 2 * h))) /
                                   (12 * h);
    EXPECT_NEAR(v.by[2] + v.by[3], -slope, 1e-7 * v.w) << n;
    EXPECT_NEAR(length * v.by[0] + load * v.by[1] + ground * v.by[2] + lid * v.by[3], -z * slope, 1e-7 * v.w)
        << n;
  }
}

TEST(KineticProfile, TellsBedsWithoutNumbers) {
  EXPECT_GT(SolvedCell::n_nodes({1e-4, 1, 0, 1}), SolvedCell::kMostNodes);
  EXPECT_LT(SolvedCell::n_nodes({1e-3, 1, 0, 1}), SolvedCell::kMostNodes);
  for (const auto& bed :
       {SolvedCell::Bed{1e-4, 1, 0, 1}, SolvedCell::Bed{1, 0, 0, 1}, SolvedCell::Bed{1, 1, 1, 0}})
    EXPECT_TRUE(std::isnan(SolvedCell(bed).value(0.5)));
}

}  // namespace
}  // namespace shearfront
