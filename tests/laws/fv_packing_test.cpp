// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes in beds whose solid fraction and temperature vary with height; random scenes with fixed seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/fv/run.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/solid_scene.hpp"

namespace shearfront {
namespace {

using support::Grains, support::SceneMaker;

SceneMaker maker_with_packing(int number) {
  return SceneMaker(support::seed_of(11000 + std::uint64_t(number)));
}

SolverResult solved(const Scene<double>& scene, std::vector<double> times, std::size_t cells, auto solver,
                    bool is_aligned = false) {
  SolverRequest request{std::move(times), {0.0, 0.37, 1.0}};
  request.profiles = true;
  typename decltype(solver)::Options options;
  options.cells = cells;
  options.align_cells = is_aligned;
  return solve<decltype(solver)>(scene, request, options);
}

template <class Solver>
void expect_within_packing(int n_scenes, std::size_t cells) {
  int n_jumps = 0;
  for (int number = 0; number < n_scenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_packing(number);
    const Scene<double> scene(support::solid_data(maker, number % 2 == 0 ? Grains::small : Grains::large));
    const auto result =
        solved(scene, {0, 0.02, 0.1, 0.4, 1, 3, infinity<double>()}, cells, Solver{}, number % 3 == 0);
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    n_jumps += std::holds_alternative<Piecewise<double>>(*scene.spec().solid_fraction);
    for (const Profile<double>& profile : result.profiles) {
      ASSERT_EQ(support::overshoot(scene, profile), 0);
      for (std::size_t i = 0; i < profile.n_cells(); ++i)
        ASSERT_GE(std::min(profile.below()[i], profile.above()[i]), 0);
      ASSERT_NEAR(profile.mass(), scene.mass(), 1e-13);
    }
  }
  EXPECT_GT(n_jumps, n_scenes / 4);
}

// The modified Godunov scheme has no overshoot at all.
TEST(FvPacking, GodunovNeverExceedsThePackingIn1000Scenes) { expect_within_packing<GodunovSolver>(1000, 24); }
TEST(FvPacking, EngquistOsherNeverExceedsThePacking) { expect_within_packing<EngquistOsherSolver>(200, 40); }
TEST(FvPacking, MusclNeverExceedsThePacking) { expect_within_packing<MusclSolver>(200, 40); }

// The reference schemes exceed it where grains move towards smaller solid fraction, and keep the mass.
TEST(FvPacking, SchemesThatDoNotMatchFluxesOvershoot) {
  for (int number = 0; number < 20; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_packing(number);
    SceneSpec<double> spec;
    const double most = maker.uniform(0.5, 0.7), least = maker.uniform(0.2, 0.4);
    const bool is_small = number % 2 == 0;
    spec.fluxes = {support::flux_of(is_small ? Grains::small : Grains::large)};
    spec.shear_rate = Piecewise<double>{{}, {1}};
    spec.solid_fraction = Table<double>{{0, 1}, {is_small ? least : most, is_small ? most : least}};
    spec.initial_values = {0.5};
    const Scene<double> scene(spec);
    const auto check = [&](auto solver) {
      const auto result = solved(scene, {0.5, 1}, 50, solver);
      ASSERT_TRUE(result.summary.usable());
      EXPECT_GT(support::overshoot(scene, result.profiles[1]), 1e-4);
      EXPECT_NEAR(result.profiles[1].mass(), scene.mass(), 1e-13);
    };
    check(ClassicalGodunovSolver{});
    check(UpwindSolver{});
  }
}

// Layers of solid fraction c are layers c times as thick, and c times as fast, of a bed without solid fraction.
TEST(FvPacking, PackedLayersAreThickerLayers) {
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_packing(number);
    SceneSpec<double> spec = maker.data(maker.integer(2, 5), maker.order(), 0);
    const auto& rate = std::get<Piecewise<double>>(spec.shear_rate);
    spec.fluxes = {Quadratic<double>{}};
    spec.initial_breaks = rate.breaks;
    spec.initial_values.clear();
    Piecewise<double> solid_fraction{rate.breaks, {}}, thick{{}, {}};
    double top = 0;
    for (std::size_t k = 0; k < rate.values.size(); ++k) {
      spec.initial_values.push_back(maker.uniform(0, 1));
      solid_fraction.values.push_back(maker.uniform(0.1, 0.7));
      const double below = k == 0 ? 0 : rate.breaks[k - 1],
                   above = k < rate.breaks.size() ? rate.breaks[k] : 1;
      top += solid_fraction.values[k] * (above - below);
      thick.values.push_back(rate.values[k] * solid_fraction.values[k]);
      if (k < rate.breaks.size()) thick.breaks.push_back(top);
    }
    spec.solid_fraction = solid_fraction;
    SceneSpec<double> plain;
    plain.shear_rate = thick;
    plain.initial_breaks = thick.breaks;
    plain.initial_values = spec.initial_values;
    plain.top = top;
    // One grid for both: few equal cells in every layer.
    const Scene<double> packed(spec), other(plain);
    const fv::Grid grid = fv::aligned_cells(packed, 60);
    fv::Grid stretched = grid;
    for (std::size_t j = 0; j < grid.n_cells(); ++j) {
      const double c = packed.solid_fraction_at(grid.middle(j));
      stretched.widths[j] = grid.widths[j] * c;
      stretched.edges[j + 1] = stretched.edges[j] + stretched.widths[j];
    }
    fv::March a({}, packed, grid), b({}, other, stretched);
    EXPECT_NEAR(a.largest_step(), b.largest_step(), 1e-12 * a.largest_step());
    for (int i = 0; i < 200; ++i) a.step(a.largest_step()), b.step(a.largest_step());
    const auto at_a = a.shares().x, at_b = b.shares().x;
    for (std::size_t j = 0; j < grid.n_cells(); ++j) EXPECT_NEAR(at_a[j], at_b[j], 1e-11) << j;
  }
}

// Small grains and large ones fill the bed together: solved for either, phi_small + phi_large = c.
TEST(FvPacking, SmallAndLargeGrainsFillTheBed) {
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_packing(number);
    SceneSpec<double> spec = support::solid_data(maker, Grains::small);
    const Scene<double> small(spec);
    spec.fluxes = {Lwr<double>{}};
    for (double& x : spec.initial_values) x = 1 - x;
    const Scene<double> large(spec);
    const auto check = [&](auto solver) {
      const auto s = solved(small, {0.1, 0.7, infinity<double>()}, 50, solver);
      const auto l = solved(large, {0.1, 0.7, infinity<double>()}, 50, solver);
      for (std::size_t i = 0; i < s.profiles.size(); ++i)
        for (std::size_t k = 0; k < s.profiles[i].n_cells(); ++k)
          ASSERT_NEAR(s.profiles[i].below()[k] + l.profiles[i].below()[k],
                      small.solid_fraction_at(s.profiles[i].z()[k]), 1e-12);
    };
    check(GodunovSolver{});
    check(EngquistOsherSolver{});
    check(MusclSolver{});
  }
}

// A bed of constant solid fraction is a bed without, times c; times do not depend on c.
TEST(FvPacking, ConstantPackingScalesPhi) {
  SceneMaker maker = maker_with_packing(0);
  SceneSpec<double> spec = maker.data(3, maker.order(), 5);
  const Scene<double> plain(spec);
  spec.solid_fraction = Piecewise<double>{{}, {0.64}};
  const Scene<double> packed(spec);
  const auto a = solved(plain, {0.3}, 80, GodunovSolver{}), b = solved(packed, {0.3}, 80, GodunovSolver{});
  for (std::size_t i = 0; i < a.profiles[0].n_cells(); ++i)
    EXPECT_NEAR(0.64 * a.profiles[0].below()[i], b.profiles[0].below()[i], 1e-14);
}

}  // namespace
}  // namespace shearfront
