// SPDX-License-Identifier: BSD-3-Clause
// The march of cells: conservation, bounds, and the same numbers by different ways.
#include "shearfront/fv/march.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/fv/run.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "support/cell_states.hpp"
#include "support/grid_scenes.hpp"
#include "support/random_scene.hpp"
#include "support/solid_scene.hpp"

namespace shearfront {
namespace {

using fv::March;
using fv::Rule;
using fv::Scheme;
using support::draw;
using support::maker_of;
using support::options_of;
using support::SceneMaker;

constexpr int kMarchScenes = 25;
const std::array<Scheme, 5> kSchemes{
    Scheme{Rule::engquist_osher}, Scheme{Rule::godunov}, Scheme{Rule::godunov, {}, Limiter::minmod},
    Scheme{Rule::godunov, {}, Limiter::mc}, Scheme{Rule::godunov, {}, Limiter::van_leer}};

/// Amounts are multiples of a quantum, so there is no rounding.
std::int64_t mass_in_quanta(const March& march) {
  std::int64_t sum = 0;
  for (const double amount : march.amounts()) {
    const double quanta = amount / March::kQuantum;
    EXPECT_EQ(quanta, std::nearbyint(quanta));
    sum += static_cast<std::int64_t>(quanta);
  }
  return sum;
}

double mass(const Scene<double>& scene, const fv::Grid& grid, const March& march) {
  return fv::cell_profile(scene, grid, march.shares()).mass();
}

void expect_in_range(const fv::CellShares& cells) {
  for (std::size_t j = 0; j < cells.x.size(); ++j) {
    const double rise = cells.half_rise.empty() ? 0 : cells.half_rise[j];
    ASSERT_GE(std::min(cells.x[j] - rise, cells.x[j] + rise), 0);
    ASSERT_LE(std::max(cells.x[j] - rise, cells.x[j] + rise), 1);
  }
}

/// Other initial states, one per cell: any number of quanta away from pure, or pure but for a few cells.
void replace_states(SceneSpec<double>& spec, int kind, std::size_t n, SceneMaker& maker) {
  if (kind == 0) return;
  spec.initial_breaks.clear();
  spec.initial_values.clear();
  const std::size_t n_same = static_cast<std::size_t>(maker.integer(1, 60));
  for (std::size_t j = 0; j < n; ++j) {
    const double small = std::ldexp(maker.uniform(0, 1), -maker.integer(0, 52));
    const double few = maker.integer(0, 7) == 0 ? std::ldexp(maker.integer(0, 200), -53) : 0;
    if (j > 0) spec.initial_breaks.push_back(static_cast<double>(j) / static_cast<double>(n));
    if (kind == 1) spec.initial_values.push_back(maker.integer(0, 1) == 0 ? small : 1 - small);
    if (kind == 2) spec.initial_values.push_back(j / n_same % 2 == 0 ? few : 1 - few);
  }
}

TEST(FvMarch, KeepsMassToTheBitAndPhiInItsRange) {
  for (int number = 0; number < 180; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 20), maker.order(), 12);
    auto& rates = std::get<Piecewise<double>>(spec.shear_rate).values;
    if (number % 2 == 0)
      for (double& a : rates) a = std::exp(maker.uniform(-6, 3));
    const fv::GridOptions options = options_of(maker);
    replace_states(spec, number / 15 % 3, options.cells, maker);
    const Scene<double> scene(spec);
    const fv::Grid grid = fv::grid_of(scene, options);
    March march(kSchemes[std::size_t(number) % kSchemes.size()], scene, grid);
    const std::int64_t quanta = mass_in_quanta(march);
    EXPECT_NEAR(mass(scene, grid, march), scene.mass(), 1e-14);
    for (int i = 0; i < 40; ++i) {
      march.step(std::min(options.cfl * march.largest_step(), 1.0));  // one cell has no largest step
      ASSERT_EQ(mass_in_quanta(march), quanta);
      ASSERT_NEAR(mass(scene, grid, march), scene.mass(), 1e-14);
      expect_in_range(march.shares());
    }
  }
}

/// Many crossings of the fast layer while the slow one goes on, on unequal cells with solid fraction.
void expect_mass_after(int n_steps) {
  SceneMaker maker = maker_of(3);
  SceneSpec<double> spec = support::solid_data(maker, support::Grains::large);
  spec.shear_rate = Piecewise<double>{{0.31, 0.6}, {1e-4, 2, 0.3}};
  const Scene<double> scene(spec);
  for (const Scheme& scheme : kSchemes) {
    const fv::Grid grid = fv::aligned_cells(scene, 12);
    March march(scheme, scene, grid);
    const std::int64_t quanta = mass_in_quanta(march);
    for (int i = 0; i < n_steps; ++i) march.step(march.largest_step());
    EXPECT_EQ(mass_in_quanta(march), quanta);
    EXPECT_NEAR(mass(scene, grid, march), scene.mass(), 1e-13 * scene.mass());
    expect_in_range(march.shares());
  }
}

