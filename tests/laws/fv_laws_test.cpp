// SPDX-License-Identifier: BSD-3-Clause
// What both finite-volume schemes guarantee whatever the scene; each law on random scenes with fixed seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "shearfront/fv/march.hpp"
#include "shearfront/fv/octaves.hpp"
#include "shearfront/fv/solve.hpp"
#include "shearfront/solver/all.hpp"
#include "support/cell_states.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using fv::Scheme;
using fv::Simd;
using support::cell_states;
using support::SceneMaker;

template <class Solver>
class FvLaws : public testing::Test {};
struct SolverName {
  template <class Solver>
  static std::string GetName(int) {
    return std::string(Solver::kName) == "engquist-osher" ? "engquist_osher" : std::string(Solver::kName);
  }
};
using Solvers = testing::Types<EngquistOsherSolver, GodunovSolver, MusclSolver>;
TYPED_TEST_SUITE(FvLaws, Solvers, SolverName);

constexpr int kScenes = 25;

SceneMaker maker_of(int number) { return SceneMaker(support::seed_of(7000 + std::uint64_t(number))); }
Scene<double> draw(SceneMaker& maker) {
  return Scene<double>(maker.data(maker.integer(1, 6), maker.order(), 12));
}
SolverOptions options_of(SceneMaker& maker) {
  SolverOptions options;
  options.cells = static_cast<std::size_t>(maker.integer(1, 150));
  options.cfl = maker.integer(0, 1) == 0 ? 1.0 : maker.uniform(0.1, 1);
  options.local_steps = maker.integer(0, 1) == 1;
  return options;
}

/// phi of the cells times 2^53 and summed: states are multiples of 2^-53, so there is no rounding.
std::int64_t mass_in_quanta(const fv::CellStates& cells) {
  std::int64_t sum = 0;
  for (const double phi : cells.phi) sum += static_cast<std::int64_t>(std::ldexp(phi, 53));
  return sum;
}

/// Data of a scheme on the grid, with local steps on request.
fv::CellData cell_data(Scheme scheme, const Scene<double>& scene, const fv::Grid& grid, bool local_steps) {
  fv::CellData data{
      fv::initial_averages(scene, grid),
      scheme == Scheme::engquist_osher ? fv::face_rates(scene, grid) : fv::cell_rates(scene, grid),
      {},
      {},
      0,
      0};
  for (const double width : grid.widths) data.narrowness.push_back(grid.cell_width() / width);
  if (local_steps) data.octaves = fv::octaves_of(data);
  return data;
}

TEST(FvMarch, KeepsMassToTheBitAndPhiInItsRange) {
  const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic{});
  int n_local = 0;
  for (int number = 0; number < 300; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 20), maker.order(), 12);
    auto& rates = std::get<Piecewise<double>>(spec.shear_rate).values;
    if (number % 5 == 0)
      for (double& a : rates) a = std::exp(maker.uniform(-6, 3));
    const Scene<double> scene(spec);
    const SolverOptions options = options_of(maker);
    const bool aligned = maker.integer(0, 1) == 1, local = maker.integer(0, 1) == 1;
    const fv::Grid grid =
        aligned ? fv::aligned_grid(scene, options.cells) : fv::Grid{0, 1, options.cells, {}, {}};
    const auto scheme = static_cast<Scheme>(number % 3);
    fv::CellData data = cell_data(scheme, scene, grid, local);
    n_local += data.octaves.empty() ? 0 : 1;
    if (number % 2 == 0)  // pure up to some quanta, and any
      for (double& x : data.phi) {
        const double small = std::ldexp(maker.uniform(0, 1), -maker.integer(0, 52));
        x = maker.integer(0, 1) == 0 ? small : 1 - small;
      }
    const auto kernel = fv::quadratic_kernel(scheme, static_cast<Limiter>(number / 3 % 3));
    fv::March march(*kernel, flux, data, options.cfl);
    const auto mass = [&](const fv::CellStates& cells) {
      double sum = 0;
      for (std::size_t j = 0; j < grid.n_cells; ++j) sum += grid.widths[j] * cells.phi[j];
      return sum;
    };
    const std::int64_t start = mass_in_quanta(march.states(0));
    const double start_mass = aligned ? mass(march.states(0)) : 0;
    for (int i = 0; i < 100; ++i) {
      const fv::CellStates cells = march.states(0);
      if (aligned) {
        ASSERT_NEAR(mass(cells), start_mass, 1e-14);
      } else {
        // Where all cells at a border are pure some quanta may wait.
        ASSERT_LE(std::abs(mass_in_quanta(cells) - start), data.octaves.empty() ? 0 : 64);
      }
      for (std::size_t j = 0; j < grid.n_cells; ++j) {
        ASSERT_GE(std::min(cells.at_bottom(j), cells.at_top(j)), 0);
        ASSERT_LE(std::max(cells.at_bottom(j), cells.at_top(j)), 1);
      }
      march.advance(1);
    }
  }
  EXPECT_GT(n_local, 30);
}

