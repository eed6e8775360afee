// SPDX-License-Identifier: BSD-3-Clause
// Laws of smooth initial states, run for every model of start/all.hpp and for its skeleton.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <string>
#include <vector>

#include "shearfront/model/start/all.hpp"
#include "shearfront/model/start/skeleton.hpp"
#include "shearfront/scene/scene.hpp"
#include "support/model_types.hpp"

namespace shearfront {
namespace {

template <class Model>
class InitialLaws : public testing::Test {};

using InitialLawsTypes = support::ModelTypes<InitialStateList<double>, SkeletonInitial<double>>::Type;
TYPED_TEST_SUITE(InitialLaws, InitialLawsTypes, support::ModelName);

TYPED_TEST(InitialLaws, HasSamplesThatPassTheirOwnCheck) {
  ASSERT_FALSE(TypeParam::samples().empty());
  for (const auto& model : TypeParam::samples()) {
    Complaints complaints;
    model.fields(model, [&](const FieldInfo& info, const auto& x) {
      check_number(std::string(info.key), info.range, x, complaints);
    });
    model.check("initial.", 0.0, 1.0, complaints);
    EXPECT_TRUE(complaints.empty());
  }
}

TYPED_TEST(InitialLaws, StaysInItsRange) {
  for (const auto& model : TypeParam::samples())
    for (int i = 0; i <= 1000; ++i) {
      EXPECT_GE(model.value(i / 1000.0), model.lowest() - 1e-15);
      EXPECT_LE(model.value(i / 1000.0), model.highest() + 1e-15);
    }
}

TYPED_TEST(InitialLaws, IntegralIsThatOfTheValues) {
  for (const auto& model : TypeParam::samples())
    for (const auto& [lo, hi] : {std::pair{0.0, 1.0}, {0.1, 0.4}, {0.25, 0.2500001}, {0.55, 0.93}}) {
      const double by_quadrature = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
          [&](double z) { return model.value(z); }, lo, hi, 15, 1e-13);
      EXPECT_NEAR(model.integral(lo, hi), by_quadrature, 1e-12);
    }
}

TYPED_TEST(InitialLaws, IntegralsAddUp) {
  for (const auto& model : TypeParam::samples())
    EXPECT_NEAR(model.integral(0.0, 0.3) + model.integral(0.3, 1.0), model.integral(0.0, 1.0), 1e-15);
}

/// A table gave a range that ran backwards.
TYPED_TEST(InitialLaws, HasNoKnotWhereThereIsNoHeight) {
  for (const auto& model : TypeParam::samples()) {
    std::vector<double> heights{0, 0.4, 1};
    for (const double z : model.knots(0, 1)) heights.push_back(z);
    for (const double z : heights) EXPECT_TRUE(model.knots(z, z).empty()) << z;
  }
}

TYPED_TEST(InitialLaws, IsMonotoneBetweenItsKnotsAndSoIsItsSlope) {
  for (const auto& model : TypeParam::samples()) {
    std::vector<double> ends{0};
    const std::vector<double> knots = model.knots(0, 1);
    ends.insert(ends.end(), knots.begin(), knots.end());
    ends.push_back(1);
    ASSERT_TRUE(std::is_sorted(ends.begin(), ends.end()));
    ASSERT_EQ(std::adjacent_find(ends.begin(), ends.end()), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const auto at = [&](int k) { return model.value(ends[i] + (ends[i + 1] - ends[i]) * k / 100); };
      int n_up = 0, n_down = 0, n_bent_up = 0, n_bent_down = 0;
      for (int k = 0; k < 100; ++k) {
        const double rise = at(k + 1) - at(k);
        n_up += rise > 1e-15;
        n_down += rise < -1e-15;
        if (k == 0) continue;
        const double bend = rise - (at(k) - at(k - 1));
        n_bent_up += bend > 1e-13;
        n_bent_down += bend < -1e-13;
      }
      EXPECT_TRUE(n_up == 0 || n_down == 0);
      EXPECT_TRUE(n_bent_up == 0 || n_bent_down == 0);
    }
  }
}

TEST(InitialStates, OfTooManyWavesAreRefused) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_state = SineInitial<double>{0.5, 0.1, 1e-6, 0};
  const Complaints complaints = find_complaints(spec);
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_EQ(complaints.front().text(),
            "initial.wavelength = 1e-06; must be at least 1e-05, which makes 1e+05 waves");
}

