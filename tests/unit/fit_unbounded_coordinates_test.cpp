// SPDX-License-Identifier: BSD-3-Clause
// The coordinates of a posterior against their formulas in 110 digits, differenced there.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/fit/unbounded_coordinates.hpp"
#include "support/random_scene.hpp"
#include "support/unbounded_map.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using support::SceneMaker;
using support::UnboundedMap;

constexpr double kNoBound = std::numeric_limits<double>::infinity();

/// Unknowns of every kind, in any order.
struct MixedUnknowns {
  std::vector<Entry> entries;
  std::vector<double> lower, upper;
  Shape shape = Shape::none;

  void add(const std::string& field, std::size_t index, bool is_element, double low, double high) {
    entries.push_back({field, index, is_element});
    lower.push_back(low);
    upper.push_back(high);
  }
  [[nodiscard]] UnboundedCoordinates coordinates() const {
    const auto n = static_cast<Index>(lower.size());
    return {entries, VectorXd::Map(lower.data(), n), VectorXd::Map(upper.data(), n), shape};
  }
  [[nodiscard]] UnboundedMap<Real110> map() const { return {entries, lower, upper, shape}; }
};

MixedUnknowns mixed_unknowns(SceneMaker& make) {
  MixedUnknowns all;
  all.shape = static_cast<Shape>(make.integer(0, 2));
  const double a = make.uniform(-2, 2), b = a + make.uniform(0.1, 3), c = make.uniform(1e-4, 1);
  all.add("none", 0, false, -kNoBound, kNoBound);
  all.add("low", 0, false, a, kNoBound);
  all.add("high", 0, false, -kNoBound, b);
  all.add("both", 0, false, a, b);
  all.add("wide", 0, false, c, c * make.uniform(11, 1e6));
  all.add("narrow", 0, false, c, c * make.uniform(1.1, 9));
  all.add("from zero", 0, false, 0, b * b);
  const int n_breaks = make.integer(1, 3), n_values = make.integer(1, 4);
  const std::string breaks = make.integer(0, 1) == 0 ? "shear_rate.breaks" : "initial.breaks";
  for (int k = 0; k < n_breaks; ++k) {  // one in three has bounds of its own that cut off what is below
    const bool has_own = make.integer(0, 2) == 0;
    all.add(breaks, static_cast<std::size_t>(k), true, has_own ? 0.2 * (k + 1) : 0,
            make.uniform(0.9, 0.95) + 0.05 * k);
  }
  const double top = make.integer(0, 2) == 0 ? kNoBound : 1e3;
  for (int k = 0; k < n_values; ++k)
    all.add("shear_rate.values", static_cast<std::size_t>(k), true, 0.01, top);
  std::vector<std::size_t> order(all.entries.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i-- > 1;)
    std::swap(order[i], order[static_cast<std::size_t>(make.integer(0, static_cast<int>(i)))]);
  MixedUnknowns shuffled;
  shuffled.shape = all.shape;
  for (const std::size_t i : order)
    shuffled.add(all.entries[i].field, all.entries[i].index, all.entries[i].is_element, all.lower[i],
                 all.upper[i]);
  return shuffled;
}

/// At most so many of one sort, arrays or single numbers: the map with all of them takes long in 110 digits.
MixedUnknowns few_of(const MixedUnknowns& all, std::size_t most, bool is_element) {
  MixedUnknowns few;
  few.shape = all.shape;
  for (std::size_t i = 0; i < all.entries.size() && few.entries.size() < most; ++i)
    if (all.entries[i].is_element == is_element)
      few.add(all.entries[i].field, all.entries[i].index, is_element, all.lower[i], all.upper[i]);
  return few;
}

VectorXd random_x(const MixedUnknowns& all, SceneMaker& make) {
  VectorXd x(static_cast<Index>(all.entries.size()));
  for (Index i = 0; i < x.size(); ++i) {
    x[i] = make.uniform(-3, 3);
    // The wide interval of the values leaves those below room only near its lower end.
    if (all.entries[static_cast<std::size_t>(i)].field == "shear_rate.values") x[i] -= 5;
  }
  return x;
}

std::vector<Real110> digits_of(const VectorXd& x) { return {x.begin(), x.end()}; }

