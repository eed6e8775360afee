// SPDX-License-Identifier: BSD-3-Clause
// Smooth and tabulated starts as users write them. The fault was a refusal by every solver of beds without diffusion; its kind, a
// check of the scene that speaks for solvers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/options.hpp"

namespace shearfront {
namespace {

Scene<double> read_start(const std::string& name) {
  return Scene<double>(read_scene<double>(SHEARFRONT_SOURCE_DIR "/tests/cases/inputs/" + name));
}

/// u = u0(x - u t) before the shock at t = 3/2, by Newton's method.
double burgers_before_shock(double x, double t) {
  double u = 1.0 / 3;
  for (int i = 0; i < 100; ++i) {
    const double y = x - u * t;
    u -= (u - 1.0 / 3 - 2.0 / 3 * std::sin(y)) / (1 + 2.0 / 3 * t * std::cos(y));
  }
  return u;
}

TEST(SmoothStarts, BurgersEquationOnARing) {
  const Scene<double> scene = read_start("burgers-ring.toml");
  SolverRequest request{{0.5}, {}};
  for (int i = 0; i < 60; ++i) request.heights.push_back(2 * std::numbers::pi * (i + 0.5) / 60);
  int n = 0;
  for (const auto& [name, numbers, error] :
       std::vector<std::tuple<std::string, support::OptionNumbers, double>>{
           {"front-tracking", {{"resolution", 0.002}}, 0.005},
           {"godunov", {{"cells", 2000}}, 0.01},
           {"engquist-osher", {{"cells", 2000}}, 0.01}}) {
    const SolverResult result = solve(scene, support::method_of(name, numbers), request);
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    for (std::size_t j = 0; j < request.heights.size(); ++j, ++n)
      EXPECT_NEAR(result.phi(0, j), burgers_before_shock(request.heights[j], 0.5), error) << name;
  }
  EXPECT_EQ(n, 180);
  EXPECT_FALSE(Method("exact").refusal(scene).empty());
}

TEST(SmoothStarts, AProfileMeasuredInATable) {
  const Scene<double> scene = read_start("measured-profile.toml");
  const ExactSolution<double> exact(scene);
  EXPECT_TRUE(exact.meets_tolerance());
  const auto times = exact_timeline(exact);
  // Pure at both ends: edges at 4 and 38 mm move as pure states do.
  EXPECT_NEAR(*times.t0, std::log(0.30 / 0.236) / 0.016, 1e-12);
  double error[2] = {0, 0};
  SolverRequest request{{20, 80, 200}, {}};
  for (int i = 1; i < 42; ++i) request.heights.push_back(i);
  for (int level = 0; level < 2; ++level) {
    const SolverResult cells =
        solve(scene, support::method_of("godunov", {{"cells", level == 0 ? 400.0 : 1600.0}}), request);
    ASSERT_TRUE(cells.summary.usable());
    for (std::size_t i = 0; i < request.times.size(); ++i)
      for (std::size_t j = 0; j < request.heights.size(); ++j)
        error[level] = std::max(error[level],
                                std::abs(cells.M(i, j) - exact.M(request.heights[j], request.times[i])) / 42);
  }
  EXPECT_LT(error[0], 5e-3);
  EXPECT_GT(error[0] / error[1], 2.8) << error[0] << ' ' << error[1];
  EXPECT_EQ(Method("front-tracking").refusal(scene), "");
}

TEST(SmoothStarts, WhatNoSolverTakesIsSaidByTheSolvers) {
  SceneSpec<double> spec = read_start("burgers-ring.toml").spec();
  spec.shear_rate = Table<double>{{0, 7}, {1, 2}};  // periodic, and a(z) is not the same at both ends
  spec.initial_state = SineInitial<double>{0.25, 0.5, 2 * std::numbers::pi, 0};
  const Scene<double> scene(spec);
  for (const std::string& name : Method::names()) {
    const std::string why = Method(name).refusal(scene);
    EXPECT_EQ(why.find("initial"), std::string::npos) << name << ": " << why;
    EXPECT_EQ(why.find("smooth"), std::string::npos) << name << ": " << why;
  }
}

}  // namespace
}  // namespace shearfront
