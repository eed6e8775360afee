// SPDX-License-Identifier: BSD-3-Clause
// Laws of fluxes, run for every model of flux/all.hpp and for its skeleton.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shearfront/flux/all.hpp"
#include "shearfront/flux/skeleton.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {
namespace {

template <class Model>
class FluxLaws : public testing::Test {};

struct ModelName {
  template <class Model>
  static std::string GetName(int) {
    return std::string(Model::kName);
  }
};

template <class List>
struct AsTestTypes;
template <class... Model>
struct AsTestTypes<TypeList<Model...>> {
  using Type = testing::Types<Model..., SkeletonFlux>;
};
TYPED_TEST_SUITE(FluxLaws, AsTestTypes<FluxList>::Type, ModelName);

template <class Model>
std::vector<double> states() {
  std::vector<double> phi;
  for (int i = 0; i <= 40; ++i)
    phi.push_back(Model::kRange[0] + (Model::kRange[1] - Model::kRange[0]) * i / 40);
  return phi;
}

TYPED_TEST(FluxLaws, VanishesAtBothPureStates) {
  for (const auto& flux : TypeParam::samples())
    for (const double end : TypeParam::kRange) EXPECT_EQ(flux.value(end), 0.0);
}

TYPED_TEST(FluxLaws, DerivativeIsTheLimitOfDifferences) {
  const Real50 h("1e-15");
  for (const auto& flux : TypeParam::samples())
    for (const double p : states<TypeParam>()) {
      const Real50 phi(p);
      const Real50 difference = (flux.value(Real50(phi + h)) - flux.value(Real50(phi - h))) / (2 * h);
      EXPECT_NEAR(to_double(Real50(flux.derivative(phi) - difference)), 0.0, 1e-25) << p;
    }
}

TYPED_TEST(FluxLaws, SecantIsTheSlopeOfTheChord) {
  for (const auto& flux : TypeParam::samples())
    for (const double p : states<TypeParam>())
      for (const double q : states<TypeParam>()) {
        if (p == q) {
          EXPECT_NEAR(flux.secant(p, q), flux.derivative(p), 1e-15);
        } else {
          EXPECT_NEAR(flux.secant(p, q), (flux.value(q) - flux.value(p)) / (q - p), 1e-13);
          EXPECT_NEAR(flux.secant(p, q), flux.secant(q, p), 1e-15);
        }
      }
}

TYPED_TEST(FluxLaws, SecantOfCloseStatesDoesNotCancel) {
  for (const auto& flux : TypeParam::samples())
    for (const double p : states<TypeParam>()) {
      const double q = std::nextafter(p, 0.5);
      EXPECT_NEAR(flux.secant(p, q), flux.derivative(p), 1e-14);
    }
}

TYPED_TEST(FluxLaws, ExtremaAreWhereTheDerivativeChangesSign) {
  for (const auto& flux : TypeParam::samples()) {
    for (const double e : TypeParam::kExtrema) {
      EXPECT_GT(e, TypeParam::kRange[0]);
      EXPECT_LT(e, TypeParam::kRange[1]);
      EXPECT_NEAR(flux.derivative(e), 0.0, 1e-12);
      EXPECT_LT(flux.derivative(e - 1e-3) * flux.derivative(e + 1e-3), 0.0);
    }
    // No extremum is missing: between neighbours the flux is monotone.
    std::vector<double> cuts{TypeParam::kRange[0]};
    cuts.insert(cuts.end(), TypeParam::kExtrema.begin(), TypeParam::kExtrema.end());
    cuts.push_back(TypeParam::kRange[1]);
    EXPECT_TRUE(std::is_sorted(cuts.begin(), cuts.end()));
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double sign = flux.value(cuts[i + 1]) - flux.value(cuts[i]);
      for (int k = 0; k < 50; ++k) {
        const double lo = cuts[i] + (cuts[i + 1] - cuts[i]) * k / 50,
                     hi = cuts[i] + (cuts[i + 1] - cuts[i]) * (k + 1) / 50;
        EXPECT_GT((flux.value(hi) - flux.value(lo)) * sign, 0.0);
      }
    }
  }
}

}  // namespace
}  // namespace shearfront
