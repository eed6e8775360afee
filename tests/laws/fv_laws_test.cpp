// SPDX-License-Identifier: BSD-3-Clause
// What the finite-volume solvers guarantee whatever the scene, on equal and aligned cells; each law on random scenes
// with fixed seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/solver/all.hpp"
#include "support/cell_states.hpp"
#include "support/grid_scenes.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::draw;
using support::maker_of;
using support::options_of;
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
using MonotoneSolvers = testing::Types<EngquistOsherSolver, GodunovSolver>;
TYPED_TEST_SUITE(FvLaws, Solvers, SolverName);
template <class Solver>  // no scheme of second order is monotone
class FvFirstOrderLaws : public testing::Test {};
TYPED_TEST_SUITE(FvFirstOrderLaws, MonotoneSolvers, SolverName);

constexpr int kScenes = 40;

template <class Solver>
std::vector<std::vector<double>> cell_states(const Scene<double>& scene, const std::vector<double>& times,
                                             const fv::GridOptions& grid) {
  return support::cell_states<Solver>(scene, times, support::with_grid<Solver>(grid));
}

TYPED_TEST(FvFirstOrderLaws, ContractsInL1AndKeepsTheOrder) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    SceneSpec<double> lower = maker.data(maker.integer(1, 6), maker.order(), 12), upper = lower;
    for (double& phi : upper.initial_values) phi += (1 - phi) * maker.uniform(0, 1);
    SceneSpec<double> other = lower;
    for (double& phi : other.initial_values) phi = maker.uniform(0, 1);
    const std::vector<double> times{0, 0.02, 0.1, 0.5, 2, 8};
    const fv::GridOptions options = options_of(maker);
    const auto u = cell_states<TypeParam>(Scene<double>(lower), times, options);
    const auto v = cell_states<TypeParam>(Scene<double>(upper), times, options);
    const auto w = cell_states<TypeParam>(Scene<double>(other), times, options);
    const fv::Grid grid = support::grid_of(Scene<double>(lower), options);
    double last = 1e300;
    for (std::size_t i = 0; i < times.size(); ++i) {
      double distance = 0;
      for (std::size_t j = 0; j < grid.n_cells(); ++j) {
        EXPECT_LE(u[i][j], v[i][j] + 1e-14) << "t = " << times[i] << ", cell " << j;
        distance += std::abs(u[i][j] - w[i][j]) * (grid.edges[j + 1] - grid.edges[j]);
      }
      EXPECT_LE(distance, last + 1e-14);
      last = distance;
    }
  }
}

TYPED_TEST(FvLaws, StaysInTheSteadyStateForever) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 6), maker.order(), 0);
    fv::GridOptions options = options_of(maker);
    options.cells = 64;
    const fv::Grid grid = support::grid_of(Scene<double>(spec), options);
    spec.initial_breaks = {grid.edges[static_cast<std::size_t>(maker.integer(1, int(grid.n_cells()) - 1))]};
    spec.initial_values = {1, 0};
    const Scene<double> scene(spec);
    const auto states = cell_states<TypeParam>(scene, {infinity<double>(), 1e5, 0}, options);
    ASSERT_EQ(states.size(), 3u);
    if (TypeParam::kName == EngquistOsherSolver::kName) {  // its steady shock takes two mixed cells
      for (std::size_t j = 0; j < grid.n_cells(); ++j) EXPECT_NEAR(states[0][j], states[1][j], 1e-12);
    } else {
      EXPECT_EQ(states[1], states[2]);
      for (std::size_t j = 0; j < grid.n_cells(); ++j) EXPECT_NEAR(states[0][j], states[2][j], 1e-13);
    }
  }
}

// Where the initial amounts of small grains collect, whatever the scheme, and for ever.
TYPED_TEST(FvLaws, KeepsItsOwnSteadyState) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    fv::GridOptions options = options_of(maker);
    options.cells = 20;
    const auto states = cell_states<TypeParam>(scene, {1e4, 1e7}, options);
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0], states[1]);
  }
}

