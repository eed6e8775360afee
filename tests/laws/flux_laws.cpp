// SPDX-License-Identifier: BSD-3-Clause
// Laws of fluxes, run for every model of flux/all.hpp and for its skeleton.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/model/flux/skeleton.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/type_list.hpp"
#include "support/checked.hpp"
#include "support/model_types.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

template <class Model>
class FluxLaws : public testing::Test {};

using FluxLawsTypes = support::ModelTypes<FluxList<double>, SkeletonFlux<double>>::Type;
TYPED_TEST_SUITE(FluxLaws, FluxLawsTypes, support::ModelName);

/// Calls visit(flux, lowest, highest, largest |f'|) for every sample.
template <class Model, class Visit>
void for_samples(Visit&& visit) {
  int number = 0;
  ASSERT_FALSE(Model::samples().empty());
  for (const Model& flux : Model::samples()) {
    SCOPED_TRACE("sample " + std::to_string(number++));
    Complaints complaints;
    flux.fields(flux, [&](const FieldInfo& info, const auto& member) {
      check_number(std::string(info.key), info.range, member, complaints);
    });
    flux.check("", complaints);
    ASSERT_TRUE(complaints.empty()) << complaints[0].text();
    const auto [lowest, highest] = flux.range();
    double steepest = 0;
    for (int i = 0; i <= 1000; ++i)
      steepest = std::max(steepest, std::abs(flux.derivative(lowest + (highest - lowest) * i / 1000)));
    visit(flux, lowest, highest, steepest);
  }
}

std::vector<double> states(double lowest, double highest, int n = 40) {
  std::vector<double> phi;
  for (int i = 0; i < n; ++i) phi.push_back(lowest + (highest - lowest) * i / n);
  phi.push_back(highest);
  return phi;
}

/// Differences of one order more than the degree vanish between extrema and joints, and those of the degree do not all.
TYPED_TEST(FluxLaws, APolynomialBetweenJointsHasItsDegree) {
  constexpr int kDegree = degree_between_joints<TypeParam>();
  if constexpr (kDegree <= 3) {
    double largest = 0;
    for_samples<TypeParam>([&](const auto& flux, double lowest, double highest, double steepest) {
      std::vector<double> ends = flux.extrema();
      if constexpr (requires { flux.joints(); })
        for (const double joint : flux.joints()) ends.push_back(joint);
      ends.push_back(lowest);
      ends.push_back(highest);
      std::sort(ends.begin(), ends.end());
      for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
        std::vector<double> f;
        for (int i = 0; i <= kDegree + 1; ++i)
          f.push_back(flux.value(ends[k] + (ends[k + 1] - ends[k]) * i / (kDegree + 1)));
        for (std::size_t order = 1; order + 1 < f.size(); ++order)
          for (std::size_t i = 0; i + order < f.size(); ++i) f[i] = f[i + 1] - f[i];
        largest = std::max(largest, std::abs(f[0]));
        EXPECT_NEAR(f[1], f[0], 1e-14 * steepest * (highest - lowest))
            << "between " << ends[k] << " and " << ends[k + 1];
      }
    });
    EXPECT_GT(largest, 0);
  }
}

TYPED_TEST(FluxLaws, StatesAreARangeWithAFiniteFlux) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double steepest) {
    EXPECT_LT(lowest, highest);
    EXPECT_GT(steepest, 0);
    for (const double phi : states(lowest, highest)) EXPECT_TRUE(std::isfinite(flux.value(phi))) << phi;
  });
}

TYPED_TEST(FluxLaws, DerivativeIsTheSlopeAbove) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double steepest) {
    const auto flux50 = scene_detail::model_cast<Real110>(flux);
    const auto all = states(lowest, highest);
    for (const double p : all) {
      // Two one-sided differences, whose errors of first order cancel; to the inside at the upper end.
      const Real110 h = (p == highest ? -1 : 1) * Real110("1e-15") * (highest - lowest), phi(p);
      const auto difference = [&](const Real110& step) {
        return Real110((flux50.value(Real110(phi + step)) - flux50.value(phi)) / step);
      };
      const Real110 slope = 2 * difference(h / 2) - difference(h);
      EXPECT_NEAR(to_double(Real110(flux50.derivative(phi) - slope)), 0.0, 1e-19 * steepest) << p;
      EXPECT_NEAR(flux.derivative(p), to_double(slope), 1e-14 * steepest) << p;
    }
  });
}

TYPED_TEST(FluxLaws, SecantIsTheSlopeOfTheChord) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double steepest) {
    const auto flux50 = scene_detail::model_cast<Real110>(flux);
    const auto all = states(lowest, highest);
    for (const double p : all)
      for (const double q : all) {
        if (p == q) {
          EXPECT_NEAR(flux.secant(p, q), flux.derivative(p), 1e-14 * steepest);
        } else {
          const Real110 rise = flux50.value(Real110(q)) - flux50.value(Real110(p));
          EXPECT_NEAR(flux.secant(p, q), to_double(Real110(rise / (Real110(q) - Real110(p)))),
                      1e-14 * steepest)
              << p << " " << q;
          EXPECT_NEAR(flux.secant(p, q), flux.secant(q, p), 1e-15 * steepest);
        }
      }
  });
}

