// SPDX-License-Identifier: BSD-3-Clause
// Parabolas (lwr) are affine images of the quadratic flux: so are their exact solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/flux_scenes.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::FluxShape;
using support::SceneMaker;

/// Calls check(z, t) at random points inside the bed of random quadratic scenes.
template <class MakeImage, class Check>
void on_random_scenes(MakeImage&& make_image, Check&& check) {
  SceneMaker make(support::seed_of(5101));
  for (int n = 0; n < 60; ++n) {
    const SceneSpec<double> spec = make.data(make.integer(1, 5), make.order(), 6);
    const ExactSolution<double> plain{Scene<double>(spec)};
    const ExactSolution<double> image{Scene<double>(make_image(spec))};
    for (int i = 0; i < 40; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 3));
      SCOPED_TRACE("scene " + std::to_string(n) + ", z " + std::to_string(z) + ", t " + std::to_string(t));
      check(plain.at(z, t), image.at(z, t), z);
    }
  }
}

/// A jump of phi may lie within rounding of a point: there phi is not compared.
void expect_close(double phi, double expected, double size, double M, double expected_M) {
  EXPECT_NEAR(M, expected_M, 4e-15 * size);
  if (std::abs(phi - expected) > 1e-3 * size) ADD_FAILURE() << "phi " << phi << " against " << expected;
  EXPECT_NEAR(phi, expected, 1e-12 * size);
}

TEST(ExactParabolas, TrafficIsTheMirroredQuadraticFlux) {
  constexpr double kJam = 0.125;  // a power of two: the images of the data are exact
  on_random_scenes(
      [&](SceneSpec<double> spec) {
        spec.fluxes = {Lwr<double>{kJam}};
        for (double& phi : spec.initial_values) phi = kJam * (1 - phi);
        return spec;
      },
      [&](const auto& plain, const auto& image, double z) {
        expect_close(image.phi, kJam * (1 - plain.phi), kJam, image.M, kJam * (z - plain.M));
        EXPECT_NEAR(image.H, -kJam * plain.H, 1e-13);
      });
}

TEST(ExactParabolas, LargeGrainsMirrorSmallOnes) {
  on_random_scenes(
      [&](SceneSpec<double> spec) {
        spec.fluxes = {Lwr<double>{}};
        for (double& phi : spec.initial_values) phi = 1 - phi;
        return spec;
      },
      [&](const auto& plain, const auto& image, double z) {
        expect_close(image.phi, 1 - plain.phi, 1, image.M, z - plain.M);
      });
}

TEST(ExactParabolas, ConstantPackingAndTemperatureOnlyScale) {
  on_random_scenes(
      [&](SceneSpec<double> spec) {
        spec.fluxes = {Quadratic<double>{}};
        spec.solid_fraction = Piecewise<double>{{}, {0.5}};
        spec.temperature = Piecewise<double>{{}, {4.0}};
        spec.scale /= 2;
        return spec;
      },
      [&](const auto& plain, const auto& image, double) {
        expect_close(image.phi, 0.5 * plain.phi, 1, image.M, 0.5 * plain.M);
      });
}

TEST(ExactParabolas, SmoothRateKeepsItsClosedForm) {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{0.87 / 0.205, 0.205};
  spec.scale = 13.60;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const ExactSolution<double> plain{Scene<double>(spec)};
  const auto times = exact_timeline(Scene<double>(spec));
  spec.fluxes = {Lwr<double>{0.25}};
  spec.initial_values = {0.25, 0};
  const ExactSolution<double> image{Scene<double>(spec)};
  EXPECT_TRUE(image.is_exact());
  for (const double t : {0.01, 0.2, 0.6, 1.0})
    for (const double z : {0.03, 0.3, 0.55, 0.9})
      EXPECT_NEAR(image.phi(z, t), 0.25 * (1 - plain.phi(z, t)), 1e-13);
  const auto image_times = exact_timeline(Scene<double>(spec));
  EXPECT_NEAR(*image_times.t_star, *times.t_star, 1e-13);
  EXPECT_NEAR(*image_times.t0, *times.t0, 1e-13);
  EXPECT_NEAR(image_times.steady_height, 0.5, 1e-15);
}

TEST(ExactParabolas, EventsAreThoseOfTheQuadraticFlux) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const auto plain = exact_timeline(Scene<double>(spec));
  spec.fluxes = {Lwr<double>{}};
  spec.initial_values = {1, 0};
  const auto image = exact_timeline(Scene<double>(spec));
  EXPECT_DOUBLE_EQ(*image.t0, *plain.t0);
  EXPECT_DOUBLE_EQ(*image.t1, *plain.t1);
  EXPECT_DOUBLE_EQ(*image.t_star, *plain.t_star);
  ASSERT_EQ(image.interfaces.size(), 1u);
  EXPECT_EQ(image.interfaces[0].z, 0.29);
  EXPECT_DOUBLE_EQ(*image.interfaces[0].first, *plain.interfaces[0].first);
  EXPECT_DOUBLE_EQ(*image.interfaces[0].last, *plain.interfaces[0].last);
}

/// A linear solid fraction as many steps: the pieces the engine makes itself, and its estimate of the error.
TEST(ExactParabolas, SmoothPackingConvergesWithTheLayers) {
  SceneSpec<double> spec;
  spec.fluxes = {Quadratic<double>{}};
  spec.solid_fraction = Table<double>{{0, 1}, {0.95, 0.05}};
  spec.temperature = Table<double>{{0, 1}, {0.5, 2}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  const ExactSolution<double> fine(scene, {3000});
  double before = 0;
  for (const std::size_t n : {64U, 256U, 1024U}) {
    const ExactSolution<double> coarse(scene, {n});
    double worst = 0, estimate = 0;
    for (const double t : {0.1, 0.3, 0.8, 2.0})
      for (int i = 1; i < 40; ++i) {
        const auto value = coarse.at(i / 40.0, t);
        worst = std::max(worst, std::abs(value.M - fine.M(i / 40.0, t)));
        estimate = std::max(estimate, value.M_error);
        EXPECT_GE(value.phi, 0);
        EXPECT_LE(value.phi, scene.solid_fraction_at(i / 40.0));
      }
    EXPECT_LE(worst, estimate) << n;
    if (before > 0) {
      EXPECT_LT(worst, before / 4) << n;
    }
    before = worst;
  }
  EXPECT_EQ(fine.at(1, 0.3).M, scene.mass());
}

TEST(ExactParabolas, RefusesInOneSentence) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.5};
  const auto text = [&] { return exact::refusal(Scene<double>(spec)); };
  EXPECT_EQ(text(), "");
  spec.fluxes = {Cubic<double>{0.9}};
  EXPECT_EQ(text(), "cubic with gamma = 0.9 is neither convex nor concave");
  spec.fluxes = {Cubic<double>{0.5}};
  EXPECT_EQ(text(), "");
  spec.fluxes = {RichardsonZaki<double>{4.7}};
  EXPECT_NE(text().find("richardson-zaki with exponent = 4.7 is neither"), std::string::npos);
  spec.fluxes = {Quadratic<double>{}};
  spec.is_periodic = true;
  EXPECT_NE(text().find("periodic"), std::string::npos);
  spec.fluxes = {Burgers<double>{}};
  EXPECT_NE(text().find("burgers with lowest = -1, highest = 1 does not vanish"), std::string::npos);
}

}  // namespace
}  // namespace shearfront
