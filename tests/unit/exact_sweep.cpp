// SPDX-License-Identifier: BSD-3-Clause
// Many heights at one time are what each of them is alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"
#include "support/table_scenes.hpp"

namespace shearfront {
namespace {

/// Beds in which paths go straight, turn, rest and come from constant states: humps, throats, flats, jumps, pieces of any thickness.
SceneSpec<double> bed_for_a_sweep(support::SceneMaker& make) {
  const double spread = make.uniform(0, 6);
  const auto rate = [&] { return std::exp(-spread * make.uniform(0, 1)); };
  const auto heights = [&](int most) {
    std::vector<double> z(static_cast<std::size_t>(make.integer(0, most)));
    for (double& height : z) height = make.uniform(0.001, 0.999);
    std::sort(z.begin(), z.end());
    return z;
  };
  SceneSpec<double> spec;
  spec.shear_rate = support::table_with_knots(make, heights(18), rate);
  if (make.integer(0, 4) == 0) {
    spec.initial_state = support::random_start(make, 0, 1);
    return spec;
  }
  spec.initial_breaks = heights(4);
  for (std::size_t i = 0; i <= spec.initial_breaks.size(); ++i)
    spec.initial_values.push_back(make.integer(0, 2) == 0 ? make.integer(0, 1) : make.uniform(0, 1));
  return spec;
}

void expect_same_alone(const ExactSolution<double>& exact, const std::vector<double>& z, double t) {
  const auto all = exact.at(z, t);
  ASSERT_EQ(all.size(), z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const auto one = exact.at(z[i], t);
    SCOPED_TRACE("t " + std::to_string(t) + " z " + std::to_string(z[i]));
    EXPECT_NEAR(all[i].M, one.M, 2e-15);
    EXPECT_NEAR(all[i].phi, one.phi, 1e-9);
    EXPECT_NEAR(all[i].H, one.H, 1e-9);
  }
}

TEST(ExactSweep, IsWhatEachHeightIsAlone) {
  const std::uint64_t seed = support::seed_of(91);
  support::SceneMaker make(seed);
  for (int n = 0; n < 400; ++n) {
    SCOPED_TRACE("seed " + std::to_string(seed) + " scene " + std::to_string(n));
    const SceneSpec<double> spec = bed_for_a_sweep(make);
    const ExactSolution<double> exact{Scene<double>(spec), {64}};
    std::vector<double> z(static_cast<std::size_t>(make.integer(1, spec.initial_state ? 40 : 400)));
    for (double& height : z) height = make.integer(0, 20) == 0 ? make.integer(0, 1) : make.uniform(0, 1);
    std::sort(z.begin(), z.end());
    expect_same_alone(exact, z, std::exp(make.uniform(-4, 4)));
  }
}

/// Paths that turn lie between straight ones of the same fan: M was 0.05 too large.
TEST(ExactSweep, FindsWhatLiesBetweenTwoOfOneFan) {
  SceneSpec<double> spec;
  spec.shear_rate =
      Table<double>{{0, 0.07794, 0.09151, 0.2256, 1}, {0.0547, 0.0507, 0.8994, 0.8994, 0.08301}};
  spec.initial_breaks = {0.5748};
  spec.initial_values = {0, 1};
  const ExactSolution<double> exact{Scene<double>(spec)};
  for (int n = 2; n <= 40; ++n) {
    std::vector<double> z;
    for (int i = 0; i <= n; ++i) z.push_back(i / double(n));
    expect_same_alone(exact, z, 1.4655709208025791);
  }
}

/// A fit asks for places in its own order, and for derivatives.
TEST(ExactSweep, LinearisationsKeepTheOrderOfPlaces) {
  const std::uint64_t seed = support::seed_of(92);
  support::SceneMaker make(seed);
  for (int n = 0; n < 10; ++n) {
    const Scene<double> scene(bed_for_a_sweep(make));
    if (scene.has_smooth_start()) continue;  // many parts
    const auto all = entries(scene.spec());
    std::vector<std::size_t> wanted;
    for (std::size_t e = 0; e < all.size(); ++e)
      if (ExactSolver::derivative_refusal(scene, {}, all[e]).empty()) wanted.push_back(e);
    std::vector<Place> places;
    for (int i = 0; i < 150; ++i) places.push_back({0.25 * make.integer(0, 5), make.uniform(0, 1)});
    std::any memory;
    const auto many = ExactSolver::linearise(scene, {}, places, wanted, memory);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto one = ExactSolver::linearise(scene, {}, {places[i]}, wanted, memory);
      SCOPED_TRACE("seed " + std::to_string(seed) + " scene " + std::to_string(n) + " place " +
                   std::to_string(i));
      EXPECT_NEAR(many.samples[i].M, one.samples[0].M, 1e-15);
      for (std::size_t k = 0; k < wanted.size(); ++k) {
        const Sample &a = many.derivatives[i * wanted.size() + k], &b = one.derivatives[k];
        EXPECT_NEAR(a.M, b.M, 1e-9 * (1 + std::abs(b.M)));
        EXPECT_NEAR(a.phi, b.phi, 1e-6 * (1 + std::abs(b.phi)));
      }
    }
  }
}

}  // namespace
}  // namespace shearfront