/// With a solid fraction the numbers are shares: int c(z) share dz, by halves of a fine rule.
TEST(InitialStates, AmountsBesideASolidFraction) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_state = KinkInitial<double>{0.75, 0.1, 0.4, 0.03};
  for (const DepthFunction<double>& c :
       std::vector<DepthFunction<double>>{Piecewise<double>{{0.45}, {0.5, 0.7}}, Exponential<double>{0.6, 2},
                                          Table<double>{{0, 0.3, 1}, {0.4, 0.6, 0.5}}}) {
    spec.solid_fraction = c;
    const Scene<double> scene(spec);
    for (const auto& [lo, hi] : {std::pair{0.0, 1.0}, {0.1, 0.47}, {0.39, 0.41}}) {
      const double by_quadrature = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
          [&](double z) { return scene.solid_fraction_at(z) * scene.initial_share(z); }, lo, hi, 18, 1e-13);
      EXPECT_NEAR(scene.initial_amount(lo, hi), by_quadrature, 1e-10);
    }
    EXPECT_EQ(scene.mass(), scene.initial_amount(0, 1));
    EXPECT_EQ(scene.initial_phi(0.2), scene.solid_fraction_at(0.2) * scene.initial_share(0.2));
  }
}

SceneSpec<double> spec_with(InitialState<double> profile, double D) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.diffusion = Diffusion<double>{D, {}, false};
  spec.initial_state = std::move(profile);
  return spec;
}

TEST(DiffusiveScenes, SmoothDataNeedStatesOfTheFlux) {
  const auto first = [](const SceneSpec<double>& spec) {
    const Complaints complaints = find_complaints(spec);
    return complaints.empty() ? std::string() : complaints.front().text();
  };
  EXPECT_EQ(first(spec_with(KinkInitial<double>{0.75, 0, 0.5, 0.1}, 0.01)), "");
  EXPECT_EQ(first(spec_with(KinkInitial<double>{0.75, 0, 0.5, 0.1}, 0)), "");
  EXPECT_EQ(first(spec_with(SineInitial<double>{0.75, 0.5, 1, 0}, 0.01)),
            "initial.model = sine; must stay between 0 and 1 (goes from 0.25 to 1.25)");
  EXPECT_EQ(first(spec_with(KinkInitial<double>{0.75, 0, 0.5, 0.1}, -1)), "diffusion.D = -1; must be > 0");
  SceneSpec<double> spec = spec_with(KinkInitial<double>{0.75, 0, 0.5, 0.1}, 0.01);
  spec.is_neumann = spec.is_periodic = true;
  EXPECT_EQ(first(spec), "boundary.neumann = true; must not stand beside other ends");
}

TEST(DiffusiveScenes, AmountsAreIntegralsOfTheInitialData) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.25, 0.5};
  spec.initial_values = {0.5, 1, 0.25};
  const Scene<double> steps(spec);
  EXPECT_NEAR(steps.initial_amount(0.125, 0.75), 0.125 * 0.5 + 0.25 + 0.25 * 0.25, 1e-16);
  EXPECT_NEAR(steps.initial_amount(0.25, 0.5), 0.25, 1e-16);
  EXPECT_NEAR(steps.initial_amount(0, 1), steps.mass(), 1e-16);
  const Scene<double> smooth(spec_with(KinkInitial<double>{0.75, 0, 0.5, 0.1}, 0.01));
  EXPECT_EQ(smooth.mass(), smooth.initial_amount(0, 1));
  EXPECT_NEAR(smooth.mass(), 0.375, 1e-15);  // odd about the middle
  EXPECT_FALSE(smooth.is_plain());
}

TEST(DiffusiveScenes, DiffusivityFollowsWhatItIsToldTo) {
  SceneSpec<double> spec = spec_with(KinkInitial<double>{0.75, 0, 0.5, 0.1}, 0.5);
  spec.shear_rate = Piecewise<double>{{0.5}, {3, 1}};
  spec.scale = 7;
  EXPECT_EQ(Scene<double>(spec).diffusivity_at(0.1), 0.5);
  spec.diffusion->follows_shear_rate = true;
  EXPECT_EQ(Scene<double>(spec).diffusivity_at(0.1), 1.5);
  EXPECT_EQ(Scene<double>(spec).diffusivity_at(0.9), 0.5);
  spec.diffusion->follows_shear_rate = false;
  spec.diffusion->variation = Table<double>{{0, 1}, {1, 2}};
  EXPECT_EQ(Scene<double>(spec).diffusivity_at(0.5), 0.75);
}

}  // namespace
}  // namespace shearfront
