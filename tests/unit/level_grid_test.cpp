// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/level_grid.hpp"
#include "shearfront/digits/real110.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/riemann/in_layer.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

LayerStack<double> stack_of(const std::vector<double>& rates, double scale = 1) {
  std::vector<double> z;
  for (std::size_t k = 0; k <= rates.size(); ++k)
    z.push_back(static_cast<double>(k) / static_cast<double>(rates.size()));
  return {z, rates, scale, std::vector<bool>(rates.size() - 1, true)};
}

TEST(LevelGrid, SpacingOfEveryFanInEveryLayerIsWithinTheResolution) {
  for (const double resolution : {1.0, 0.2, 0.1, 0.013, 0.001}) {
    for (const auto& rates :
         {std::vector<double>{2.4, 0.31}, {0.1, 3, 0.7, 0.7, 1e-6}, {1}, {1, 1.0000001, 2}}) {
      const auto grid = LevelGrid<double>::exact_levels(stack_of(rates), resolution, {}).grid;
      for (std::size_t k = 0; k < rates.size(); ++k) {
        EXPECT_EQ(grid.phi(k, 0), 0);
        EXPECT_EQ(grid.phi(k, grid.n_states(k) - 1), 1);
        EXPECT_EQ(grid.phi(k, grid.bottom_state(k)), 0.5);
        solve_in_layer(grid, k, 0, grid.n_states(k) - 1, [&](State a, State b) {
          const double step = grid.phi(k, b) - grid.phi(k, a);
          EXPECT_GT(step, 0);
          EXPECT_LE(step, resolution * (1 + 1e-12));
        });
      }
    }
  }
}

TEST(LevelGrid, OneLayerHasExactlyTheStepsItNeeds) {
  const auto grid = LevelGrid<double>::exact_levels(stack_of({0.7}), 0.1, {}).grid;
  EXPECT_EQ(grid.n_states(0), 11);
  for (State i = 0; i <= 10; ++i) EXPECT_NEAR(grid.phi(0, i), i / 10.0, 1e-16);
}

TEST(LevelGrid, CountIsRightBeforeAnythingIsBuiltAndNeverOverflows) {
  const auto stack = stack_of({2.4, 0.31, 0.31, 1e-3});
  for (const double resolution : {0.5, 0.1, 0.003})
    EXPECT_EQ(LevelGrid<double>::exact_level_count(stack, resolution),
              static_cast<double>(LevelGrid<double>::exact_levels(stack, resolution, {}).grid.n_levels()));
  EXPECT_GT(LevelGrid<double>::exact_level_count(stack, 1e-20), 1e20);
  EXPECT_GT(LevelGrid<double>::exact_level_count(stack, 1e-300), 1e300);
}

TEST(LevelGrid, StatesNextToOneHalfAscend) {
  // Their fluxes differ by less than a unit in the last place: rounding must not decide on their order.
  support::SceneMaker maker(support::seed_of(61));
  for (int number = 0; number < 200; ++number) {
    std::vector<LayerState<double>> wanted{
        {0, 0.49999999999980899}, {0, 0.49999999882971913}, {0, 0.49999999931922701}};
    for (int i = 0; i < 8; ++i)
      wanted.push_back({0, 0.5 + maker.uniform(-1, 1) * std::pow(10.0, maker.uniform(-16, -7))});
    const auto built = LevelGrid<double>::exact_levels(stack_of({maker.uniform(0.1, 9), 4520}), 0.1, wanted);
    for (State i = 1; i < built.grid.n_states(0); ++i)
      ASSERT_GE(built.grid.phi(0, i), built.grid.phi(0, i - 1)) << "scene " << number << ", state " << i;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      EXPECT_EQ(built.grid.phi(0, built.states[i]), wanted[i].phi);
  }
}