TYPED_TEST(FluxLaws, SecantOfCloseStatesDoesNotCancel) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double steepest) {
    const auto flux50 = scene_detail::model_cast<Real110>(flux);
    support::Checked checked({""}, 100);
    for (const double p : states(lowest, highest))
      for (const double d : {1e-15, 1e-12, 1e-8, 1e-4}) {
        const double q = p < highest ? p + d * (highest - p) : p - d * (p - lowest);
        if (q == p) continue;
        const Real110 rise = flux50.value(Real110(q)) - flux50.value(Real110(p));
        EXPECT_NEAR(flux.secant(p, q), to_double(Real110(rise / (Real110(q) - Real110(p)))), 4e-14 * steepest)
            << p << " " << d;
        checked.count();
      }
  });
}

TYPED_TEST(FluxLaws, ExtremaAreWhereTheDerivativeChangesSign) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double steepest) {
    const double width = highest - lowest;
    std::vector<double> cuts{lowest};
    for (const double e : flux.extrema()) {
      EXPECT_GT(e, lowest);
      EXPECT_LT(e, highest);
      EXPECT_LT(flux.derivative(e - 1e-3 * width) * flux.derivative(e + 1e-3 * width), 0.0);
      const double below = flux.derivative(e - 1e-12 * width), above = flux.derivative(e + 1e-12 * width);
      // Flat, or a kink.
      EXPECT_TRUE(std::abs(below) < 1e-10 * steepest || std::abs(above - below) > 0.1 * steepest) << e;
      cuts.push_back(e);
    }
    // No extremum is missing: between neighbours the flux is monotone.
    cuts.push_back(highest);
    EXPECT_TRUE(std::is_sorted(cuts.begin(), cuts.end()));
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double sign = flux.value(cuts[i + 1]) - flux.value(cuts[i]);
      const auto all = states(cuts[i], cuts[i + 1], 50);
      for (std::size_t k = 0; k + 1 < all.size(); ++k)
        EXPECT_GT((flux.value(all[k + 1]) - flux.value(all[k])) * sign, 0.0) << all[k];
    }
  });
}

TYPED_TEST(FluxLaws, CurvatureIsAsSaid) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double steepest) {
    bool is_convex = true, is_concave = true;
    const auto all = states(lowest, highest, 1000);
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      const double bend = flux.derivative(all[i + 1]) - flux.derivative(all[i]);
      is_convex = is_convex && bend >= -1e-13 * steepest;
      is_concave = is_concave && bend <= 1e-13 * steepest;
    }
    EXPECT_TRUE(flux.curvature() != Curvature::convex || is_convex);
    EXPECT_TRUE(flux.curvature() != Curvature::concave || is_concave);
    EXPECT_TRUE(flux.curvature() != Curvature::mixed || !(is_convex || is_concave));
  });
}

template <class Model>
struct IsParabola : std::bool_constant<Model::kIsParabola> {};

template <class Model>
class ParabolaLaws : public testing::Test {};

using ParabolaTypes = support::ModelsThat<FluxList<double>, IsParabola>::Type;
TYPED_TEST_SUITE(ParabolaLaws, ParabolaTypes, support::ModelName);

TYPED_TEST(ParabolaLaws, IsOne) {
  for_samples<TypeParam>([](const auto& flux, double lowest, double highest, double) {
    ASSERT_EQ(flux.extrema().size(), 1u);
    const double depth = flux.value(flux.extrema()[0]);
    for (const double phi : states(lowest, highest)) {
      const double u = (phi - lowest) / (highest - lowest);
      EXPECT_NEAR(flux.value(phi), 4 * depth * u * (1 - u), 1e-15 * std::abs(depth));
    }
  });
}

// Gajjar & Gray compare fluxes of one extremum; the factor is 1 without and 27/16 with full asymmetry.
TEST(CubicFlux, ScaledExtremumIsThatOfTheQuadraticFlux) {
  constexpr auto kScaled = CubicScaling::quadratic_extremum;
  const Quadratic<double> quadratic;
  constexpr double kBound = 20 * 0x1p-53 / 4;  // about 20 operations, each of relative error 2^-53
  for (int i = 0; i <= 1000; ++i) {
    const Cubic<double> flux{i / 1000.0, kScaled}, own{i / 1000.0};
    const double extremum = flux.extrema()[0];
    EXPECT_NEAR(flux.value(extremum), quadratic.value(0.5), kBound) << flux.gamma;
    EXPECT_EQ(extremum, own.extrema()[0]);
    EXPECT_EQ(flux.curvature(), own.curvature());
    // Nowhere deeper, and one factor for all states.
    for (const double phi : states(0, 1)) EXPECT_GE(flux.value(phi), -0.25 - kBound) << flux.gamma;
    EXPECT_NEAR(flux.value(0.3) / own.value(0.3), flux.derivative(0) / own.derivative(0), 4 * kBound);
    const Cubic<Real110> fine{Real110(flux.gamma), kScaled};
    EXPECT_NEAR(to_double(Real110(fine.value(fine.extrema()[0]) + Real110(0.25))), 0, 1e-48);
  }
  EXPECT_EQ((Cubic<double>{0, kScaled}.value(0.375)), quadratic.value(0.375));
  EXPECT_NEAR((Cubic<double>{1, kScaled}.derivative(0)), -27.0 / 16, 4e-16);
}

TEST(TableFlux, TakesItsLastValueToTheBit) {
  for (const auto& flux : FluxTable<double>::samples())
    EXPECT_EQ(flux.value(flux.phi.back()), flux.values.back());
}

}  // namespace
}  // namespace shearfront
