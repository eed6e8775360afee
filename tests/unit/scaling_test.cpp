// SPDX-License-Identifier: BSD-3-Clause
// A law of segregation applied to a shear rate, and diffusion proportional to the shear rate itself.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "shearfront/scene/scene.hpp"

namespace shearfront {
namespace {

Scaling<Exponential<double>> beads() {
  Scaling<Exponential<double>> a;
  a.shear = {2, 0.02};
  a.small_diameter = 0.003;
  a.size_ratio = 2;
  a.pressure = 1200;
  a.lid = 0.06;
  return a;
}

/// Trewhela, Ancey & Gray (2021): B rho g S d^2 F / (C rho g d + p), by the numbers.
TEST(Scaling, IsThePublishedLaw) {
  const auto a = beads();
  for (const double z : {0.0, 0.03, 0.06}) {
    const double d = 0.0045, weight = 2500 * 9.81, p = 1200 + 0.6 * weight * (0.06 - z);
    const double F = 1 + 2.0957 * 0.5;
    const double rate = 0.3744 * weight * 2 * std::exp(-z / 0.02) * d * d * F / (0.2712 * weight * d + p);
    EXPECT_NEAR(a.value(z), rate, 1e-13 * rate) << z;
  }
}

/// The slope of velocities, constant between the points; its mean is that of a linear resistance.
TEST(Scaling, TakesVelocities) {
  Scaling<VelocityPoints<double>> a;
  a.shear = {{0, 0.5, 1}, {1, 0.5, 2.5}};
  a.small_diameter = 0.1;
  a.size_ratio = 1.5;
  EXPECT_EQ(a.shear_rate(0.2), 1);
  EXPECT_EQ(a.shear_rate(0.7), 4);
  EXPECT_TRUE(may_jump_at(a, 0.5));
  const auto ends = end_values(a, 0.0, 0.5);
  EXPECT_NEAR(a.harmonic_mean(0.0, 0.5), 2 / (1 / ends.low + 1 / ends.high), 1e-14);
}

/// Where pressure is nothing or all, the two limits of the law.
TEST(Scaling, ForgetsThePressureOrTheGrains) {
  auto a = beads();
  a.pressure = 1e12;
  const double heavy = a.value(0.03);
  a.pressure = 2e12;
  EXPECT_NEAR(heavy / a.value(0.03), 2, 1e-6);
  a = beads();
  a.pressure = 0;
  a.lid = 0.06;
  EXPECT_NEAR(a.value(0.06), 2 * std::exp(-3.0) * 0.3744 * 0.0045 * (1 + 2.0957 / 2) / 0.2712, 1e-12);
}

TEST(Scaling, DiffusionFollowsTheShearRateItself) {
  SceneSpec<double> spec;
  spec.shear_rate = beads();
  spec.top = 0.06;
  spec.initial_values = {0.5};
  spec.diffusion = Diffusion<double>{2e-6, {}, true};
  const Scene<double> scene(spec);
  for (const double z : {0.0, 0.05})
    EXPECT_NEAR(scene.diffusivity_at(z), 2e-6 * 2 * std::exp(-z / 0.02), 1e-18);
}

/// Of kinetic cells the shear rate is w / p, and pressure the cell's own.
TEST(Scaling, KnowsThePressureOfAKineticCell) {
  Scaling<KineticShear<double>> a;
  a.shear.amplitude = 3;
  a.shear.length = 0.1;
  a.shear.load = 0.5;
  a.shear.lid = 1;
  a.small_diameter = 0.1;
  a.size_ratio = 2;
  const KineticProfile<double> profile({0.1, 0.5, 0, 1});
  for (const double z : {0.2, 0.9}) {
    const double shear = 3 * profile.value(z) * 0.5 / (1.5 - z);
    EXPECT_NEAR(a.shear_rate(z), shear, 1e-14 * shear);
    const double rate = 0.3744 * shear * 0.15 * 0.15 * (1 + 2.0957 / 2) / (0.2712 * 0.15 + 0.6 * (1.5 - z));
    EXPECT_NEAR(a.value(z), rate, 1e-13 * rate);
  }
}

/// Walls and surfaces that are not given are the ends of the domain.
TEST(Rheology, TakesTheEndsOfTheDomain) {
  SceneSpec<double> spec;
  spec.top = 0.025;
  spec.initial_values = {0.5};
  Kinetic<double> a;
  a.length = 0.003;
  a.load = 0.02;
  spec.shear_rate = a;
  EXPECT_EQ(Scene<double>(spec).shear_rate_at(0.01),
            KineticProfile<double>({0.003, 0.02, 0, 0.025}).value(0.01));
  Bagnold<double> b;
  b.angle = 0.43;
  b.grain = 0.001;
  spec.shear_rate = b;
  EXPECT_EQ(Scene<double>(spec).shear_rate_at(0.025), 0);
  EXPECT_GT(Scene<double>(spec).shear_rate_at(0.0249), 0);
}

TEST(Rheology, SaysWhatIsWrong) {
  SceneSpec<double> spec;
  spec.initial_values = {0.5};
  const auto first = [&](DepthFunction<double> a) {
    spec.shear_rate = std::move(a);
    const auto complaints = find_complaints(spec);
    return complaints.empty() ? std::string() : complaints[0].text();
  };
  Kinetic<double> a;
  a.load = 0;
  EXPECT_EQ(first(a), "shear_rate.load = 0; must be > 0");
  a.load = 1;
  a.lid = 0.5;
  EXPECT_EQ(first(a), "shear_rate.lid = 0.5; must not lie below the top of the domain (1)");
  a.lid = 0;
  a.length = 1e-5;
  EXPECT_EQ(first(a), "shear_rate.length = 1e-05; must not be so small that a(z) vanishes at the ground");
  auto s = beads();
  s.lid = 1;
  s.size_ratio = 0.5;
  EXPECT_EQ(
      first(s),
      "shear_rate.size_ratio = 0.5; must be > 1: diameter of the large grains over that of the small ones");
}

}  // namespace
}  // namespace shearfront