TEST(LevelGrid, StatesOnAChordBetweenNearlyEqualCapacitiesKeepTheirPhi) {
  const double a = 1.1165763485076818, b = 1.1165763485076907;
  std::vector<LayerState<double>> wanted{{1, 0.5 - 2e-10}, {1, 0.5 + 1e-10}, {1, 0.5 - 1e-8}};
  for (int i = 1; i <= 100; ++i) wanted.push_back({0, i / 101.0});  // more than the grid has levels
  const auto built = LevelGrid<double>::exact_levels(stack_of({a, b}), 0.5, wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(built.grid.phi(wanted[i].layer, built.states[i]), wanted[i].phi, 1e-16) << i;
}

TEST(LevelGrid, SpeedsOfNearlyParallelFrontsNextToOneHalfDifferByTheirStates) {
  // States of layers of nearly equal capacity: their fluxes are all but the same, their concentrations not.
  support::SceneMaker maker(support::seed_of(62));
  for (int number = 0; number < 200; ++number) {
    const double a = maker.uniform(0.1, 9), b = a * (1 + std::pow(10.0, maker.uniform(-15.5, -9)));
    const auto near_half = [&] { return 0.5 + maker.uniform(-1, 1) * std::pow(10.0, maker.uniform(-9, -5)); };
    const std::vector<LayerState<double>> wanted{
        {0, near_half()}, {0, near_half()}, {1, near_half()}, {1, 0.5}};
    const auto stack = stack_of({a, b});
    const auto built = LevelGrid<double>::exact_levels(stack, 0.1, wanted);
    const LayerStack<Real110> stack50({Real110(0), Real110(0.5), Real110(1)}, {Real110(a), Real110(b)},
                                      Real110(1), {true});
    std::vector<LayerState<Real110>> wanted50;
    for (const auto& w : wanted) wanted50.push_back({w.layer, Real110(w.phi)});
    const auto built50 = LevelGrid<Real110>::exact_levels(stack50, Real110(0.1), wanted50);
    for (std::size_t layer = 0; layer < 2; ++layer) {
      const State middle = built.grid.bottom_state(layer) / 2;
      for (std::size_t i = 0; i < wanted.size(); ++i)
        for (std::size_t j = 0; j < wanted.size(); ++j) {
          const State l = built.states[i], r = built.states[j];
          const State top = built.grid.n_states(layer) - 1;
          if (l > top || r > top || l == r) continue;
          const auto& grid50 = built50.grid;
          const double expected =
              to_double(Real110(grid50.rate(layer) * (grid50.phi(layer, built50.states[i]) -
                                                      grid50.phi(layer, built50.states[j]))));
          const double rounded = built.grid.speed(layer, l, middle) - built.grid.speed(layer, middle, r);
          const double drop = built.grid.speed_drop(layer, l, middle, r, rounded);
          EXPECT_NEAR(drop, expected, 1e-13 * std::abs(expected) + 1e-22)
              << "scene " << number << ", layer " << layer << ", states " << i << " " << j;
        }
    }
  }
}

TEST(LevelGrid, WantedStatesAreExactToTheBit) {
  const std::vector<LayerState<double>> wanted{{0, 0.3},       {1, 0.7}, {1, 1e-9}, {0, 0.5 + 1e-12},
                                               {1, 1 - 1e-10}, {0, 0.5}, {1, 0},    {0, 1}};
  const auto built = LevelGrid<double>::exact_levels(stack_of({2.4, 0.31}), 0.1, wanted);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_EQ(built.grid.phi(wanted[i].layer, built.states[i]), wanted[i].phi) << i;
}

TEST(LevelGrid, StatesOfOneLevelHaveOneFlux) {
  const std::vector<double> rates{2.4, 0.31, 1.1};
  const auto grid = LevelGrid<double>::exact_levels(stack_of(rates), 0.03, {{0, 0.3}, {2, 0.9}}).grid;
  for (std::size_t k = 0; k < rates.size(); ++k)
    for (State i = 0; i < grid.n_states(k); ++i) {
      const double phi = grid.phi(k, i);
      EXPECT_NEAR(grid.flux(k, i), rates[k] * phi * (phi - 1), 4e-16 * rates[k]);
      EXPECT_EQ(grid.flux(k, i), grid.flux(k, grid.n_states(k) - 1 - i));
    }
}

TEST(LevelGrid, SpeedsAreRankineHugoniot) {
  const std::vector<double> rates{2.4, 0.31};
  const auto grid =
      LevelGrid<double>::exact_levels(stack_of(rates), 0.05, {{0, 1e-12}, {1, 0.5 - 1e-13}}).grid;
  for (std::size_t k = 0; k < rates.size(); ++k)
    for (State l = 0; l < grid.n_states(k); ++l)
      for (State r = 0; r < grid.n_states(k); ++r) {
        const double p = grid.phi(k, l), q = grid.phi(k, r);
        EXPECT_NEAR(grid.speed(k, l, r), rates[k] * (p + (q - 1)), 4e-16 * rates[k]);
      }
  // Conjugate states stand still exactly, and shocks between nearly pure states keep their relative
  // precision.
  const State last = grid.n_states(0) - 1;
  EXPECT_EQ(grid.speed(0, last - 3, 3), 0);
  State trace = 0;
  while (grid.phi(0, trace) != 1e-12) ++trace;
  EXPECT_NEAR(grid.speed(0, last, trace) / (2.4 * 1e-12), 1, 1e-15);
}

TEST(LevelGrid, ManyStatesLieOnChordsWithTheirPhiAndCommonSpeeds) {
  support::SceneMaker maker(support::seed_of(3));
  std::vector<LayerState<double>> wanted;
  for (int i = 0; i < 3000; ++i) wanted.push_back({static_cast<std::size_t>(i % 2), maker.uniform(0, 1)});
  const std::vector<double> rates{2.4, 0.31};
  const double resolution = 0.1;
  const auto built = LevelGrid<double>::exact_levels(stack_of(rates), resolution, wanted);
  const auto& grid = built.grid;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double phi = wanted[i].phi;
    EXPECT_NEAR(grid.phi(wanted[i].layer, built.states[i]), phi, 2e-16);
    // The chord lies above the flux by at most a d^2 / 4 for a step d.
    const double above =
        grid.flux(wanted[i].layer, built.states[i]) - rates[wanted[i].layer] * phi * (phi - 1);
    EXPECT_GE(above, -1e-15);
    EXPECT_LE(above, rates[wanted[i].layer] * resolution * resolution / 4);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    int n_fronts = 0;
    solve_in_layer(grid, k, 0, grid.n_states(k) - 1, [&](State a, State b) {
      ++n_fronts;
      for (State i = a + 1; i < b; ++i) {
        EXPECT_EQ(grid.speed(k, a, i), grid.speed(k, a, b));
        EXPECT_EQ(grid.speed(k, i, b), grid.speed(k, a, b));
      }
    });
    EXPECT_LE(n_fronts, 20);  // not 6000: only vertices split a fan
    for (State i = 1; i < grid.n_states(k); ++i) EXPECT_GT(grid.phi(k, i), grid.phi(k, i - 1));
  }
}