// One octave of rates on equal cells: the same run.
TEST(FvMarch, LocalStepsChangeNothingWithinAnOctave) {
  SceneMaker maker = maker_of(0);
  const Scene<double> scene(maker.data(6, SceneMaker::Order::random, 12));
  SceneSpec<double> spec = scene.spec();
  for (double& a : std::get<Piecewise<double>>(spec.shear_rate).values) a = maker.uniform(1.01, 2);
  const fv::Grid grid{0, 1, 100, {}, {}};
  for (const Scheme scheme : {Scheme::engquist_osher, Scheme::godunov, Scheme::muscl})
    EXPECT_TRUE(cell_data(scheme, Scene<double>(spec), grid, true).octaves.empty());
}

TYPED_TEST(FvLaws, ContractsInL1AndKeepsTheOrder) {
  if (TypeParam::kName == MusclSolver::kName) GTEST_SKIP() << "first order only";
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    SceneSpec<double> lower = maker.data(maker.integer(1, 6), maker.order(), 12), upper = lower;
    for (double& phi : upper.initial_values) phi += (1 - phi) * maker.uniform(0, 1);
    SceneSpec<double> other = lower;
    for (double& phi : other.initial_values) phi = maker.uniform(0, 1);
    const std::vector<double> times{0, 0.02, 0.1, 0.5, 2, 8};
    const SolverOptions options = options_of(maker);
    const auto u = cell_states<TypeParam>(Scene<double>(lower), times, options);
    const auto v = cell_states<TypeParam>(Scene<double>(upper), times, options);
    const auto w = cell_states<TypeParam>(Scene<double>(other), times, options);
    double last = 1e300;
    for (std::size_t i = 0; i < times.size(); ++i) {
      double distance = 0;
      for (std::size_t j = 0; j < options.cells; ++j) {
        EXPECT_LE(u[i][j], v[i][j] + 1e-14) << "t = " << times[i] << ", cell " << j;
        distance += std::abs(u[i][j] - w[i][j]);
      }
      EXPECT_LE(distance, last + 1e-12);
      last = distance;
    }
  }
}

TYPED_TEST(FvLaws, StaysInTheSteadyStateForever) {
  for (int number = 0; number < kScenes; ++number) {
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 6), maker.order(), 0);
    SolverOptions options = options_of(maker);
    options.cells = 64;
    spec.initial_breaks = {maker.integer(1, 63) / 64.0};
    spec.initial_values = {1, 0};
    const Scene<double> scene(spec);
    const auto states = cell_states<TypeParam>(scene, {infinity<double>(), 1e5}, options);
    EXPECT_EQ(states.size(), 2u);
    for (std::size_t j = 0; j < options.cells; ++j) EXPECT_NEAR(states[0][j], states[1][j], 1e-12);
    if constexpr (!std::is_same_v<TypeParam,
                                  EngquistOsherSolver>) {  // the exact steady state is a discrete one
      EXPECT_EQ(states[1], cell_states<TypeParam>(scene, {0}, options)[0]);
    }
  }
}

TYPED_TEST(FvLaws, MarchesToTheSteadyStateItNames) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    SolverOptions options;
    options.cells = static_cast<std::size_t>(maker.integer(2, 60));
    const auto states = cell_states<TypeParam>(scene, {500, infinity<double>()}, options);
    ASSERT_EQ(states.size(), 2u);
    double M = 0;
    for (std::size_t j = 0; j < options.cells; ++j)
      EXPECT_NEAR((M += states[0][j] - states[1][j]) / static_cast<double>(options.cells), 0, 1e-9) << j;
  }
}

TYPED_TEST(FvLaws, ScalingTimeByPowersOfTwoIsExact) {
  for (int number = 0; number < kScenes; ++number) {
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 6), maker.order(), 12);
    const SolverOptions options = options_of(maker);
    const auto slow = cell_states<TypeParam>(Scene<double>(spec), {0.1, 0.77}, options);
    spec.scale *= 1024;
    EXPECT_EQ(slow, cell_states<TypeParam>(Scene<double>(spec), {0.1 / 1024, 0.77 / 1024}, options));
  }
}

TYPED_TEST(FvLaws, OtherTimesAndTheirOrderChangeNothing) {
  for (int number = 0; number < kScenes; ++number) {
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    const SolverOptions options = options_of(maker);
    const auto alone = cell_states<TypeParam>(scene, {0.7}, options);
    EXPECT_EQ(alone[0], cell_states<TypeParam>(scene, {infinity<double>(), 0.7, 0.699, 0.3, 2}, options)[1]);
  }
}

/// Largest |difference| of phi between two specs at t = 0.4.
template <class Solver>
double difference(const SceneSpec<double>& a, const SceneSpec<double>& b, const SolverOptions& options) {
  const auto u = cell_states<Solver>(Scene<double>(a), {0.4}, options)[0];
  const auto v = cell_states<Solver>(Scene<double>(b), {0.4}, options)[0];
  double largest = 0;
  for (std::size_t j = 0; j < u.size(); ++j) largest = std::max(largest, std::abs(u[j] - v[j]));
  return largest;
}

