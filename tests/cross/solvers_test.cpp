// SPDX-License-Identifier: BSD-3-Clause
// Every solver of the list against what it guarantees: a new one is tested here without a new line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/options.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

/// The names of the solvers of beds without diffusion; the others have diffusion_solvers_test.cpp.
std::vector<std::string> without_diffusion() {
  std::vector<std::string> names = Method::names();
  std::erase_if(names, [](const std::string& name) {
    return Method(name).guarantees().diffusion || Method(name).guarantees().has_slab;
  });
  return names;
}

class EverySolver : public testing::TestWithParam<std::string> {};

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(All, EverySolver, testing::ValuesIn(without_diffusion()), test_name);

constexpr double kSolverResolution = 0.02;
constexpr double kSolverCells = 100;

SolverRequest request_for(const Scene<double>& scene) {
  SolverRequest request;
  request.times = {1.3, 0, infinity<double>(), 0.2};  // in no order
  for (int i = 0; i <= 40; ++i)
    request.heights.push_back(scene.bottom() + (scene.top() - scene.bottom()) * i / 40);
  std::swap(request.heights[3], request.heights[20]);
  request.timeline = request.profiles = true;
  return request;
}

TEST_P(EverySolver, KeepsWhatItGuarantees) {
  const Method method =
      support::method_of(GetParam(), {{"resolution", kSolverResolution}, {"cells", kSolverCells}});
  const Guarantees promised = method.guarantees();
  for (std::uint64_t number = 0; number < 40; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    support::SceneMaker maker(support::seed_of(3000 + number));
    const Scene<double> scene(maker.data(maker.integer(1, 6), maker.order(), 10));
    const SolverRequest request = request_for(scene);
    const SolverResult result = solve(scene, method, request);
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    ASSERT_EQ(result.samples.size(), request.times.size() * request.heights.size());
    const ExactSolution<double> exact(scene);
    double slack = 1e-12;
    if (!promised.exact) slack = std::pow(kSolverResolution, promised.order_M);
    for (std::size_t i = 0; i < request.times.size(); ++i)
      for (std::size_t j = 0; j < request.heights.size(); ++j) {
        const Sample& s = result.samples[i * request.heights.size() + j];
        const double z = request.heights[j], t = request.times[i];
        if (promised.bounded) {
          EXPECT_GE(s.phi, 0);
          EXPECT_LE(s.phi, 1);
        }
        if (promised.conservative && z == scene.top()) {
          EXPECT_NEAR(s.M, scene.mass(), 1e-13);
        }
        EXPECT_NEAR(s.M, exact.M(z, t), slack) << "z = " << z << ", t = " << t;
      }
    ASSERT_EQ(result.profiles.size(), promised.has_profiles ? request.times.size() : 0);
    for (std::size_t i = 0; i < result.profiles.size(); ++i)
      for (std::size_t j = 0; j < request.heights.size(); ++j) {
        const auto value = result.profiles[i].at(request.heights[j]);
        EXPECT_EQ(value.phi, result.samples[i * request.heights.size() + j].phi);
        EXPECT_NEAR(value.M, result.samples[i * request.heights.size() + j].M, 1e-14);
      }
    ASSERT_EQ(result.timeline.has_value(), promised.has_timeline);
    if (!promised.has_timeline) continue;
    EXPECT_TRUE(result.timeline->t_star.has_value());
    EXPECT_NEAR(result.timeline->mass, scene.mass(), 1e-15);
  }
}

TEST_P(EverySolver, SolvesEveryShearRateModel) {
  const Method method = support::method_of(GetParam(), {{"resolution", kSolverResolution}, {"cells", 1000}});
  const Guarantees promised = method.guarantees();
  DepthFunctionList<double>::for_each([&]<class Model>() {
    for (const Model& model : Model::samples()) {
      SceneSpec<double> spec;
      spec.shear_rate = model;
      spec.initial_breaks = {0.5};
      spec.initial_values = {0, 1};
      const Scene<double> scene(spec);
      SolverRequest request{{0.3}, {0, 0.25, 0.5, 0.75, 1}, false, false};
      const SolverResult result = solve(scene, method, request);
      ASSERT_TRUE(result.summary.usable()) << Model::kName << ": " << result.summary.message;
      EXPECT_NEAR(result.samples.back().M, scene.mass(), 1e-13) << Model::kName;
      if (!promised.exact && promised.order_M == 0)
        continue;  // upwind leaves segregated grains where they are
      const ExactSolution<double> exact(scene);
      for (std::size_t j = 0; j < request.heights.size(); ++j)
        EXPECT_NEAR(result.samples[j].M, exact.M(request.heights[j], 0.3), 0.1 * kSolverResolution)
            << Model::kName;
    }
  });
}

TEST(FrontTracking, ReconstructionsGridsAndFrontsAreOptionsOfTheSolver) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  SolverRequest request{{0.5}, {0.45, 0.5, 0.6}, false, true};
  FrontTrackingSolver::Options options;
  options.resolution = 0.1;
  options.reconstruct = Reconstruction::linear;
  const SolverResult lines = solve<FrontTrackingSolver>(scene, request, options);
  for (std::size_t j = 0; j < 3; ++j)  // before its first meeting the fan is exact
    EXPECT_NEAR(lines.samples[j].phi, 0.5 + (request.heights[j] - 0.5) / (2 * 0.31 * 0.5), 1e-13);
  EXPECT_EQ(lines.fronts.size(), 10u);
  for (const auto& f : lines.fronts) EXPECT_EQ(f.t_end, 0.5);
  options.grid = GridKind::singular_mapping;
  options.resolution = 0.4;
  request.timeline = true;
  const SolverResult paper = solve<FrontTrackingSolver>(scene, request, options);
  EXPECT_NEAR(*paper.timeline->t_star, 5.0, 1e-13);  // a = 0.31 rounded to 0.4, t* = 2 / a
}

TEST(FrontTracking, SaysWhyItCannot) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  const SolverRequest request{{1}, {0.5}, true, false};
  for (const double resolution : {0.0, -1.0, 2.0, 1e-12, 1e-300, std::nan("")}) {
    FrontTrackingSolver::Options options;
    options.resolution = resolution;
    const Summary summary = solve<FrontTrackingSolver>(scene, request, options).summary;
    EXPECT_EQ(summary.status, Status::unsupported) << resolution;
    EXPECT_FALSE(summary.message.empty());
  }
  FrontTrackingSolver::Options options;
  options.max_collisions = 5;
  EXPECT_EQ(solve<FrontTrackingSolver>(scene, request, options).summary.status, Status::budget_reached);
  options = {};
  options.resolution = 1e-5;
  const auto stop = [](double, std::uint64_t) { return false; };
  EXPECT_EQ(solve<FrontTrackingSolver>(scene, request, options, stop).summary.status, Status::interrupted);
}

}  // namespace
}  // namespace shearfront
