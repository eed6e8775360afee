// SPDX-License-Identifier: BSD-3-Clause
// The exact solution through the interface of all solvers.
#include <gtest/gtest.h>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/layered_spec.hpp"

namespace shearfront {
namespace {

using support::layered;

TEST(ExactSolverApi, SamplesTimelineAndSummary) {
  const Scene<double> scene(layered({0.29}, {2.4, 0.31}, {0.5}, {0, 1}));
  SolverRequest request;
  request.times = {0.0, 3.0, infinity<double>()};
  request.heights = {0.1, 0.9};
  request.timeline = true;
  const auto result = solve<ExactSolver>(scene, request);
  ASSERT_EQ(result.samples.size(), 6u);
  const ExactSolution<double> solution(scene);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_EQ(result.samples[2 * i + j].M, solution.M(request.heights[j], request.times[i]));
      EXPECT_EQ(result.samples[2 * i + j].phi, solution.phi(request.heights[j], request.times[i]));
    }
  ASSERT_TRUE(result.timeline);
  EXPECT_NEAR(*result.timeline->t_star, 2 / 0.31, 1e-13);
  EXPECT_EQ(result.summary.status, Status::ok);
  EXPECT_EQ(result.summary.layers, 2u);
  EXPECT_GT(result.summary.wall_s, 0.0);
}

TEST(ExactSolverApi, BadRequestsAreNamed) {
  const Scene<double> scene(layered({0.29}, {2.4, 0.31}, {0.5}, {0, 1}));
  SolverRequest request;
  request.times = {0.0, -1.0};
  request.heights = {0.1, 1.5};
  try {
    (void)solve<ExactSolver>(scene, request);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "times[1] = -1; must be >= 0\nheights[1] = 1.5; must be inside the domain [0, 1]");
  }
}

TEST(ExactSolverApi, StopsWhenAsked) {
  const Scene<double> scene(layered({}, {1}, {0.5}, {0, 1}));
  const auto result = solve<ExactSolver>(scene, {{0.5, 2.0}, {0.5}, true, false}, {},
                                         [](double t, std::uint64_t) { return t < 1; });
  EXPECT_EQ(result.summary.status, Status::interrupted);
  EXPECT_FALSE(result.summary.usable());
}
}  // namespace
}  // namespace shearfront
