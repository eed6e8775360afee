// SPDX-License-Identifier: BSD-3-Clause
// The march of cells and its kernels: conservation, bounds, and the same numbers by different ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/fv/march.hpp"
#include "shearfront/fv/octaves.hpp"
#include "shearfront/fv/solve.hpp"
#include "support/cell_states.hpp"
#include "support/grid_scenes.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using fv::Scheme;
using fv::Simd;
using support::draw;
using support::maker_of;
using support::options_of;
using support::SceneMaker;

constexpr int kScenes = 25;
constexpr std::array kSchemes{Scheme::engquist_osher, Scheme::godunov, Scheme::muscl};

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

double mass(const fv::Grid& grid, const fv::CellStates& cells) {
  double sum = 0;
  for (std::size_t j = 0; j < grid.n_cells; ++j) sum += grid.widths[j] * cells.phi[j];
  return sum;
}

void expect_in_range(const fv::CellStates& cells) {
  for (std::size_t j = 0; j < cells.phi.size(); ++j) {
    ASSERT_GE(std::min(cells.at_bottom(j), cells.at_top(j)), 0);
    ASSERT_LE(std::max(cells.at_bottom(j), cells.at_top(j)), 1);
  }
}

/// Other states than those of a scene: any number of quanta away from pure, or pure but for a few cells.
void replace_states(std::vector<double>& phi, int kind, SceneMaker& maker) {
  const std::size_t n_same = static_cast<std::size_t>(maker.integer(1, 60));
  for (std::size_t j = 0; j < phi.size(); ++j) {
    const double small = std::ldexp(maker.uniform(0, 1), -maker.integer(0, 52));
    const double few = maker.integer(0, 7) == 0 ? std::ldexp(maker.integer(0, 200), -53) : 0;
    if (kind == 1) phi[j] = maker.integer(0, 1) == 0 ? small : 1 - small;
    if (kind == 2) phi[j] = j / n_same % 2 == 0 ? few : 1 - few;
  }
}

TEST(FvMarch, KeepsMassToTheBitAndPhiInItsRange) {
  const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic<double>{});
  int n_local = 0;
  for (int number = 0; number < 180; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 20), maker.order(), 12);
    auto& rates = std::get<Piecewise<double>>(spec.shear_rate).values;
    if (number % 2 == 0)
      for (double& a : rates) a = std::exp(maker.uniform(-6, 3));
    const Scene<double> scene(spec);
    const SolverOptions options = options_of(maker);
    const fv::Grid grid = support::grid_of(scene, options);
    const auto scheme = static_cast<Scheme>(number % 3);
    fv::CellData data = cell_data(scheme, scene, grid, options.local_steps);
    n_local += data.octaves.empty() ? 0 : 1;
    replace_states(data.phi, number / 9 % 3, maker);
    const auto kernel = fv::quadratic_kernel(scheme, static_cast<Limiter>(number / 3 % 3));
    fv::March march(*kernel, flux, data, options.cfl);
    const bool is_equal = !options.align_cells;
    const std::int64_t quanta = is_equal ? mass_in_quanta(march.states(0)) : 0;
    const double start = is_equal ? 0 : mass(grid, march.states(0));
    for (int i = 0; i < 40; ++i) {
      march.advance(1);
      const fv::CellStates cells = march.states(0);
      if (is_equal) {
        ASSERT_EQ(mass_in_quanta(cells), quanta);
      } else {
        ASSERT_NEAR(mass(grid, cells), start, 1e-14);
      }
      expect_in_range(cells);
    }
  }
  EXPECT_GT(n_local, 40);
}