// Where the number of steps changes, and where an interface or a jump passes an edge or the middle of a cell.
TYPED_TEST(FvLaws, DependsContinuouslyOnTheScene) {
  SolverOptions options;
  options.cells = 50;
  SceneSpec<double> spec;
  spec.initial_values = {0.1, 0.9};
  for (const double height : {0.5, 0.51}) {
    spec.shear_rate = Piecewise<double>{{height}, {2.5, 0.5}};
    spec.initial_breaks = {height};
    for (const double h : {-1e-9, 1e-9}) {
      SceneSpec<double> moved = spec;
      moved.scale = 1 + h;  // 0.4 * 2.5 * 50 = 50 steps exactly
      EXPECT_LT(difference<TypeParam>(spec, moved, options), 1e-6);
      moved = spec;
      moved.initial_breaks = {height + h};
      EXPECT_LT(difference<TypeParam>(spec, moved, options), 1e-6);
      moved = spec;
      moved.shear_rate = Piecewise<double>{{height + h}, {2.5, 0.5}};
      EXPECT_LT(difference<TypeParam>(spec, moved, options), 1e-6);
    }
  }
}

struct RisingGrains {  // phi (1 - phi): the flux of grains that rise
  static constexpr std::string_view kName = "rising";
  static constexpr std::array<double, 2> kRange{0.0, 1.0};
  static constexpr std::array<double, 1> kExtrema{0.5};
  static double value(double phi) { return phi * (1 - phi); }
  static double derivative(double phi) { return 1 - 2 * phi; }
};

/// Runs both schemes with a general kernel for the flux.
template <class Flux>
SolverResult solve_generally(Scheme scheme, const Scene<double>& scene, const SolverRequest& request,
                             const SolverOptions& options) {
  const fv::UnimodalFlux flux = fv::unimodal_flux(Flux{});
  return fv::solve(scheme, flux, *fv::unimodal_kernel(scheme, flux), scene, request, options);
}

TEST(FvKernels, GeneralAndQuadraticAgreeAndGrainsThatRiseAreAMirrorImage) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    const SolverOptions options = options_of(maker);
    SceneSpec<double> mirrored = scene.spec();
    auto& rate = std::get<Piecewise<double>>(mirrored.shear_rate);
    const auto turn = [](std::vector<double>& z) {
      std::reverse(z.begin(), z.end());
      for (double& x : z) x = 1 - x;
    };
    turn(rate.breaks), turn(mirrored.initial_breaks);
    std::reverse(rate.values.begin(), rate.values.end());
    std::reverse(mirrored.initial_values.begin(), mirrored.initial_values.end());
    const SolverRequest request{{0.3, 2, infinity<double>()}, support::middles(scene, options.cells)};
    for (const Scheme scheme : {Scheme::engquist_osher, Scheme::godunov, Scheme::muscl}) {
      const auto fast = fv::solve(scheme, scene, request, options);
      const auto general = solve_generally<Quadratic>(scheme, scene, request, options);
      const auto rising = solve_generally<RisingGrains>(scheme, Scene<double>(mirrored), request, options);
      ASSERT_EQ(fast.samples.size(), 3 * options.cells);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < options.cells; ++j) {
          const double phi = fast.samples[i * options.cells + j].phi;
          EXPECT_NEAR(phi, general.samples[i * options.cells + j].phi, 1e-11);
          EXPECT_NEAR(phi, rising.samples[(i + 1) * options.cells - 1 - j].phi, 1e-11);
        }
    }
  }
}

TEST(FvKernels, AllInstructionSetsAgreeToTheBit) {
  for (const std::size_t n_cells : {1u, 7u, 8u, 1000u, 5003u}) {
    SceneMaker maker(support::seed_of(n_cells));
    const Scene<double> scene(maker.data(5, SceneMaker::Order::random, 12));
    const fv::Grid grid{0, 1, n_cells, {}, {}};
    const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic{});
    for (const Scheme scheme : {Scheme::engquist_osher, Scheme::godunov, Scheme::muscl}) {
      const fv::CellData data = cell_data(scheme, scene, grid, false);
      const auto portable = fv::quadratic_kernel(scheme, Limiter::mc, Simd::portable);
      fv::March reference(*portable, flux, data, 1);
      for (int step = 0; step < 301; ++step) reference.advance(1);
      const auto expected = reference.states(0.3).phi;
      for (const Simd simd : {Simd::portable, Simd::avx2, Simd::avx512}) {
        if (simd > fv::widest_simd()) continue;
        const auto kernel = fv::quadratic_kernel(scheme, Limiter::mc, simd);
        fv::March march(*kernel, flux, data, 1);
        march.advance(301);  // in blocks of many steps
        const auto states = march.states(0.3).phi;
        EXPECT_TRUE(std::equal(states.begin(), states.end(), expected.begin(), expected.end())) << n_cells;
      }
    }
  }
}

}  // namespace
}  // namespace shearfront
