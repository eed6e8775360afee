// SPDX-License-Identifier: BSD-3-Clause
// Laws of shear rates, run for every model of depth/all.hpp and for its skeleton.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "shearfront/model/depth/all.hpp"
#include "shearfront/model/depth/skeleton.hpp"
#include "shearfront/scene/scene.hpp"
#include "support/checked.hpp"
#include "support/model_types.hpp"

namespace shearfront {
namespace {

template <class Model>
class ShearRateLaws : public testing::Test {};

using ShearRateLawsTypes =
    support::ModelTypes<DepthFunctionList<double>, SkeletonDepthFunction<double>>::Type;
TYPED_TEST_SUITE(ShearRateLaws, ShearRateLawsTypes, support::ModelName);

/// [0, 1] cut at the knots.
template <class Model>
std::vector<double> pieces(const Model& a) {
  std::vector<double> cuts{0, 1};
  for (const double z : a.knots())
    if (z > 0 && z < 1) cuts.push_back(z);
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

/// int dz / a over [lo, hi] by Gauss's three-point rule on 128 panels in the root of the distance from hi, where a may vanish as a root.
template <class Model>
double slowness(const Model& a, double lo, double hi) {
  const double node = std::sqrt(0.6);
  double sum = 0;
  const int panels = 128;
  const auto part = [&](double x) { return 2 * x * (hi - lo) / a.value(hi - (hi - lo) * x * x); };
  for (int i = 0; i < panels; ++i) {
    const double h = 1.0 / panels, mid = (i + 0.5) * h;
    sum += h / 18 * (5 * part(mid - node * h / 2) + 8 * part(mid) + 5 * part(mid + node * h / 2));
  }
  return sum;
}

TYPED_TEST(ShearRateLaws, HasSamplesThatPassTheirOwnCheck) {
  ASSERT_FALSE(TypeParam::samples().empty());
  for (const auto& a : TypeParam::samples()) {
    Complaints complaints;
    a.check("shear_rate.", 0.0, 1.0, complaints);
    EXPECT_TRUE(complaints.empty()) << (complaints.empty() ? "" : complaints[0].text());
    std::set<std::string> keys;
    TypeParam::fields(a, [&](const FieldInfo& info, const auto& member) {
      check_number(std::string(info.key), info.range, member, complaints);
      EXPECT_TRUE(keys.insert(std::string(info.key)).second) << "two fields called " << info.key;
    });
    EXPECT_TRUE(complaints.empty());
    EXPECT_FALSE(keys.empty());
  }
}

TYPED_TEST(ShearRateLaws, IsPositiveAndFinite) {
  for (const auto& a : TypeParam::samples())
    for (int i = 0; i <= 100; ++i) {
      const double z = i / 100.0;
      const bool may_vanish = (i == 0 || i == 100) && may_vanish_at(a, z);
      EXPECT_TRUE(a.value(z) > 0 || (may_vanish && a.value(z) == 0)) << z;
      EXPECT_TRUE(is_finite(a.value(z)));
    }
}

TYPED_TEST(ShearRateLaws, HarmonicMeanIsTheMeanOfTheTravelTime) {
  for (const auto& a : TypeParam::samples()) {
    const auto cuts = pieces(a);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double lo = cuts[i], hi = cuts[i + 1], third = lo + (hi - lo) / 3;
      for (const auto& [from, to] : {std::pair{lo, hi}, std::pair{lo, third}, std::pair{third, hi}}) {
        const double mean = a.harmonic_mean(from, to);
        EXPECT_NEAR((to - from) / mean, slowness(a, from, to), 1e-7 * slowness(a, from, to));
      }
    }
  }
}

TYPED_TEST(ShearRateLaws, HarmonicMeanOfAThinLayerIsTheValue) {
  for (const auto& a : TypeParam::samples()) {
    const auto cuts = pieces(a);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double z = 0.5 * (cuts[i] + cuts[i + 1]), h = 1e-9;
      EXPECT_NEAR(a.harmonic_mean(z, z + h), a.value(z), 1e-6 * a.value(z));
    }
  }
}

/// Where it says by which entries its mean and its ends change, those are the derivatives.
TYPED_TEST(ShearRateLaws, DerivativesAreThoseOfDifferences) {
  for (const auto& a : TypeParam::samples()) {
    const auto cuts = pieces(a);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double lo = cuts[i] + 0.2 * (cuts[i + 1] - cuts[i]), hi = cuts[i] + 0.7 * (cuts[i + 1] - cuts[i]);
      auto moved = a;
      const auto places = model_entries(moved);
      std::vector<double> mean(places.size()), low(places.size()), high(places.size());
      const auto into = [](std::vector<double>& all) {
        return [&all](std::size_t entry, double by) { all[entry] += by; };
      };
      harmonic_mean_derivatives(a, lo, hi, into(mean));
      const auto add_low = into(low), add_high = into(high);
      constexpr bool kHasEnds = requires { a.end_value_derivatives(lo, hi, add_low, add_high); };
      if constexpr (kHasEnds) a.end_value_derivatives(lo, hi, add_low, add_high);
      for (std::size_t e = 0; e < places.size(); ++e) {
        const double here = *places[e], h = 1e-4 * std::abs(here);
        const auto knots = a.knots();
        if (h == 0 || std::count(knots.begin(), knots.end(), here) > 1) continue;  // one side of a jump
        const auto difference = [&](const auto& f) {
          const auto at = [&](int n) {
            *places[e] = here + n * h;
            return f();
          };
          const double by = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
          *places[e] = here;
          return by;
        };
        const double slack = 1e-8 * a.value(lo) / std::abs(here);
        const auto near = [&](double value, double by, const char* of) {
          EXPECT_NEAR(value, by, 1e-7 * std::abs(by) + slack) << of << " by entry " << e;
        };
        near(mean[e], difference([&] { return moved.harmonic_mean(lo, hi); }), "mean");
        if (!kHasEnds) continue;
        near(low[e], difference([&] { return moved.value(lo); }), "low end");
        near(high[e], difference([&] { return moved.value(hi); }), "high end");
      }
    }
  }
}

