// SPDX-License-Identifier: BSD-3-Clause
// Riemann problems at interfaces between any two fluxes of one kind: what front tracking makes of them, by
// supply and demand, by a Godunov run, and case by case.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/riemann/in_layer.hpp"
#include "shearfront/riemann/interface.hpp"
#include "shearfront/track/level_grid.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/interface_problem.hpp"
#include "support/thesis_cases.hpp"

namespace shearfront {
namespace {

using support::InterfaceProblem;
using support::SceneMaker;

/// What the tracker does at the interface of two layers.
struct Tracked {
  double flux_below, flux_above;
  int n_below, n_above;             ///< waves that leave
  double fastest_up, fastest_down;  ///< of those below upwards, of those above downwards: none may be
};

template <class Grid>
Tracked track(const LayerStack<double>& stack, double l, double r) {
  const auto built = Grid::exact_levels(stack, 1, {{0, l}, {1, r}});
  const Grid& grid = built.grid;
  const StatePair pair = solve_interface(grid, 0, built.states[0], built.states[1]);
  Tracked result{grid.flux(0, pair.below), grid.flux(1, pair.above), 0, 0, 0, 0};
  solve_in_layer(grid, 0, built.states[0], pair.below, [&](State p, State q) {
    ++result.n_below;
    result.fastest_up = std::max(result.fastest_up, double(grid.speed(0, p, q)));
  });
  solve_in_layer(grid, 1, pair.above, built.states[1], [&](State p, State q) {
    ++result.n_above;
    result.fastest_down = std::max(result.fastest_down, -double(grid.speed(1, p, q)));
  });
  return result;
}

Tracked track(const InterfaceProblem& p) {
  const LayerStack<double> stack({0, 0.5, 1}, {p.below.rate, p.above.rate}, 1, {true},
                                 {{p.below.flux, p.above.flux}, {0, 1}, {}});
  return track<UnimodalGrid<double>>(stack, p.below.state, p.above.state);
}

TEST(InterfaceOfAnyTwoFluxes, TrackerIsSupplyAndDemand) {
  SceneMaker maker(support::seed_of(8103));
  const std::vector<Flux<double>> fluxes = support::unimodal_fluxes();
  std::set<std::pair<std::string, std::string>> kinds;
  int n_crossing = 0;
  for (int number = 0; number < 100000; ++number) {
    const InterfaceProblem p = support::random_interface(maker, fluxes);
    const double expected = support::supply_and_demand(p.below, p.below.state, p.above, p.above.state);
    const Tracked tracked = track(p);
    ASSERT_NEAR(tracked.flux_below, expected, 1e-14) << number;
    ASSERT_NEAR(tracked.flux_above, expected, 1e-14) << number;
    EXPECT_LE(tracked.fastest_up, 1e-14) << number;
    EXPECT_LE(tracked.fastest_down, 1e-14) << number;
    kinds.emplace(support::name_of(p.below.flux), support::name_of(p.above.flux));
    const auto difference = [&](double u) {
      const auto value = [&](const support::InterfaceSide& side) {
        const auto [lowest, highest] = side.flux.range();
        return side.value(lowest + (highest - lowest) * u);
      };
      return value(p.below) - value(p.above);
    };
    n_crossing += difference(0.05) * difference(0.95) < 0;
  }
  EXPECT_GT(n_crossing, 1000);
  // Every kind beside every other of its shape, in both orders.
  for (const auto& below : fluxes)
    for (const auto& above : fluxes)
      EXPECT_EQ(kinds.count({support::name_of(below), support::name_of(above)}) > 0 ||
                    support::has_minimum(below) != support::has_minimum(above),
                true)
          << support::name_of(below) << " below " << support::name_of(above);
}

// The exact flux through an interface is constant in time. A monotone scheme has it from the first step on:
// demand and supply of the cells beside it never change past each other. The faces next to it come near as
// the waves leave: a wave that has not passed a cell after n steps is slower than fastest / n, and so is the
// difference of flux that it makes.
void check_godunov_limit(int n_problems) {
  SceneMaker maker(support::seed_of(8104));
  const std::vector<Flux<double>> fluxes = support::unimodal_fluxes();
  double mean[3] = {0, 0, 0};
  for (int number = 0; number < n_problems; ++number) {
    const InterfaceProblem p = support::random_interface(maker, fluxes);
    const Tracked tracked = track(p);
    const double fastest = std::max(p.below.steepest(), p.above.steepest());
    for (int i = 0; i < 3; ++i) {
      const int n_steps = 16 << i;
      const support::InterfaceRun run = support::godunov_run(p, n_steps);
      ASSERT_NEAR(run.lowest, tracked.flux_below, 1e-13) << number;
      ASSERT_NEAR(run.highest, tracked.flux_below, 1e-13) << number;
      const double off =
          std::max(std::abs(run.below - tracked.flux_below), std::abs(run.above - tracked.flux_above)) /
          fastest;
      ASSERT_LE(off, 2.0 / n_steps) << number << " steps " << n_steps;
      mean[i] += off / n_problems;
    }
  }
  EXPECT_LT(mean[1], 0.6 * mean[0]);
  EXPECT_LT(mean[2], 0.6 * mean[1]);
}

TEST(InterfaceOfAnyTwoFluxes, IsTheLimitOfGodunov) { check_godunov_limit(1000); }
TEST(SlowInterfaceOfAnyTwoFluxes, IsTheLimitOfGodunov) { check_godunov_limit(100000); }

class ThesisCases : public testing::TestWithParam<support::ThesisCase> {};

// Both engines' grids; large grains are the same upside down with the opposite flux (Appendix A there).
TEST_P(ThesisCases, TrackerFindsTheFluxOfTheTable) {
  const support::ThesisCase& c = GetParam();
  SCOPED_TRACE(c.name);
  const auto check = [](const Tracked& tracked, double expected) {
    EXPECT_NEAR(tracked.flux_below, expected, 1e-16);
    EXPECT_NEAR(tracked.flux_above, expected, 1e-16);
    EXPECT_LE(tracked.fastest_up, 1e-15);
    EXPECT_LE(tracked.fastest_down, 1e-15);
  };
  const LayerStack<double> small({0, 0.5, 1}, {1, 1}, 1, {true}, {{Quadratic<double>{}}, {}, {c.c_l, c.c_r}});
  check(track<UnimodalGrid<double>>(small, c.phi_l / c.c_l, c.phi_r / c.c_r), c.expected);
  check(track<LevelGrid<double>>(small, c.phi_l / c.c_l, c.phi_r / c.c_r), c.expected);
  const LayerStack<double> large({0, 0.5, 1}, {1, 1}, 1, {true}, {{Lwr<double>{}}, {}, {c.c_r, c.c_l}});
  check(track<UnimodalGrid<double>>(large, c.phi_r / c.c_r, c.phi_l / c.c_l), -c.expected);
  check(track<LevelGrid<double>>(large, c.phi_r / c.c_r, c.phi_l / c.c_l), -c.expected);
}

// Where the name says waves go, there are some, and none elsewhere.
TEST_P(ThesisCases, WavesGoWhereTheNameSays) {
  const support::ThesisCase& c = GetParam();
  const std::string name = c.name;
  const LayerStack<double> stack({0, 0.5, 1}, {1, 1}, 1, {true}, {{Quadratic<double>{}}, {}, {c.c_l, c.c_r}});
  const Tracked tracked = track<UnimodalGrid<double>>(stack, c.phi_l / c.c_l, c.phi_r / c.c_r);
  const bool keeps_l = tracked.flux_below == support::small_grains_flux(c.phi_l, c.c_l);
  if (name.find("waves go down") != std::string::npos) {
    EXPECT_GT(tracked.n_below, 0);
    EXPECT_EQ(tracked.n_above, 0);
  }
  if (name.find("both ways") != std::string::npos) {
    EXPECT_GT(tracked.n_below, 0);
    EXPECT_GT(tracked.n_above, 0);
  }
  if (keeps_l) {
    EXPECT_EQ(tracked.n_below, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(TableOfTheThesis, ThesisCases, testing::ValuesIn(support::kTenCases),
                         [](const testing::TestParamInfo<support::ThesisCase>& row) {
                           const std::string name(row.param.name);
                           return "Case" + name.substr(0, name.find(':'));
                         });

}  // namespace
}  // namespace shearfront
