// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shearfront/diffusion/cole_hopf_burgers.hpp"
#include "shearfront/diffusion/cole_hopf_kink.hpp"
#include "shearfront/diffusion/cole_hopf_steady.hpp"
#include "shearfront/diffusion/cole_hopf_uniform.hpp"
#include "shearfront/digits/real110.hpp"
#include "support/checked.hpp"
#include "support/closeness.hpp"

namespace shearfront::diffusion {
namespace {

double distance(const Real110& x, const Real110& y) { return std::abs(to_double(Real110(x - y))); }

/// |x - y| / y, and 0 where the double underflows.
double tail_error(double x, const Real110& y) {
  return y < 1e-290 ? (x < 1e-280 ? 0.0 : 1.0) : support::relative_error(Real110(x), y);
}

struct Place {
  double z, t;
};

/// Heights with weight on both walls and times spread over the decades and over the meeting of the fronts.
std::vector<Place> places(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> all;
  for (std::size_t i = 0; i < n; ++i) {
    Place p{-0.5 + unit(random), std::pow(10.0, -6 + 7 * unit(random))};
    const double near = std::pow(10.0, -12 * unit(random));
    if (i % 3 == 1) p.z = i % 2 ? -0.5 + near : 0.5 - near;
    if (i % 5 == 1) p.z = i % 2 ? -0.5 : 0.5;
    if (i % 4 == 1) p.t = 0.3 + 2.2 * unit(random);
    all.push_back(p);
  }
  return all;
}

/// The guarantees of UniformStart in units of roundoff: relative errors of phi and 1 - phi.
void expect_guarantees(double d, double phi0, double rate, const std::vector<Place>& at, double tails) {
  const UniformStart<double> rounded(-0.5, 0.5, rate, d, phi0);
  const UniformStart<Real110> exact(Real110(-0.5), Real110(0.5), Real110(rate), Real110(d), Real110(phi0));
  const double u = unit_roundoff<double>();
  for (const Place& p : at) {
    const auto here = rounded.at(p.z, p.t);
    const auto truth = exact.at(Real110(p.z), Real110(p.t));
    const std::string text = "d = " + std::to_string(d) + ", phi0 = " + std::to_string(phi0) +
                             ", z = " + std::to_string(p.z) + ", t = " + std::to_string(p.t);
    EXPECT_LT(tail_error(here.phi, truth.phi), tails) << text;
    EXPECT_LT(tail_error(here.complement, truth.complement), tails) << text;
    EXPECT_LT(distance(here.cumulative, truth.cumulative), u * (4 + 4 * d)) << text;
    EXPECT_LT(d * distance(here.gradient, truth.gradient), u * (4 + 2 / d)) << text;
  }
}

TEST(UniformStart, HasTwelveDigitsInTheFourCases) {
  for (const double d : {0.002, 0.02, 0.1, 0.5}) expect_guarantees(d, 0.55, -1, places(100, 61), 1e-12);
}

TEST(SlowUniformStart, HasTwelveDigitsAtManyPlaces) {
  for (const double d : {0.002, 0.02, 0.1, 0.5}) expect_guarantees(d, 0.55, -1, places(1000, 62), 1e-12);
}

TEST(UniformStart, KeepsItsBoundForSmallAndLargeDiffusionAndStarts) {
  for (const double phi0 : {0.001, 0.3, 0.95})
    for (const double d : {1e-6, 1e-4, 0.002, 0.1, 2.0, 50.0})
      expect_guarantees(d, phi0, 1, places(15, 63),
                        unit_roundoff<double>() * (4 + 2 / d) / (phi0 * (1 - phi0)));
}

/// Derivatives by central differences in 50 digits.
template <class Function>
struct Differences {
  Real110 value, along, second;
  Differences(const Function& f, const Real110& x, const Real110& h) : value(f(x)) {
    const Real110 below = f(x - h), above = f(x + h);
    along = (above - below) / (2 * h);
    second = (above - 2 * value + below) / (h * h);
  }
};

TEST(UniformStart, SatisfiesTheEquation) {
  for (const double d : {0.002, 0.1, 0.5})
    for (const double rate : {2.0, -1.0}) {
      const Real110 diffusivity = Real110(d) * abs(Real110(rate)), h = Real110("1e-12") * d;
      const UniformStart<Real110> exact(0, 1, rate, diffusivity, Real110(0.4));
      for (const Place& p : {Place{0.3, 0.2}, Place{0.41, 0.7}, Place{0.9, 1.5}}) {
        const Real110 z(p.z), t(p.t);
        const Differences in_z([&](const Real110& x) { return exact.at(x, t).phi; }, z, h);
        const Differences in_t([&](const Real110& s) { return exact.at(z, s).phi; }, t, h);
        const Differences amount([&](const Real110& x) { return exact.at(x, t).cumulative; }, z, h);
        const Real110 residual =
            in_t.along + rate * (2 * in_z.value - 1) * in_z.along - diffusivity * in_z.second;
        EXPECT_LT(distance(residual, 0) * d, 1e-20) << d << ' ' << p.z << ' ' << p.t;
        EXPECT_LT(distance(in_z.along, exact.at(z, t).gradient) * d, 1e-20);
        EXPECT_LT(distance(amount.along, in_z.value), 1e-20);
      }
    }
}

TEST(UniformStart, LetsNothingThroughTheWallsAndKeepsTheMass) {
  for (const double d : {1e-5, 0.002, 0.1, 0.5})
    for (const double rate : {2.0, -1.0}) {
      const double diffusivity = d * std::abs(rate);
      const UniformStart<Real110> exact(0, 1, rate, Real110(diffusivity), Real110(0.4));
      const UniformStart<double> rounded(0, 1, rate, diffusivity, 0.4);
      for (const double t : {1e-6, 1e-3, 0.1, 0.5, 1.0, 2.0, 10.0}) {
        for (const double wall : {0.0, 1.0}) {
          const auto p = exact.at(wall, t);
          EXPECT_LT(distance(rate * p.phi * (p.phi - 1), diffusivity * p.gradient), 1e-40) << d << ' ' << t;
        }
        EXPECT_LT(std::abs(rounded.at(0.0, t).cumulative), 4 * unit_roundoff<double>());
        EXPECT_LT(std::abs(rounded.at(1.0, t).cumulative - 0.4), 4 * unit_roundoff<double>());
      }
    }
}

TEST(UniformStart, BeginsUniformAndEndsSteady) {
  for (const double d : {0.002, 0.1, 0.5}) {
    const UniformStart<Real110> exact(0, 1, 1, Real110(d), Real110(0.55));
    const SteadyState<Real110> steady(0, 1, 1, Real110(d), Real110(0.55));
    EXPECT_EQ(exact.at(Real110(0.3), 0).phi, Real110(0.55));
    EXPECT_LT(distance(exact.at(Real110(0.5), Real110("1e-7") * d).phi, Real110(0.55)), 1e-45);
    // The slowest part decays like exp(-(1 / (4 d) + pi^2 d) t), the smallest tail is exp(-1.1 / (2 d)).
    const Real110 end_time((45 + 0.55 / d) / (0.25 / d + 9.8696 * d));
    for (const double z : {0.0, 0.2, 0.55, 1.0}) {
      const auto late = exact.at(Real110(z), end_time), end = steady.at(Real110(z));
      EXPECT_LT(support::relative_error(late.phi, end.phi), 1e-17) << d << ' ' << z;
      EXPECT_LT(support::relative_error(late.complement, end.complement), 1e-17) << d << ' ' << z;
      EXPECT_LT(distance(late.cumulative, end.cumulative), 1e-18);
      EXPECT_EQ(exact.at(Real110(z), infinity<Real110>()).phi, end.phi);
    }
  }
}

TEST(UniformStart, IsTheSameByImagesAndBySeries) {
  // The change-over of d = 0.1 and phi0 = 0.55 is at 5.5 - t (2.5 + pi^2 / 10) = 1.
  const Real110 pi = boost::math::constants::pi<Real110>(), e("1e-30");
  const Real110 d = Real110(1) / 10, phi0 = Real110(55) / 100;
  const Real110 change = Real110(4.5) / (Real110(2.5) + d * pi * pi);
  const UniformStart<Real110> exact(0, 1, 1, d, phi0);
  for (const double z : {0.0, 0.4, 0.8, 1.0}) {
    const auto images = exact.at(Real110(z), change - e), series = exact.at(Real110(z), change + e);
    EXPECT_LT(distance(images.phi, series.phi), 1e-28);
    EXPECT_LT(distance(images.cumulative, series.cumulative), 1e-28);
    EXPECT_LT(distance(images.gradient, series.gradient), 1e-27);
  }
}

TEST(UniformStart, TendsToTheShocksOfTheHyperbolicBed) {
  shearfront::support::Checked checked({""}, 300);
  const double phi0 = 0.55;
  for (const double d : {1e-3, 1e-4, 1e-5})
    for (const double t : {0.2, 0.5, 2.0}) {
      // Two shocks leave the walls, with the speeds phi0 and phi0 - 1, and stop each other at phi0.
      const double lower = std::min(phi0 * t, phi0), upper = std::max(1 - (1 - phi0) * t, phi0);
      const UniformStart<double> exact(0, 1, 1, d, phi0);
      for (double z = 0; z <= 1; z += 1.0 / 64) {
        if (std::abs(z - lower) < 100 * d || std::abs(z - upper) < 100 * d) continue;
        const double limit = z < lower ? 1 : z < upper ? phi0 : 0;
        EXPECT_NEAR(exact.at(z, t).phi, limit, 1e-12) << d << ' ' << t << ' ' << z;
        checked.count();
      }
    }
}

TEST(UniformStart, LeavesPureBedsAlone) {
  for (const double phi0 : {0.0, 1.0}) {
    const auto p = UniformStart<double>(0, 2, 1, 0.1, phi0).at(0.5, 3.0);
    EXPECT_EQ(p.phi, phi0);
    EXPECT_EQ(p.cumulative, 0.5 * phi0);
    EXPECT_EQ(SteadyState<double>(0, 2, 1, 0.1, phi0).at(0.5).phi, phi0);
  }
}

TEST(SteadyState, BalancesTheFluxesAndHoldsTheMass) {
  for (const double rate : {1.0, -2.0})
    for (const double d : {1e-4, 0.02, 0.5, 100.0}) {
      const SteadyState<Real110> exact(-1, 1, rate, Real110(d), Real110(0.3));
      const SteadyState<double> rounded(-1, 1, rate, d, 0.3);
      for (const double z : {-1.0, -0.4, 0.0, 0.9, 1.0}) {
        const auto p = exact.at(z);
        EXPECT_LT(distance(rate * p.phi * (p.phi - 1), d * p.gradient), 1e-45);
        const double bound = unit_roundoff<double>() * (10 + 6 / d);
        EXPECT_LT(tail_error(rounded.at(z).phi, p.phi), bound) << d << ' ' << z;
        EXPECT_LT(tail_error(rounded.at(z).complement, p.complement), bound) << d << ' ' << z;
        EXPECT_LT(tail_error(rounded.at(z).cumulative, p.cumulative), bound) << d << ' ' << z;
      }
      EXPECT_LT(distance(exact.at(1).cumulative, 2 * Real110(0.3)), 1e-45);
      EXPECT_EQ(exact.at(-1).cumulative, 0);
    }
  EXPECT_NEAR(SteadyState<double>(0, 1, 1, 0.01, 0.55).center(), 0.55, 1e-12);
}

TEST(Kink, SatisfiesTheEquationAndIsTheTanh) {
  const Real110 d("0.01"), center("0.2"), speed("-0.25"), t("0.7"), h("1e-14");
  const Kink<Real110> exact(Real110(-0.5), 1, d, center, speed);
  const Kink<double> rounded(-0.5, 1, 0.01, 0.2, -0.25);
  for (const double place : {-0.4, 0.0, 0.03, 0.2, 0.45}) {
    const Real110 z(place);
    const Differences in_z([&](const Real110& x) { return exact.at(x, t).phi; }, z, h);
    const Differences in_t([&](const Real110& s) { return exact.at(z, s).phi; }, t, h);
    const Differences amount([&](const Real110& x) { return exact.at(x, t).cumulative; }, z, h);
    EXPECT_LT(distance(in_t.along + (2 * in_z.value - 1) * in_z.along, d * in_z.second), 1e-18);
    EXPECT_LT(distance(in_z.along, exact.at(z, t).gradient), 1e-20);
    EXPECT_LT(distance(amount.along, in_z.value), 1e-20);
    const double f = -1, c = -0.25, y = place - 0.2 - c * 0.7;
    EXPECT_NEAR(rounded.at(place, 0.7).phi, (f - c) / (2 * f) * (1 + std::tanh((f - c) * y / 0.02)), 1e-14);
    EXPECT_LT(tail_error(rounded.at(place, 0.7).phi, exact.at(z, t).phi), 2e-14);
  }
  EXPECT_EQ(exact.at(Real110(-0.5), t).cumulative, 0);
}

/// At every `stride`th of 144 combinations of viscosity, time and place: many digits take a tenth of a second each.
void expect_twelve_digits(int stride, std::size_t least) {
  shearfront::support::Checked checked({""}, least);
  const double pi = std::acos(-1.0);
  int number = 0;
  for (const double mu : {1.0, 0.1, 0.01, 0.001}) {
    const PeriodicBurgers<double> rounded(mu, 1, 1);
    const PeriodicBurgers<Real110> exact(Real110(mu), 1, 1);
    for (const double t : {1e-6, 1e-2, 1.0, 3.0, 30.0, 150.0})
      for (const double x : {1e-9, 0.1, 1.6, 3.0, pi, 6.0}) {
        if (number++ % stride != 0 || mu * t > 30) continue;
        const auto here = rounded.at(x, t);
        const auto truth = exact.at(Real110(x), Real110(t));
        EXPECT_LT(tail_error(std::abs(here.value), abs(truth.value)), 1e-12) << mu << ' ' << t << ' ' << x;
        EXPECT_LT(distance(here.gradient, truth.gradient) / (1 + std::abs(here.gradient)), 1e-12);
        EXPECT_LT(distance(here.cumulative, truth.cumulative), 1e-13);
        checked.count();
      }
  }
}
// 7 has no factor in common with the numbers of times and places: every one of them comes.
TEST(PeriodicBurgers, HasTwelveDigits) { expect_twelve_digits(7, 17); }
TEST(SlowPeriodicBurgers, HasTwelveDigitsEverywhere) { expect_twelve_digits(1, 100); }

TEST(PeriodicBurgers, SatisfiesTheEquationForEveryAmplitudeAndWaveNumber) {
  const Real110 mu("0.05"), h("1e-13");
  for (const int amplitude : {2, -3})
    for (const int wave : {1, 3})
      for (const char* time : {"0.3", "8"}) {
        const PeriodicBurgers<Real110> exact(mu, amplitude, wave);
        const Real110 x("0.4"), t(time);
        EXPECT_LT(distance(exact.at(x, 0).value, amplitude * sin(wave * x)), 1e-48);
        EXPECT_LT(distance(exact.at(x, Real110("1e-40")).value, amplitude * sin(wave * x)), 1e-36);
        // Each place costs a tenth of a second: five of them give all differences.
        const auto here = exact.at(x, t), left = exact.at(x - h, t), right = exact.at(x + h, t);
        const Real110 u_t = (exact.at(x, t + h).value - exact.at(x, t - h).value) / (2 * h);
        const Real110 u_x = (right.value - left.value) / (2 * h);
        const Real110 u_xx = (right.value - 2 * here.value + left.value) / (h * h);
        EXPECT_LT(distance(u_t + here.value * u_x, mu * u_xx), 1e-20);
        EXPECT_LT(distance(u_x, here.gradient), 1e-20);
        EXPECT_LT(distance((right.cumulative - left.cumulative) / (2 * h), here.value), 1e-20);
      }
}

}  // namespace
}  // namespace shearfront::diffusion