TEST(FvMarch, KeepsMassInLongRuns) { expect_mass_after(20'000); }
TEST(SlowFvMarch, KeepsMassInLongerRuns) { expect_mass_after(400'000); }

TEST(FvMarch, KeepsMassNextToAThinPureCell) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.0034, 0.0159, 0.0159042}, {1.03, 1.0019, 1.0019, 1.058}};
  spec.initial_breaks = {0.3, 0.6, 0.8};
  spec.initial_values = {0.21, 1, 0.51, 1};
  const Scene<double> scene(spec);
  fv::GridOptions options;
  options.cells = 12;
  options.align_cells = true;
  for (const Scheme& scheme : kSchemes) {
    const auto run = fv::start(scheme, scene, options, {});
    for (const double t : {0.5, 1.0, 2.0, 4.0}) {
      ASSERT_LE(int(run->advance(t)), int(Status::steady));
      EXPECT_NEAR(run->field().at(1).M, scene.mass(), 1e-15);
    }
  }
}

TEST(FvMarch, AveragesOfEqualStatesAreThatState) {
  SceneMaker maker = maker_of(0);
  for (int number = 0; number < 100; ++number) {
    SceneSpec<double> spec;
    spec.shear_rate = Piecewise<double>{{}, {1}};
    spec.initial_breaks = maker.heights(30, 0, 1);
    spec.initial_values.assign(31, number % 2 == 0 ? 1 : maker.uniform(0, 1));
    const Scene<double> scene(spec);
    for (const double phi : fv::initial_shares(scene, fv::equal_cells(scene, 7)))
      EXPECT_EQ(phi, spec.initial_values[0]);
  }
}

// Where a layer carries all it can, the state beyond the interface that muscl looks for is the square root of
// a difference that is 0 but for its rounding: up to 1e-8 there.
double tolerance_of(const Scheme& scheme) { return scheme.limiter ? 1e-8 : 1e-11; }

TEST(FvMarch, AnyFluxAgreesWithTheParabolaAndGrainsThatRiseAreAMirrorImage) {
  for (int number = 0; number < kMarchScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    fv::GridOptions options = options_of(maker);
    options.align_cells = false;  // the mirror image of an aligned grid may have one cell more in a layer
    SceneSpec<double> mirrored = scene.spec(), general = scene.spec();
    mirrored.fluxes = {Lwr<double>{}};
    general.fluxes = {Cubic<double>{}};  // gamma = 0: the quadratic flux
    auto& rate = std::get<Piecewise<double>>(mirrored.shear_rate);
    const auto turn = [](std::vector<double>& z) {
      std::reverse(z.begin(), z.end());
      for (double& x : z) x = 1 - x;
    };
    turn(rate.breaks), turn(mirrored.initial_breaks);
    std::reverse(rate.values.begin(), rate.values.end());
    std::reverse(mirrored.initial_values.begin(), mirrored.initial_values.end());
    const Scene<double> mirror(mirrored), other(general);
    for (const Scheme& scheme : kSchemes) {
      const auto a = fv::start(scheme, scene, options, {}), b = fv::start(scheme, mirror, options, {}),
                 c = fv::start(scheme, other, options, {});
      for (const double t : {0.3, 2.0, infinity<double>()}) {
        ASSERT_LE(int(a->advance(t)), int(Status::steady));
        ASSERT_LE(int(b->advance(t)), int(Status::steady));
        ASSERT_LE(int(c->advance(t)), int(Status::steady));
        for (std::size_t j = 0; j < options.cells; ++j) {
          const double z = (static_cast<double>(j) + 0.5) / static_cast<double>(options.cells);
          const double phi = a->field().at(z).phi;
          ASSERT_NEAR(phi, c->field().at(z).phi, tolerance_of(scheme));
          ASSERT_NEAR(phi, b->field().at(1 - z).phi, tolerance_of(scheme));
        }
      }
    }
  }
}

// The loops for many cells at once, in blocks, against one face flux after the other.
TEST(FvMarch, AgreesWithAPlainLoopOverFaceFluxes) {
  for (int number = 0; number < 40; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const bool is_plain = number % 4 == 0;
    const Scene<double> scene(
        is_plain ? maker.data(3, maker.order(), 5)
                 : support::solid_data(maker, number % 2 ? support::Grains::large : support::Grains::small));
    const std::size_t n_cells = number % 5 == 0 ? 700 : std::size_t(maker.integer(1, 90));
    const fv::Grid grid =
        number % 3 == 0 ? fv::aligned_cells(scene, n_cells) : fv::equal_cells(scene, n_cells);
    const fv::FluxShape flux(scene.fluxes()[0]);
    const auto k = fv::cell_rates(scene, grid), k_face = fv::face_rates(scene, grid);
    const auto capacity = fv::capacities(scene, grid);
    for (const Rule rule : {Rule::godunov, Rule::engquist_osher}) {
      March march(Scheme{rule}, scene, grid);
      const double dt = march.largest_step();
      std::vector<double> x = fv::initial_shares(scene, grid), f(grid.n_cells() + 1, 0.0);
      for (int step = 0; step < 300; ++step) {
        march.step(dt);
        for (std::size_t j = 1; j < x.size(); ++j)
          f[j] = fv::face_flux(rule, {&flux, k[j - 1], 1, x[j - 1]}, {&flux, k[j], 1, x[j]}, k_face[j]);
        for (std::size_t j = 0; j < x.size(); ++j)
          x[j] = std::clamp(x[j] - dt / capacity[j] * (f[j + 1] - f[j]), 0.0, 1.0);
      }
      const fv::CellShares cells = march.shares();
      for (std::size_t j = 0; j < x.size(); ++j) ASSERT_NEAR(cells.x[j], x[j], 1e-11) << j;
    }
  }
}

}  // namespace
}  // namespace shearfront