// A slow cell that gives less than a quantum in each of 64 steps of the fast cells below, with no room
// elsewhere: what it has not got must not be asked for.
TEST(FvMarch, KeepsMassWhereAStepOfTheFastCellsMovesLessThanAQuantum) {
  const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic<double>{});
  for (const Scheme scheme : kSchemes)
    for (const bool is_fast_below : {true, false})
      for (int n_quanta = 1; n_quanta < 130; ++n_quanta) {
        SCOPED_TRACE(std::to_string(n_quanta) + " quanta");
        constexpr std::size_t kCells = 200;
        fv::CellData data;
        data.phi.assign(kCells, is_fast_below ? 0.0 : 1.0);
        data.phi[is_fast_below ? 100 : 99] = std::abs(data.phi[0] - std::ldexp(n_quanta, -53));
        for (std::size_t j = 0; j < kCells + (scheme == Scheme::engquist_osher ? 1 : 0); ++j)
          data.rates.push_back((j < 100) == is_fast_below ? 64 : 1);
        if (scheme == Scheme::engquist_osher) data.rates.front() = data.rates.back() = 0;
        data.octaves = fv::octaves_of(data);
        ASSERT_EQ(*std::max_element(data.octaves.begin(), data.octaves.end()), 6);
        const auto kernel = fv::quadratic_kernel(scheme);
        fv::March march(*kernel, flux, data, 1);
        const std::int64_t start = mass_in_quanta(march.states(0));
        for (int i = 0; i < 4; ++i) {
          march.advance(1);
          ASSERT_EQ(mass_in_quanta(march.states(0)), start);
          expect_in_range(march.states(0));
        }
      }
}

// Fluxes through the wide cell below a thin pure one are too small for a quantum of it in two million steps;
// rounded away each time, they would leave the thin cell no way to pass on what it gets.
TEST(FvMarch, KeepsMassNextToAThinPureCell) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.0034, 0.0159, 0.0159042}, {1.03, 1.0019, 1.0019, 1.058}};
  spec.initial_breaks = {0.3, 0.6, 0.8};
  spec.initial_values = {0.21, 1, 0.51, 1};
  const Scene<double> scene(spec);
  SolverOptions options;
  options.cells = 12;
  options.align_cells = true;
  const SolverRequest request{{0.5, 1, 2, 4}, {1}};
  for (const Scheme scheme : {Scheme::engquist_osher, Scheme::godunov, Scheme::muscl}) {
    const SolverResult result = fv::solve(scheme, scene, request, options);
    ASSERT_EQ(result.samples.size(), 4u);
    for (const Sample& sample : result.samples) EXPECT_NEAR(sample.M, scene.mass(), 1e-15);
  }
}

