// SPDX-License-Identifier: BSD-3-Clause
// Derivatives that fronts carry against those of the exact engine, which share nothing but the scene: they tend to them as the
// polygon does to its flux.
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/exact/solver.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/track/solver.hpp"
#include "support/random_scene.hpp"
#include "support/random_tracked.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// Mean distance of dM in random layered beds, beside the mean of |dM|; counts what it compares.
double mean_distance(double resolution, int& compared) {
  double sum = 0, size = 0;
  for (std::uint64_t n = 0; n < 40; ++n) {
    SceneMaker make(support::seed_of(8700 + n));
    const int n_layers = make.integer(1, 3);
    const Scene<double> scene(make.data(n_layers, make.order(), 3));
    const TrackOptions options{.resolution = resolution};
    const std::vector<Entry> all = entries(scene.spec());
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (FrontTrackingSolver::derivative_refusal(scene, options, all[i]).empty() &&
          ExactSolver::derivative_refusal(scene, {}, all[i]).empty())
        wanted.push_back(i);
    std::any memory, other_memory;
    const std::vector<Place> places = support::random_places(make, scene, 5);
    const Linearisation tracked = FrontTrackingSolver::linearise(scene, options, places, wanted, memory);
    const Linearisation exact = ExactSolver::linearise(scene, {}, places, wanted, other_memory);
    for (std::size_t i = 0; i < exact.derivatives.size(); ++i) {
      sum += std::abs(tracked.derivatives[i].M - exact.derivatives[i].M);
      size += std::abs(exact.derivatives[i].M);
      ++compared;
    }
  }
  return sum / size;
}

TEST(TrackingDerivativesBesideExact, TendToThoseOfTheExactSolution) {
  int compared = 0;
  const double coarse = mean_distance(0.04, compared), fine = mean_distance(0.0025, compared);
  EXPECT_LT(coarse, 0.004);
  // First order at least where places lie inside fans, and second elsewhere: a factor of 16 of the resolution.
  EXPECT_LT(fine, coarse / 8);
  EXPECT_GT(compared, 1000);
  RecordProperty("coarse", std::to_string(coarse));
  RecordProperty("fine", std::to_string(fine));
}

/// A fit may start from equal numbers: layers and states that are one in the grid are moved apart by so little that derivatives are
/// those to one side.
TEST(TrackingDerivativesBesideExact, OfEqualNumbersAreThoseOfNumbersNearby) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.3, 0.7}, {1, 1, 1}};
  spec.initial_breaks = {0.2, 0.45, 0.8};
  spec.initial_values = {0.4, 0.4, 0.4, 0.8};
  std::vector<std::size_t> wanted;
  const std::vector<Entry> all = entries(spec);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].field == "initial.values" || all[i].field == "shear_rate.values") wanted.push_back(i);
  const std::vector<Place> places{{0.3, 0.4}, {0.6, 0.55}, {0.9, 0.25}};
  const TrackOptions options{.resolution = 0.001};
  std::any memory;
  const Linearisation equal =
      FrontTrackingSolver::linearise(Scene<double>(spec), options, places, wanted, memory);
  EXPECT_NE(equal.summary.remark, "");
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    // One-sided differences of the run itself, to the side of the larger numbers and of the smaller ones.
    double M[3][2];
    const double h = 1e-4;
    for (const int side : {-1, 0, 1}) {
      SceneSpec<double> moved = spec;
      *entry_places(moved)[wanted[k]] += side * h;
      const Linearisation run =
          FrontTrackingSolver::linearise(Scene<double>(moved), options, places, {}, memory);
      for (const std::size_t i : {0u, 1u}) M[side + 1][i] = run.samples[i].M;
    }
    for (const std::size_t i : {0u, 1u}) {
      const double up = (M[2][i] - M[1][i]) / h, down = (M[1][i] - M[0][i]) / h;
      const double by = equal.derivatives[i * wanted.size() + k].M;
      EXPECT_LT(std::min(std::abs(by - up), std::abs(by - down)), 0.01)
          << all[wanted[k]].name() << " place " << i;
    }
  }
}

}  // namespace
}  // namespace shearfront
