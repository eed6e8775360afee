// SPDX-License-Identifier: BSD-3-Clause
// Laws of velocities, run for every model of velocity/all.hpp and for its skeleton, and of what a steady chute makes of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/model/velocity/all.hpp"
#include "shearfront/model/velocity/skeleton.hpp"
#include "shearfront/scene/chute.hpp"
#include "support/model_types.hpp"

namespace shearfront {
namespace {

template <class Model>
class VelocityLaws : public testing::Test {};

using VelocityLawsTypes = support::ModelTypes<VelocityList<double>, SkeletonVelocity<double>>::Type;
TYPED_TEST_SUITE(VelocityLaws, VelocityLawsTypes, support::ModelName);

TYPED_TEST(VelocityLaws, HasSamplesThatPassTheirOwnCheck) {
  ASSERT_FALSE(TypeParam::samples().empty());
  for (const auto& model : TypeParam::samples()) {
    Complaints complaints;
    model.fields(model, [&](const FieldInfo& info, const auto& x) {
      check_number(std::string(info.key), info.range, x, complaints);
    });
    model.check("velocity.", 0.0, 1.0, complaints);
    EXPECT_TRUE(complaints.empty());
  }
}

TYPED_TEST(VelocityLaws, IsMonotoneBetweenItsKnots) {
  for (const auto& model : TypeParam::samples()) {
    std::vector<double> ends{0.0};
    for (const double z : model.knots())
      if (z > 0 && z < 1) ends.push_back(z);
    ends.push_back(1.0);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double first = model.value(ends[i]), last = model.value(ends[i + 1]);
      for (int k = 0; k <= 100; ++k) {
        const double u = model.value(ends[i] + (ends[i + 1] - ends[i]) * k / 100);
        EXPECT_GE(u, std::min(first, last) - 1e-15);
        EXPECT_LE(u, std::max(first, last) + 1e-15);
      }
    }
  }
}

TYPED_TEST(VelocityLaws, FlowIsTheIntegralOfTheValues) {
  for (const auto& model : TypeParam::samples())
    for (const auto& [lo, hi] : {std::pair{0.0, 1.0}, {0.1, 0.4}, {0.25, 0.2500001}, {0.55, 0.93}}) {
      const double by_quadrature = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
          [&](double z) { return model.value(z); }, lo, hi, 15, 1e-13);
      EXPECT_NEAR(model.flow(lo, hi), by_quadrature, 1e-12 * (1 + model.value(1)));
    }
}

TYPED_TEST(VelocityLaws, HeightOfIsTheInverseOfFlow) {
  for (const auto& model : TypeParam::samples())
    for (const double lo : {0.0, 0.2, 0.6})
      for (int k = 0; k <= 100; ++k) {
        const double z = lo + (1 - lo) * k / 100, amount = model.flow(lo, z);
        // Where u vanishes the height is as exact as the square root of an amount that is rounded.
        EXPECT_NEAR(model.flow(lo, model.height_of(lo, amount)), amount, 4e-15 * (1 + model.value(1)));
        if (z > lo + 0.1) {
          EXPECT_NEAR(model.height_of(lo, amount), z, 1e-13);
        }
      }
}

/// What is in a scene: the models of the list.
template <class Model>
class ChuteLaws : public testing::Test {};

using ChuteLawsTypes = support::ModelTypes<VelocityList<double>>::Type;
TYPED_TEST_SUITE(ChuteLaws, ChuteLawsTypes, support::ModelName);

/// A bed in which everything varies.
SceneSpec<double> rich_bed() {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{2, 0.4};
  spec.solid_fraction = Table<double>{{0, 0.35, 1}, {0.6, 0.5, 0.58}};
  spec.temperature = Piecewise<double>{{0.5}, {1, 2}};
  spec.initial_breaks = {0.25, 0.75};
  spec.initial_values = {0.2, 0.9, 0.4};
  return spec;
}

TYPED_TEST(ChuteLaws, HeightsOfTheBedGoThereAndBack) {
  for (const auto& model : TypeParam::samples()) {
    SceneSpec<double> spec = rich_bed();
    spec.velocity = model;
    const Scene<double> scene(spec);
    const SteadyChute<double> chute(scene);
    EXPECT_EQ(chute.bed_height(0), 0);
    EXPECT_EQ(chute.bed_height(1), 1);
    for (const double z : scene.knots()) EXPECT_EQ(chute.height(chute.bed_height(z)), z);
    for (int k = 0; k < 100; ++k) {
      const double z = (k + 0.5) / 100;
      EXPECT_LT(chute.bed_height(z), chute.bed_height(z + 0.005));
      EXPECT_NEAR(chute.height(chute.bed_height(z)), z, 1e-13);
    }
  }
}

/// The same by quadrature over everything that varies: some 10 s for a model.
template <class Model>
class SlowChuteLaws : public testing::Test {};
TYPED_TEST_SUITE(SlowChuteLaws, ChuteLawsTypes, support::ModelName);

TYPED_TEST(SlowChuteLaws, WhatPassesIsWhatTheBedHolds) {
  for (const auto& model : TypeParam::samples())
    for (const bool is_smooth : {false, true}) {
      SceneSpec<double> spec = rich_bed();
      spec.velocity = model;
      if (is_smooth) {
        spec.initial_breaks = {}, spec.initial_values = {};
        spec.initial_state = SineInitial<double>{0.5, 0.3, 0.7, 0.1};
      }
      const Scene<double> scene(spec);
      const SteadyChute<double> chute(scene);
      // c and a smooth start stand as tables in the bed.
      EXPECT_NEAR(chute.mean_velocity() * chute.bed().mass(), scene.mass(), 2e-5 * scene.mass());
      double by_quadrature = 0, from = 0;
      for (const double to :
           {0.25, 0.3, 0.35, 0.6, 0.75, 1.0}) {  // where c, u or the start has a kink or a jump
        const double last = std::nextafter(to, 0.0);
        by_quadrature += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
            [&](double z) { return model.value(z) * scene.initial_phi(std::min(z, last)); }, from, to, 8,
            1e-11);
        from = to;
      }
      EXPECT_NEAR(scene.mass(), by_quadrature, 1e-10 * scene.mass());
    }
}

TEST(BagnoldVelocity, HasTheNumbersOfTheSource) {
  const BagnoldVelocity<double> u = BagnoldVelocity<double>::samples().front();
  EXPECT_NEAR(u.value(1), 2.0663101551, 1e-10);
  // The slope at the ground is U0 of the source.
  EXPECT_NEAR((u.value(1e-6) - u.value(0)) / 1e-6, 3.0994652327, 1e-5);
  EXPECT_EQ(u.value(0), 0);
}

}  // namespace
}  // namespace shearfront
