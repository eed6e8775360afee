// SPDX-License-Identifier: BSD-3-Clause
// Reference values of May, Shearer & Daniels (2010): closed forms and numbers from two other programs.
#include <gtest/gtest.h>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/closeness.hpp"

namespace shearfront {
namespace {

using support::relative_error;

/// Numbers from decimal text, so that 50 digits mean 50 digits.
template <Real S>
S number(const char* text) {
  if constexpr (std::same_as<S, double>) {
    return std::stod(text);
  } else {
    return S(text);
  }
}

template <Real S>
Scene<S> example_1(const char* scale = "1") {
  SceneSpec<S> spec;
  spec.shear_rate = Piecewise<S>{{number<S>("0.29")}, {number<S>("2.4"), number<S>("0.31")}};
  spec.scale = number<S>(scale);
  spec.initial_breaks = {number<S>("0.5")};
  spec.initial_values = {S(0), S(1)};
  return Scene<S>(spec);
}

template <Real S>
Scene<S> example_2() {
  SceneSpec<S> spec;
  spec.shear_rate = Exponential<S>{number<S>("0.87") / number<S>("0.205"), number<S>("0.205")};
  spec.scale = number<S>("13.60");
  spec.initial_breaks = {number<S>("0.5")};
  spec.initial_values = {S(0), S(1)};
  return Scene<S>(spec);
}

/// Closed forms of Example 1 with rates k0 = 2.4 s, k1 = 0.31 s.
template <Real S>
void expect_example_1(const char* scale, double tolerance) {
  const auto events = exact_timeline(example_1<S>(scale));
  const S s = number<S>(scale), k0 = number<S>("2.4") * s, k1 = number<S>("0.31") * s, half(0.5);
  const S zc = number<S>("0.29"), d = half - zc;
  const S tc = d / k1;
  ASSERT_EQ(events.interfaces.size(), 1u);
  EXPECT_LT(relative_error(*events.interfaces[0].first, tc), tolerance);
  EXPECT_LT(relative_error(*events.t0, S(tc + zc / k0)), tolerance);
  EXPECT_LT(relative_error(*events.t1, S(half / k1)), tolerance);
  EXPECT_LT(relative_error(*events.t_star, S(2 / k1)), tolerance);
  // (k1 t - d)^2 = 4 k1 t zc, larger root.
  const S b = d + 2 * zc;
  const S last = (b + sqrt(S(b * b - d * d))) / k1;
  EXPECT_LT(relative_error(*events.interfaces[0].last, last), tolerance);
}

TEST(ExactReference, Example1InDouble) { expect_example_1<double>("1", 1e-14); }
TEST(ExactReference, Example1In50Digits) { expect_example_1<Real110>("1", 1e-46); }
TEST(ExactReference, Example1In110Digits) { expect_example_1<Real110>("1", 1e-105); }
TEST(ExactReference, Example1ScaledTo1e15) {
  expect_example_1<double>("1e-15", 1e-14);
  expect_example_1<double>("1e15", 1e-14);
  expect_example_1<Real110>("1e-15", 1e-46);
}

TEST(ExactReference, Example1PrintedDigits) {
  const auto events = exact_timeline(example_1<double>());
  EXPECT_LT(relative_error(*events.interfaces[0].first, 0.67741935483870967742), 1e-14);
  EXPECT_LT(relative_error(*events.t0, 0.79825268817204301075), 1e-14);
  EXPECT_LT(relative_error(*events.t1, 1.61290322580645161290), 1e-14);
  EXPECT_LT(relative_error(*events.interfaces[0].last, 5.00508809866577686634), 1e-14);
  EXPECT_LT(relative_error(*events.t_star, 6.45161290322580645161), 1e-14);
  EXPECT_EQ(events.mass, 0.5);
  EXPECT_EQ(events.steady_height, 0.5);
}

TEST(ExactReference, Example2PrintedDigits) {
  const auto events = exact_timeline(example_2<Real110>());
  EXPECT_LT(relative_error(*events.t0, Real110("0.03715849999422835822")), 1e-18);
  EXPECT_LT(relative_error(*events.t1, Real110("0.42590526428659926132")), 1e-18);
  EXPECT_LT(relative_error(*events.t_star, Real110("1.18560663684341865234")), 1e-18);
  EXPECT_TRUE(events.interfaces.empty());
  const auto in_double = exact_timeline(example_2<double>());
  EXPECT_LT(relative_error(*in_double.t0, to_double(*events.t0)), 1e-14);
  EXPECT_LT(relative_error(*in_double.t1, to_double(*events.t1)), 1e-14);
  EXPECT_LT(relative_error(*in_double.t_star, to_double(*events.t_star)), 1e-14);
}

/// The characteristic that returns to z0 = 1/2 with p = 1 - P: lambda ((1 - 2 P) + log(P / (1 - P))) = 1 - z0.
TEST(ExactReference, Example2SteadyTimeSolvesItsOwnEquation) {
  const Real110 t = *exact_timeline(example_2<Real110>()).t_star;
  const Real110 lambda("0.205"), s("13.60"),
      R = s * Real110("0.87") / lambda * exp(Real110(-1 / (2 * lambda)));
  // t = lambda (2 P - 1) / (R P (1 - P)) is increasing in P: bisect for P, then check the equation of P.
  Real110 lo("0.5"), hi("0.9999999");
  for (int i = 0; i < 200; ++i) {
    const Real110 P = (lo + hi) / 2;
    (lambda * (2 * P - 1) / (R * P * (1 - P)) < t ? lo : hi) = P;
  }
  EXPECT_LT(relative_error(lo, Real110("0.96684053779390567784")), 1e-19);
  EXPECT_LT(abs(to_double(Real110(lambda * ((1 - 2 * lo) + log(lo / (1 - lo))) - Real110("0.5")))), 1e-46);
  // a(z) p (1 - p) stays what it is along a characteristic, which turns where p = 1/2.
  const Real110 turning = Real110("0.5") - lambda * log(4 * lo * (1 - lo));
  EXPECT_LT(relative_error(turning, Real110("0.92104017394414902808")), 1e-19);
}

/// Height of the jump of phi by more than 0.05 between lo and hi, by bisection.
template <Real S>
double shock_between(const ExactSolution<S>& solution, double t, double lo, double hi) {
  for (int i = 0; i < 45; ++i) {
    const double mid = (lo + hi) / 2;
    // The steeper half holds the shock.
    const double low = solution.phi(lo, t), middle = solution.phi(mid, t), high = solution.phi(hi, t);
    (std::abs(middle - low) > std::abs(high - middle) ? hi : lo) = mid;
  }
  return lo;
}

TEST(ExactReference, ShockPositions) {
  const ExactSolution<double> one(example_1<double>()), two(example_2<double>());
  EXPECT_NEAR(shock_between(one, 3.0, 0.05, 0.28), 0.134438283, 1e-9);
  EXPECT_NEAR(shock_between(one, 3.0, 0.75, 1.0), 0.933818170, 1e-9);
  EXPECT_NEAR(shock_between(two, 0.6, 0.2, 0.5), 0.367237, 1e-6);
  EXPECT_NEAR(shock_between(two, 0.6, 0.95, 1.0), 0.986757, 1e-6);
  EXPECT_NEAR(shock_between(two, 1.0, 0.3, 0.55), 0.466403, 1e-6);
  EXPECT_NEAR(shock_between(two, 1.0, 0.7, 1.0), 0.831754, 1e-6);
}

/// phi = 1/2 + (E - sqrt(E + B^2 / 4)) / B inside the exponential fan.
TEST(ExactReference, ExponentialFan) {
  const ExactSolution<Real110> solution(example_2<Real110>());
  const Real110 lambda("0.205"), t("0.02"), z("0.45"), half(0.5);
  const Real110 B = solution.medium().rate_at(half) * t / lambda, E = exp(Real110((z - half) / lambda));
  const Real110 phi = half + (E - sqrt(Real110(E + B * B / 4))) / B;
  EXPECT_LT(relative_error(solution.phi(z, t), phi), 1e-46);
}

/// One layer: phi = 1/2 + (z - z0) / (2 s a t) in the fan.
TEST(ExactReference, OneLayerFan) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {2.0}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const ExactSolution<double> solution{Scene<double>(spec)};
  EXPECT_DOUBLE_EQ(solution.phi(0.4, 0.125), 0.5 - 0.1 / 0.5);
  EXPECT_DOUBLE_EQ(solution.phi(0.5, 0.125), 0.5);
  EXPECT_DOUBLE_EQ(solution.M(0.5, 0.125), 2.0 / 4 * 0.125);
  EXPECT_DOUBLE_EQ(*exact_timeline(Scene<double>(spec)).t_star, 1.0);
}

}  // namespace
}  // namespace shearfront