// One octave of rates on equal cells: the same run.
TEST(FvMarch, KeepsMassBesideSlowCellsOfUnequalWidth) {
  for (int number = 0; number < 6; ++number) {
    SceneMaker maker = maker_of(number);
    std::vector<double> breaks, values{maker.uniform(1, 128)};
    for (double z = 0; breaks.size() < 24; values.push_back(std::exp2(maker.uniform(0, 7))))
      breaks.push_back(z += maker.uniform(0.0005, 0.04));
    SceneSpec<double> spec;
    spec.shear_rate = Piecewise<double>{breaks, values};
    spec.initial_breaks = {0.2, 0.5};
    spec.initial_values = {maker.uniform(0, 1), maker.uniform(0, 1), maker.uniform(0, 1)};
    const Scene<double> scene(spec);
    SolverOptions options;
    options.cells = 5;  // more than a few in no layer
    options.align_cells = options.local_steps = true;
    for (const Scheme scheme : {Scheme::engquist_osher, Scheme::godunov, Scheme::muscl}) {
      const auto result = fv::solve(scheme, scene, {{0.5, 2}, {1.0}}, options);
      ASSERT_GT(result.summary.cell_updates, 10'000u);
      for (const Sample& sample : result.samples) EXPECT_NEAR(sample.M, scene.mass(), 2e-15) << number;
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
    for (const double phi : fv::initial_averages(Scene<double>(spec), {0, 1, 7, {}, {}}))
      EXPECT_EQ(phi, spec.initial_values[0]);
  }
}

TEST(FvMarch, LocalStepsChangeNothingWithinAnOctave) {
  SceneMaker maker = maker_of(0);
  const Scene<double> scene(maker.data(6, SceneMaker::Order::random, 12));
  SceneSpec<double> spec = scene.spec();
  for (double& a : std::get<Piecewise<double>>(spec.shear_rate).values) a = maker.uniform(1.01, 2);
  const fv::Grid grid{0, 1, 100, {}, {}};
  for (const Scheme scheme : {Scheme::engquist_osher, Scheme::godunov, Scheme::muscl})
    EXPECT_TRUE(cell_data(scheme, Scene<double>(spec), grid, true).octaves.empty());
}

struct RisingGrains {  // phi (1 - phi): the flux of grains that rise
  static constexpr std::string_view kName = "rising";
  static StateRange<double> range() { return {}; }
  static std::vector<double> extrema() { return {0.5}; }
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

/// Whether the steps of the cells are mirrored, too: which short runs of cells are joined depends on the
/// order.
bool has_mirrored_steps(Scheme scheme, const Scene<double>& scene, const Scene<double>& mirrored,
                        const SolverOptions& options) {
  const fv::Grid grid = support::grid_of(scene, options);
  const auto octaves = cell_data(scheme, scene, grid, options.local_steps).octaves;
  const auto others = cell_data(scheme, mirrored, grid, options.local_steps).octaves;
  return std::equal(octaves.begin(), octaves.end(), others.rbegin(), others.rend());
}

// Where a layer carries all it can, the state beyond the interface that muscl looks for is the square root of
// a difference that is 0 but for its rounding: up to 1e-8 there (largest difference of 40 scenes: 1.3e-10,
// the other 39 stay below 1e-11).
constexpr double tolerance_of(Scheme scheme) { return scheme == Scheme::muscl ? 1e-8 : 1e-11; }

TEST(FvKernels, GeneralAndQuadraticAgreeAndGrainsThatRiseAreAMirrorImage) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    SolverOptions options = options_of(maker);
    options.align_cells = false;  // the mirror image of an aligned grid may have one cell more in a layer
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
      const auto general = solve_generally<Quadratic<double>>(scheme, scene, request, options);
      const auto rising = solve_generally<RisingGrains>(scheme, Scene<double>(mirrored), request, options);
      const bool is_mirrored = has_mirrored_steps(scheme, scene, Scene<double>(mirrored), options);
      ASSERT_EQ(fast.samples.size(), 3 * options.cells);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < options.cells; ++j) {
          const double phi = fast.samples[i * options.cells + j].phi;
          EXPECT_NEAR(phi, general.samples[i * options.cells + j].phi, tolerance_of(scheme));
          if (!is_mirrored) continue;
          EXPECT_NEAR(phi, rising.samples[(i + 1) * options.cells - 1 - j].phi, tolerance_of(scheme));
        }
    }
  }
}

TEST(FvKernels, AllInstructionSetsAgreeToTheBit) {
  const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic<double>{});
  for (const std::size_t n_cells : {1u, 7u, 8u, 1000u, 5003u})
    for (int choice = 0; choice < 20; ++choice) {
      SceneMaker maker(support::seed_of(n_cells));
      const Scene<double> scene(maker.data(5, SceneMaker::Order::random, 12));
      SolverOptions options;
      options.cells = n_cells;
      options.align_cells = choice % 2 == 1;
      options.local_steps = choice / 2 % 2 == 1;
      const int scheme_and_limiter = choice / 4;  // limiters matter to muscl only
      const auto scheme = static_cast<Scheme>(std::min(scheme_and_limiter, 2));
      const auto limiter = static_cast<Limiter>(std::max(scheme_and_limiter - 2, 0));
      SCOPED_TRACE("cells " + std::to_string(n_cells) + ", choice " + std::to_string(choice));
      const fv::Grid grid = support::grid_of(scene, options);
      const fv::CellData data = cell_data(scheme, scene, grid, options.local_steps);
      const int n_steps = n_cells > 100 ? 70 : 301;
      const auto portable = fv::quadratic_kernel(scheme, limiter, Simd::portable);
      fv::March reference(*portable, flux, data, 1);
      for (int step = 0; step < n_steps; ++step) reference.advance(1);
      const auto expected = reference.states(0.3).phi;
      for (const Simd simd : {Simd::portable, Simd::avx2, Simd::avx512}) {
        if (simd > fv::widest_simd()) continue;
        const auto kernel = fv::quadratic_kernel(scheme, limiter, simd);
        fv::March march(*kernel, flux, data, 1);
        march.advance(static_cast<std::uint64_t>(n_steps));  // in blocks of many steps
        const auto states = march.states(0.3).phi;
        EXPECT_TRUE(std::equal(states.begin(), states.end(), expected.begin(), expected.end()));
      }
    }
}

}  // namespace
}  // namespace shearfront
