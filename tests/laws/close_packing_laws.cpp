// SPDX-License-Identifier: BSD-3-Clause
// Laws of random close packing, run for every model of close_packing/all.hpp and for its skeleton.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shearfront/digits/real110.hpp"
#include "shearfront/model/close_packing/all.hpp"
#include "shearfront/model/close_packing/skeleton.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "support/checked.hpp"
#include "support/model_types.hpp"

namespace shearfront {
namespace {

template <class Law>
class ClosePackingLaws : public testing::Test {};

using ClosePackingLawsTypes =
    support::ModelTypes<ClosePackingList<double>, SkeletonClosePacking<double>>::Type;
TYPED_TEST_SUITE(ClosePackingLaws, ClosePackingLawsTypes, support::ModelName);

TYPED_TEST(ClosePackingLaws, HasSamplesThatPassTheirOwnCheck) {
  static_assert(ClosePackingLaw<TypeParam, double>);
  ASSERT_FALSE(TypeParam::samples().empty());
  for (const auto& law : TypeParam::samples()) {
    Complaints complaints;
    law.fields(law, [&](const FieldInfo& info, const auto& x) {
      check_number(std::string(info.key), info.range, x, complaints);
    });
    law.check("close_packing.", complaints);
    EXPECT_TRUE(complaints.empty());
  }
}

TYPED_TEST(ClosePackingLaws, PacksAtLeastAsCloselyAsOneKindOfGrainsAndLeavesGaps) {
  for (const auto& law : TypeParam::samples()) {
    const double pure = std::min(law.value(0.0), law.value(1.0));
    for (int i = 0; i <= 1000; ++i) {
      EXPECT_GE(law.value(i / 1000.0), pure - 1e-15);
      EXPECT_LT(law.value(i / 1000.0), 1);
    }
  }
}

TYPED_TEST(ClosePackingLaws, IsContinuousAndBendsOnlyAtItsKinks) {
  for (const auto& law : TypeParam::samples()) {
    const double h = 1e-4;
    support::Checked checked({""}, 900);
    for (int i = 1; i < 999; ++i) {
      const double x = i / 1000.0 + 3e-5;
      const auto kinks = law.kinks();
      const bool is_near =
          std::any_of(kinks.begin(), kinks.end(), [&](double k) { return std::abs(k - x) <= h; });
      const double below = law.value(x - h), at = law.value(x), above = law.value(x + h);
      EXPECT_NEAR(below, above, 4 * h) << x;
      if (!is_near) {
        EXPECT_NEAR(below - 2 * at + above, 0, 1e-6) << x;
        EXPECT_NEAR(law.derivative(x), (above - below) / (2 * h), 1e-6) << x;
        checked.count();
      }
    }
    for (const double k : law.kinks()) {
      EXPECT_GT(k, 0);
      EXPECT_LT(k, 1);
    }
  }
}

TEST(ClosePacking, PolynomialOfTheSource) {
  // Horner's scheme against powers in 50 digits.
  for (const double x : {0.0, 0.1, 0.375, 0.5, 0.9, 1.0}) {
    const Real110 y(x);
    const Real110 p = Real110("-0.4903") * pow(y, 5) + Real110("1.2388") * pow(y, 4) -
                      Real110("0.9450") * pow(y, 3) + Real110("0.0434") * y * y + Real110("0.1531") * y +
                      Real110("0.633");
    EXPECT_NEAR(PackingPolynomial<double>{}.value(x), to_double(p), 3e-16);
  }
  EXPECT_NEAR(PackingPolynomial<double>{}.value(1), 0.633, 1e-15);
  // docs/theory/reference-values.md: largest at 0.375, by 0.0345.
  double x = 0;
  for (int i = 0; i <= 10000; ++i)
    if (PackingPolynomial<double>{}.value(i / 10000.0) > PackingPolynomial<double>{}.value(x))
      x = i / 10000.0;
  EXPECT_NEAR(x, 0.375, 5e-4);
  EXPECT_NEAR(PackingPolynomial<double>{}.value(x) - 0.633, 0.0345, 5e-5);
}

TEST(ClosePacking, UpperBoundIsReachedWhenAllGapsAreFull) {
  const PackingUpperBound<double> law{0.6};
  const double kink = law.kinks()[0];
  // Large grains fill 0.6, small ones 0.6 of the 0.4 between them.
  EXPECT_NEAR(law.value(kink), 0.6 + 0.6 * 0.4, 1e-15);
  EXPECT_NEAR(kink, 0.24 / 0.84, 1e-15);
  EXPECT_NEAR(law.value(0), 0.6, 1e-15);
  EXPECT_NEAR(law.value(1), 0.6, 1e-15);
}

TEST(ClosePacking, WrongLawsAreRefusedWithTheirKeys) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.5};
  const auto first = [&](ClosePacking<double> law) {
    spec.close_packing = std::move(law);
    const Complaints complaints = find_complaints(spec);
    return complaints.empty() ? std::string() : complaints.front().text();
  };
  EXPECT_EQ(first(PackingPolynomial<double>{0.633}), "");
  EXPECT_EQ(first(PackingPolynomial<double>{0.99}), "close_packing.pure = 0.99; must be < 0.95");
  EXPECT_EQ(first(PackingUpperBound<double>{1}), "close_packing.pure = 1; must be < 1");
  EXPECT_EQ(first(PackingUpperBound<double>{-1}), "close_packing.pure = -1; must be > 0");
  EXPECT_EQ(first(PackingTable<double>{{0}, {0.6}}),
            "close_packing.share = (1 entries); must have at least 2 entries");
  EXPECT_EQ(first(PackingTable<double>{{0, 0.5}, {0.6, 0.6}}),
            "close_packing.share[1] = 0.5; must be 1 (small grains only)");
  EXPECT_EQ(first(PackingTable<double>{{0, 0.5, 0.5, 1}, {0.6, 0.7, 0.7, 0.6}}),
            "close_packing.share[2] = 0.5; must be greater than the entry before it (0.5)");
  EXPECT_EQ(first(PackingTable<double>{{0, 1}, {0.6, 1}}), "close_packing.values[1] = 1; must be < 1");
}

}  // namespace
}  // namespace shearfront