TYPED_TEST(FvLaws, MarchesToTheSteadyStateItNames) {
  for (int number = 0; number < kScenes; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    fv::GridOptions options = options_of(maker);
    options.cells = static_cast<std::uint64_t>(maker.integer(2, 60));
    const fv::Grid grid = support::grid_of(scene, options);
    const auto states = cell_states<TypeParam>(scene, {500, infinity<double>()}, options);
    ASSERT_EQ(states.size(), 2u);
    double M = 0;
    for (std::size_t j = 0; j < grid.n_cells(); ++j)
      EXPECT_NEAR(M += (states[0][j] - states[1][j]) * (grid.edges[j + 1] - grid.edges[j]), 0, 1e-9) << j;
  }
}

// datasets/bottleneck: limited slopes that ignore the jump of a would leave [0, 1] here.
TYPED_TEST(FvLaws, StaysInRangeAtABottleneck) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_values = {0.65};
  SolverRequest request;
  request.profiles = true;
  for (int i = 0; i <= 40; ++i) request.times.push_back(0.2 * i);
  for (int choice = 0; choice < 12; ++choice) {
    typename TypeParam::Options options;
    options.align_cells = choice / 3 % 2 == 1;
    options.cells = choice < 6 ? 100 : 37;
    if constexpr (requires { options.limiter; }) {
      options.limiter = static_cast<Limiter>(choice % 3);
    } else if (choice % 3 > 0) {
      continue;
    }
    for (const bool rising : {false, true}) {
      if (rising) spec.shear_rate = Piecewise<double>{{0.29}, {0.31, 2.4}};
      const SolverResult result = solve<TypeParam>(Scene<double>(spec), request, options);
      ASSERT_EQ(result.profiles.size(), request.times.size());
      for (const Profile<double>& profile : result.profiles) {
        EXPECT_NEAR(profile.mass(), 0.65, 1e-14);
        for (const auto& phi : {profile.below(), profile.above()}) {
          EXPECT_GE(*std::min_element(phi.begin(), phi.end()), 0);
          EXPECT_LE(*std::max_element(phi.begin(), phi.end()), 1);
        }
      }
    }
  }
}

TYPED_TEST(FvLaws, ScalingTimeByPowersOfTwoIsExact) {
  for (int number = 0; number < kScenes; ++number) {
    SceneMaker maker = maker_of(number);
    SceneSpec<double> spec = maker.data(maker.integer(1, 6), maker.order(), 12);
    const fv::GridOptions options = options_of(maker);
    const auto slow = cell_states<TypeParam>(Scene<double>(spec), {0.1, 0.77}, options);
    ASSERT_EQ(slow.size(), 2u);
    spec.scale *= 1024;
    EXPECT_EQ(slow, cell_states<TypeParam>(Scene<double>(spec), {0.1 / 1024, 0.77 / 1024}, options));
  }
}

TYPED_TEST(FvLaws, OtherTimesAndTheirOrderChangeNothing) {
  for (int number = 0; number < kScenes; ++number) {
    SceneMaker maker = maker_of(number);
    const Scene<double> scene = draw(maker);
    const fv::GridOptions options = options_of(maker);
    const auto alone = cell_states<TypeParam>(scene, {0.7}, options);
    EXPECT_EQ(alone[0], cell_states<TypeParam>(scene, {infinity<double>(), 0.7, 0.699, 0.3, 2}, options)[1]);
  }
}

/// Largest |difference| of phi between two specs at t = 0.4.
template <class Solver>
double difference(const SceneSpec<double>& a, const SceneSpec<double>& b, const fv::GridOptions& options) {
  const auto u = cell_states<Solver>(Scene<double>(a), {0.4}, options)[0];
  const auto v = cell_states<Solver>(Scene<double>(b), {0.4}, options)[0];
  double largest = 0;
  for (std::size_t j = 0; j < u.size(); ++j) largest = std::max(largest, std::abs(u[j] - v[j]));
  return largest;
}

// Where the number of steps changes, and where an interface or a jump passes an edge or the middle of a cell.
TYPED_TEST(FvLaws, DependsContinuouslyOnTheScene) {
  fv::GridOptions options;
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

}  // namespace
}  // namespace shearfront
