// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/mixing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace shearfront {
namespace {

const double kLn2 = std::log(2.0);

Scene<double> bed(DepthFunction<double> solid_fraction) {
  SceneSpec<double> spec;
  spec.fluxes = {Quadratic<double>{}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.solid_fraction = std::move(solid_fraction);
  spec.initial_values = {0.5};
  return Scene<double>(spec);
}
Scene<double> sloping() { return bed(Table<double>{{0, 0.05, 0.95, 1}, {0.7, 0.7, 0.2, 0.2}}); }

/// Profile of x c(z) with the x of each of n cells, whose edges include the knots 0.05 and 0.95.
Profile<double> profile_of(const Scene<double>& scene, double (*share)(double)) {
  std::vector<double> z, below, above;
  constexpr int n = 20;
  for (int i = 0; i <= n; ++i) z.push_back(i / double(n));
  for (int i = 0; i < n; ++i) {
    const double x = share((z[std::size_t(i)] + z[std::size_t(i) + 1]) / 2);
    below.push_back(x * scene.solid_fraction_at(z[std::size_t(i)]));
    above.push_back(x * scene.solid_fraction_at(z[std::size_t(i) + 1]));
  }
  return {z, below, above};
}

TEST(Mixing, UniformMixtureIsLn2TimesTheSolid) {
  const Scene<double> scene = sloping();
  const Mixing found = mixing(scene, profile_of(scene, [](double) { return 0.5; }));
  EXPECT_NEAR(found.entropy, kLn2 * 0.45, 1e-15);  // 0.3119, as the source has it
  EXPECT_NEAR(found.mixed, kLn2 * 0.45, 1e-15);
  EXPECT_NEAR(found.parameter, 1, 1e-14);
  EXPECT_LE(found.parameter, 1);
  const Scene<double> constant = bed(Piecewise<double>{{}, {0.64}});
  EXPECT_NEAR(mixing(constant, Profile<double>({0, 1}, {0.32}, {0.32})).entropy, 0.4436, 5e-5);
}

TEST(Mixing, SegregatedIsZero) {
  const Scene<double> scene = sloping();
  const Mixing found = mixing(scene, profile_of(scene, [](double z) { return z < 0.4 ? 1.0 : 0.0; }));
  EXPECT_NEAR(found.entropy, 0, 1e-14);  // phi / c is 1 to rounding inside a cell
  EXPECT_NEAR(found.parameter, 0, 1e-13);
  EXPECT_GT(found.mixed, 0.3);
}

TEST(Mixing, OneKindOfGrainsIsNotAMixture) {
  const Scene<double> scene = sloping();
  for (const auto share : {+[](double) { return 0.0; }, +[](double) { return 1.0; }}) {
    const Mixing found = mixing(scene, profile_of(scene, share));
    EXPECT_NEAR(found.entropy, 0, 1e-14);
    EXPECT_NEAR(found.mixed, 0, 1e-14);
    EXPECT_LE(found.parameter, 1);
  }
}

TEST(Mixing, EachCellCountsWithItsSolid) {
  const Scene<double> scene = bed(Piecewise<double>{{0.56}, {0.68, 0.3}});
  const Profile<double> profile({0, 0.56, 1}, {0.17, 0.3}, {0.17, 0.3});  // x = 1/4, 1
  const double quarter = 2 * kLn2 - 0.75 * std::log(3.0);
  EXPECT_NEAR(mixing(scene, profile).entropy, quarter * 0.68 * 0.56, 1e-15);
  const double solid = 0.68 * 0.56 + 0.3 * 0.44, x = (0.17 * 0.56 + 0.3 * 0.44) / solid;
  EXPECT_NEAR(mixing(scene, profile).mixed, -(x * std::log(x) + (1 - x) * std::log(1 - x)) * solid, 1e-15);
}

// A cell that reaches over a jump of c is cut there.
TEST(Mixing, JumpsOfPackingInsideCells) {
  const Scene<double> scene = bed(Piecewise<double>{{0.25}, {0.8, 0.4}});
  const Profile<double> profile({0, 1}, {0.2}, {0.2});  // x = 1/4, 1/2
  const double quarter = 2 * kLn2 - 0.75 * std::log(3.0);
  EXPECT_NEAR(mixing(scene, profile).entropy, quarter * 0.8 * 0.25 + kLn2 * 0.4 * 0.75, 1e-15);
}

// int_0^1 e(x) dx = 1/2, approached by ever finer linear cells.
TEST(Mixing, LinearShareByQuadrature) {
  const Scene<double> scene = bed(Piecewise<double>{{}, {1}});
  EXPECT_NEAR(mixing(scene, Profile<double>({0, 1}, {0}, {1})).entropy, 0.5, 2e-3);
  std::vector<double> z;
  for (int i = 0; i <= 100; ++i) z.push_back(i / 100.0);
  const std::vector<double> below(z.begin(), z.end() - 1), above(z.begin() + 1, z.end());
  EXPECT_NEAR(mixing(scene, Profile<double>(z, below, above)).entropy, 0.5, 2e-7);
}

}  // namespace
}  // namespace shearfront
