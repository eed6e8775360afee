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

namespace shearfront {
namespace {

/// Beds in which paths go straight, turn, rest and come from constant states: humps, throats, flats, jumps.
SceneSpec<double> bed_for_a_sweep(support::SceneMaker& make) {
  SceneSpec<double> spec;
  Table<double> table{{0}, {std::exp(make.uniform(-1, 1))}};
  const int n = make.integer(1, 9);
  const bool is_falling = make.integer(0, 1) == 0;
  for (int k = 1; k <= n; ++k) {
    const double last = table.values.back();
    table.z.push_back(double(k) / n);
    table.values.push_back(is_falling                ? last * std::exp(make.uniform(-0.6, 0))
                           : make.integer(0, 4) == 0 ? last
                                                     : std::exp(make.uniform(-1, 1)));
    if (k == n || make.integer(0, 4) > 0) continue;
    table.z.push_back(double(k) / n);
    table.values.push_back(std::exp(make.uniform(-1, 1)));
  }
  spec.shear_rate = table;
  spec.initial_breaks = {0.3125, 0.59375};
  for (int i = 0; i < 3; ++i)
    spec.initial_values.push_back(make.integer(0, 2) == 0 ? make.integer(0, 1) : make.uniform(0, 1));
  return spec;
}

TEST(ExactSweep, IsWhatEachHeightIsAlone) {
  const std::uint64_t seed = support::seed_of(91);
  support::SceneMaker make(seed);
  for (int n = 0; n < 60; ++n) {
    const ExactSolution<double> exact{Scene<double>(bed_for_a_sweep(make))};
    const double t = std::exp(make.uniform(-3, 2));
    std::vector<double> z;
    const int n_heights = make.integer(1, 400);
    for (int i = 0; i < n_heights; ++i)
      z.push_back(make.integer(0, 20) == 0 ? make.integer(0, 1) : make.uniform(0, 1));
    std::sort(z.begin(), z.end());
    const auto all = exact.at(z, t);
    ASSERT_EQ(all.size(), z.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
      const auto one = exact.at(z[i], t);
      SCOPED_TRACE("seed " + std::to_string(seed) + " scene " + std::to_string(n) + " z " +
                   std::to_string(z[i]));
      EXPECT_NEAR(all[i].M, one.M, 1e-15);
      EXPECT_NEAR(all[i].phi, one.phi, 1e-10);
      EXPECT_NEAR(all[i].H, one.H, 1e-10);
    }
  }
}

/// A fit asks for places in its own order, and for derivatives.
TEST(ExactSweep, LinearisationsKeepTheOrderOfPlaces) {
  const std::uint64_t seed = support::seed_of(92);
  support::SceneMaker make(seed);
  for (int n = 0; n < 10; ++n) {
    const Scene<double> scene(bed_for_a_sweep(make));
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