TYPED_TEST(ShearRateLaws, KnotsAscend) {
  for (const auto& a : TypeParam::samples()) {
    const auto knots = a.knots();
    EXPECT_TRUE(std::is_sorted(knots.begin(), knots.end()));
    // A height given twice is a jump.
    for (std::size_t i = 1; i < knots.size(); ++i) {
      EXPECT_TRUE(knots[i - 1] < knots[i] || may_jump_at(a, knots[i])) << i;
    }
    for (std::size_t i = 2; i < knots.size(); ++i) EXPECT_LT(knots[i - 2], knots[i]);
  }
}

TYPED_TEST(ShearRateLaws, EveryFieldRefusesNotANumber) {
  support::Checked checked;
  for (const auto& sample : TypeParam::samples()) {
    std::size_t n_fields = 0;
    TypeParam::fields(sample, [&](const FieldInfo&, const auto&) { ++n_fields; });
    for (std::size_t broken = 0; broken < n_fields; ++broken) {
      auto a = sample;
      std::size_t i = 0;
      std::string key;
      bool changed = false;
      TypeParam::fields(a, [&](const FieldInfo& info, auto& member) {
        if (i++ != broken) return;
        key = info.key;
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>) {
          member = std::numeric_limits<double>::quiet_NaN();
          changed = true;
        } else if (!member.empty()) {
          member[0] = std::numeric_limits<double>::quiet_NaN();
          changed = true;
        }
      });
      if (!changed) continue;
      Complaints complaints;
      TypeParam::fields(a, [&](const FieldInfo& info, const auto& member) {
        check_number(std::string(info.key), info.range, member, complaints);
      });
      ASSERT_FALSE(complaints.empty()) << key;
      EXPECT_EQ(complaints[0].key.rfind(key, 0), 0u);
      checked.count();
    }
  }
}

template <class Model>
struct IsLayered : std::bool_constant<Model::kIsLayered> {};

template <class Model>
class LayeredShearRateLaws : public testing::Test {};

using LayeredTypes = support::ModelsThat<DepthFunctionList<double>, IsLayered>::Type;
TYPED_TEST_SUITE(LayeredShearRateLaws, LayeredTypes, support::ModelName);

TYPED_TEST(LayeredShearRateLaws, AreConstantBetweenKnots) {
  support::Checked checked;
  for (const auto& a : TypeParam::samples()) {
    const auto cuts = pieces(a);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      for (const double w : {0.01, 0.5, 0.99}) {
        EXPECT_EQ(a.value(cuts[i] + w * (cuts[i + 1] - cuts[i])), a.value(cuts[i]));
        checked.count();
      }
  }
}

TEST(TableOfKnotsAnUlpApart, MeansLieBetweenTheValues) {
  const double z1 = 0.1111110890848754, z2 = std::nextafter(z1, 1.0), z3 = std::nextafter(z2, 1.0);
  const Table<double> table{{0, z1, z2, z3, 1}, {2.3, 3.4, 1.2, 6.7, 3.3}};
  for (std::size_t i = 0; i + 1 < table.z.size(); ++i) {
    const double mean = table.harmonic_mean(table.z[i], table.z[i + 1]);
    EXPECT_GE(mean, std::min(table.values[i], table.values[i + 1])) << i;
    EXPECT_LE(mean, std::max(table.values[i], table.values[i + 1])) << i;
  }
}

TEST(ScaledRates, MustNotOverflowOrVanish) {
  SceneSpec<double> spec;
  spec.initial_values = {0.5};
  spec.shear_rate = Piecewise<double>{{0.3}, {2.4, 1e200}};
  for (const double scale : {1e-300, 1.0, 1e100}) {
    spec.scale = scale;
    EXPECT_TRUE(find_complaints(spec).empty()) << scale;
  }
  spec.scale = 1e200;
  ASSERT_EQ(find_complaints(spec).size(), 1u);
  EXPECT_EQ(
      find_complaints(spec)[0].text(),
      "shear_rate.scale = 1e+200; must keep s a(z) a positive finite number on the whole domain (a(1) = "
      "1e+200)");
  spec.shear_rate = Piecewise<double>{{0.3, 0.6}, {1, 1e-200, 1}};
  spec.scale = 1e-200;
  ASSERT_EQ(find_complaints(spec).size(), 1u);
  EXPECT_EQ(find_complaints(spec)[0].key, "shear_rate.scale");
}

}  // namespace
}  // namespace shearfront