TEST(FitUnboundedCoordinates, AreTheirFormulasAndDerivativesIn110Digits) {
  const Real110 fine("1e-45"), coarse("1e-25");
  int n_compared = 0, n_coupled = 0;
  for (std::uint64_t number = 1; number <= 16; ++number) {
    const std::uint64_t seed = support::seed_of(number);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const MixedUnknowns all = few_of(mixed_unknowns(make), 5, number % 2 == 0);
    const VectorXd x = random_x(all, make);
    const auto at = all.coordinates().at(x);
    ASSERT_TRUE(at);
    const UnboundedMap<Real110> map = all.map();
    const std::vector<Real110> p = map.values(digits_of(x));
    const auto derivative = map.derivative(digits_of(x), fine);
    EXPECT_NEAR(at->log_volume, to_double(map.log_volume(digits_of(x), fine)),
                1e-12 * (1 + std::abs(at->log_volume)));
    EXPECT_NEAR(at->log_volume, std::log(std::abs(at->derivative.fullPivLu().determinant())), 1e-9);
    for (Index j = 0; j < x.size(); ++j) {
      const auto i = static_cast<std::size_t>(j);
      EXPECT_NEAR(at->p[j], to_double(p[i]), 1e-14 * std::abs(at->p[j]) + 2e-15) << all.entries[i].name();
      for (Index k = 0; k < x.size(); ++k) {
        const double exact = to_double(derivative[i][static_cast<std::size_t>(k)]);
        EXPECT_NEAR(at->derivative(k, j), exact, 1e-13 * std::abs(exact)) << all.entries[i].name();
        n_coupled += k != j && exact != 0 ? 1 : 0;
      }
      std::vector<Real110> above = digits_of(x), below = above;
      above[i] += coarse;
      below[i] -= coarse;
      const double slope =
          to_double(Real110((map.log_volume(above, fine) - map.log_volume(below, fine)) / (2 * coarse)));
      EXPECT_NEAR(at->slope[j], slope, 1e-12 * (1 + std::abs(slope))) << all.entries[i].name();
      ++n_compared;
    }
  }
  EXPECT_GT(n_compared, 60);
  EXPECT_GT(n_coupled, 10);  // unknowns that follow others
}

TEST(FitUnboundedCoordinates, GoThereAndBackAndKeepEveryOrder) {
  int n_breaks = 0, n_shapes = 0;
  for (std::uint64_t number = 1; number <= 300; ++number) {
    const std::uint64_t seed = support::seed_of(number);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const MixedUnknowns all = mixed_unknowns(make);
    const UnboundedCoordinates to = all.coordinates();
    const VectorXd x = random_x(all, make);
    const auto at = to.at(x);
    ASSERT_TRUE(at);
    EXPECT_LT((to.coordinates(at->p) - x).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_TRUE(to.contains(at->p));
    std::vector<double> breaks(3, kNoBound), values(4, kNoBound);
    for (std::size_t i = 0; i < all.entries.size(); ++i) {
      const double p = at->p[static_cast<Index>(i)];
      EXPECT_TRUE(p > all.lower[i] && p < all.upper[i]) << all.entries[i].name();
      if (all.entries[i].field.ends_with("breaks")) breaks[all.entries[i].index] = p;
      if (all.entries[i].field == "shear_rate.values") values[all.entries[i].index] = p;
    }
    for (std::size_t k = 1; k < breaks.size() && breaks[k] < kNoBound; ++k, ++n_breaks)
      EXPECT_LT(breaks[k - 1], breaks[k]);
    for (std::size_t k = 1; all.shape != Shape::none && k < values.size() && values[k] < kNoBound;
         ++k, ++n_shapes) {
      EXPECT_GT(values[k - 1], values[k]);
      if (all.shape == Shape::convex && k > 1) {
        EXPECT_GT(values[k - 2] - values[k - 1], values[k - 1] - values[k]);
      }
    }
  }
  EXPECT_GT(n_breaks, 200);
  EXPECT_GT(n_shapes, 200);
}

TEST(FitUnboundedCoordinates, StandInsideOfBoundsAndEndWhereThereIsNoRoom) {
  MixedUnknowns all;
  all.add("both", 0, false, -1, 1);
  all.add("wide", 0, false, 1e-3, 1e3);
  all.add("low", 0, false, 0, kNoBound);
  all.add("high", 0, false, -kNoBound, 2e-9);
  all.add("shear_rate.breaks", 0, true, 0, 1);
  all.add("shear_rate.breaks", 1, true, 0, 0.5);
  const UnboundedCoordinates to = all.coordinates();
  VectorXd p(6);
  p << 1, 1e-3, 0, 2e-9, 0, 0.5;
  EXPECT_TRUE(to.contains(p));
  const VectorXd x = to.coordinates(p);
  const auto at = to.at(x);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->p[0], 1 - 2e-6, 1e-12);
  EXPECT_NEAR(std::log(at->p[1] / 1e-3), 1e-6 * std::log(1e6), 1e-12);
  EXPECT_NEAR(at->p[2], 1e-6, 1e-18);
  EXPECT_NEAR(2e-9 - at->p[3], 2e-15, 1e-20);
  EXPECT_NEAR(at->p[5], 0.5, 1e-6);
  EXPECT_LT((to.at(to.coordinates(at->p))->p - at->p).cwiseAbs().maxCoeff(), 1e-14);
  p[4] = 0.6;
  EXPECT_FALSE(to.contains(p));
  VectorXd beyond = x;
  beyond[4] = 2;  // the lower break above the bound of the upper one
  EXPECT_FALSE(to.at(beyond));
  for (const double far : {-800.0, kNoBound, -kNoBound, std::nan("")}) {
    VectorXd wrong = x;
    wrong[0] = far;
    EXPECT_FALSE(to.at(wrong)) << far;
  }
  EXPECT_FALSE(to.contains(VectorXd::Constant(6, std::nan(""))));
}

}  // namespace
}  // namespace shearfront::fit
