// SPDX-License-Identifier: BSD-3-Clause
// Smooth and tabulated starts, solved exactly, against the same beds with the start as cells: M of the two cannot differ by
// more than M of the starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

struct WorstGap {
  double over = 0;  ///< |M difference| less the bound
  double phi = 0;   ///< mean |phi difference| over all places
  int n_places = 0;
};

/// At random places and times; phi may differ much where shocks are a little elsewhere.
WorstGap compare_with_cells(const SceneSpec<double>& spec, int n_cells, support::SceneMaker& make) {
  const support::CellStart cells = support::as_cells(spec, n_cells);
  const ExactSolution<double> smooth{Scene<double>(spec)}, steps{Scene<double>(cells.spec)};
  WorstGap worst;
  worst.over = -1;
  const double crossing = smooth.medium().pure_travel_time(smooth.medium().bottom(), smooth.medium().top());
  for (int n = 0; n < 40; ++n) {
    const double t = crossing * std::exp(make.uniform(-6, 1)), z = make.uniform(spec.bottom, spec.top);
    const auto a = smooth.at(z, t), b = steps.at(z, t);
    worst.over = std::max(worst.over, std::abs(a.M - b.M) - cells.M_bound - a.M_error - b.M_error);
    worst.phi += std::abs(a.phi - b.phi);
    ++worst.n_places;
  }
  worst.phi /= worst.n_places;
  return worst;
}

constexpr double kRoundingOfM = 1e-13;

TEST(SmoothStartExact, InLayersOfParabolas) {
  int n = 0;
  double phi = 0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    support::SceneMaker make(support::seed_of(71000 + number));
    SceneSpec<double> spec;
    spec.shear_rate = make.layers(make.integer(1, 5), make.order());
    spec.initial_state = support::random_start(make);
    const WorstGap worst = compare_with_cells(spec, 400, make);
    EXPECT_LE(worst.over, kRoundingOfM) << "seed " << 71000 + number;
    phi += worst.phi;
    n += worst.n_places;
  }
  EXPECT_EQ(n, 2400);
  EXPECT_LT(phi / 60, 3e-3);
}

TEST(SmoothStartExact, WithOtherFluxes) {
  int n = 0;
  double phi = 0;
  const std::vector<Flux<double>> fluxes{Cubic<double>{0.4}, Lwr<double>{}, Triangular<double>{}};
  for (std::uint64_t number = 0; number < 30; ++number) {
    support::SceneMaker make(support::seed_of(72000 + number));
    SceneSpec<double> spec;
    spec.fluxes = {fluxes[number % fluxes.size()]};
    if (number % 2 == 0) spec.solid_fraction = Piecewise<double>{{0.4}, {0.5, 0.7}};
    spec.shear_rate = make.layers(make.integer(1, 4), make.order());
    const auto range = spec.fluxes[0].range();
    spec.initial_state = support::random_start(make, range.lowest, range.highest);
    const Scene<double> scene(spec);
    if (!exact::refusal(scene).empty()) continue;
    const WorstGap worst = compare_with_cells(spec, 200, make);
    EXPECT_LE(worst.over, kRoundingOfM * (range.highest - range.lowest))
        << "seed " << 72000 + number << ' ' << spec.fluxes[0].name();
    phi += worst.phi / (range.highest - range.lowest);
    n += worst.n_places;
  }
  EXPECT_GT(n, 400);
  EXPECT_LT(phi / 30, 6e-3);
}

TEST(SmoothStartExact, InSlopedPieces) {
  int n = 0;
  double phi = 0;
  for (std::uint64_t number = 0; number < 30; ++number) {
    support::SceneMaker make(support::seed_of(73000 + number));
    SceneSpec<double> spec;
    if (number % 3 == 0) {
      spec.shear_rate = Exponential<double>{1, make.uniform(0.2, 3)};
    } else {
      Table<double> table{{0}, {std::exp(make.uniform(-1, 1))}};
      for (const double z : make.heights(make.integer(0, 3), 0, 1)) {
        table.z.push_back(z);
        table.values.push_back(make.integer(0, 4) == 0 ? table.values.back() : std::exp(make.uniform(-1, 1)));
      }
      table.z.push_back(1);
      table.values.push_back(std::exp(make.uniform(-1, 1)));
      spec.shear_rate = table;
    }
    spec.initial_state = support::random_start(make);
    const WorstGap worst = compare_with_cells(spec, 100, make);
    EXPECT_LE(worst.over, kRoundingOfM) << "seed " << 73000 + number;
    phi += worst.phi;
    n += worst.n_places;
  }
  EXPECT_EQ(n, 1200);
  EXPECT_LT(phi / 30, 1e-2);
}

/// There a staircase of layers stands for the bed, while pieces solve the start as cells exactly: M differs by no more than both starts
/// do and the staircase says. Its estimates are those of a set of places.
TEST(SmoothStartExact, WithOtherFluxesInSlopedPieces) {
  int n = 0;
  const std::vector<Flux<double>> fluxes{Cubic<double>{0.4}, Triangular<double>{}, Cubic<double>{0.2}};
  for (std::uint64_t number = 0; number < 9; ++number) {
    support::SceneMaker make(support::seed_of(74500 + number));
    SceneSpec<double> spec;
    spec.fluxes = {fluxes[number % fluxes.size()]};
    if (number % 2 == 0)
      spec.shear_rate = Exponential<double>{1, make.uniform(0.3, 3)};
    else
      spec.shear_rate = Table<double>{
          {0, make.uniform(0.2, 0.8), 1},
          {std::exp(make.uniform(-1, 1)), std::exp(make.uniform(-1, 1)), std::exp(make.uniform(-1, 1))}};
    const auto range = spec.fluxes[0].range();
    spec.initial_state = support::random_start(make, range.lowest, range.highest);
    ASSERT_EQ(exact::refusal(Scene<double>(spec)), "");
    const support::CellStart cells = support::as_cells(spec, 40);
    const ExactSolution<double> smooth{Scene<double>(spec)}, steps{Scene<double>(cells.spec)};
    EXPECT_FALSE(smooth.is_exact());
    EXPECT_TRUE(steps.is_exact());
    const double crossing = steps.medium().pure_travel_time(steps.medium().bottom(), steps.medium().top());
    double gap = 0, error = 0;
    for (int k = 0; k < 25; ++k, ++n) {
      const double t = crossing * std::exp(make.uniform(-4, 1)), z = make.uniform(spec.bottom, spec.top);
      const auto a = smooth.at(z, t);
      gap = std::max(gap, std::abs(a.M - steps.M(z, t)));
      error = std::max(error, a.M_error);
    }
    EXPECT_LE(gap, cells.M_bound + error) << "seed " << 74500 + number << ' ' << spec.fluxes[0].name();
    EXPECT_GT(error, 0);
    EXPECT_LT(error, 1e-2) << "seed " << 74500 + number;
  }
  EXPECT_EQ(n, 225);
}

}  // namespace
}  // namespace shearfront