TEST(LevelGrid, SingularMappingIsThePapersGrid) {
  // phi_{k,m} = 1/2 + sgn(m)/2 sqrt(|m| / k), a rounded to k delta, initial states to the nearest.
  const double delta = 0.1;
  const auto built =
      LevelGrid<double>::singular_mapping(stack_of({2.4, 0.31}), delta, {{0, 0}, {1, 1}, {1, 0.4}});
  const auto& grid = built.grid;
  const int steps[] = {24, 3};
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(grid.n_states(k), 2 * steps[k] + 1);
    EXPECT_NEAR(grid.rate(k), steps[k] * delta, 1e-15);
    for (int m = -steps[k]; m <= steps[k]; ++m)
      EXPECT_NEAR(grid.phi(k, m + steps[k]),
                  0.5 + (m < 0 ? -0.5 : 0.5) * std::sqrt(std::abs(m) / double(steps[k])), 1e-15);
  }
  EXPECT_EQ(grid.phi(0, built.states[0]), 0);
  EXPECT_EQ(grid.phi(1, built.states[1]), 1);
  EXPECT_NEAR(grid.phi(1, built.states[2]), 0.5, 1e-15);  // the neighbours of 0.4 are 0.2113 and 0.5
}

}  // namespace
}  // namespace shearfront
