// SPDX-License-Identifier: BSD-3-Clause
// Steady states with diffusion for any a(z) and D(z): values of the source, closed forms, the scheme, and laws.
#include "shearfront/diffusion/steady_logistic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "shearfront/diffusion/cole_hopf_solver.hpp"
#include "shearfront/diffusion/cole_hopf_steady.hpp"
#include "shearfront/diffusion/crank_nicolson_solver.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

using diffusion::SteadyLogistic;

SceneSpec<double> slope() {
  SceneSpec<double> spec;
  Bagnold<double> a;
  a.angle = 0.43;
  a.grain = 0.04;
  a.gravity = 1;
  spec.shear_rate = a;
  spec.scale = 0.5;
  spec.diffusion = Diffusion<double>{0.01, {}, false};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

/// A layer on a slope: logistic in the velocity; u0 = 1.335458305673 from the mass by the midpoint rule on 400 000 cells.
TEST(SteadyLogistic, IsLogisticInTheVelocityOfALayerOnASlope) {
  const auto spec = slope();
  const auto& a = std::get<Bagnold<double>>(spec.shear_rate);
  const SteadyLogistic state{Scene<double>(spec)};
  for (const double z : {0.45, 0.48, 0.5, 0.52, 0.55, 0.6}) {
    const double odds = std::exp(-50 * (a.velocity(0, z) - 1.335458305673)), phi = state.at(z).phi;
    EXPECT_NEAR(phi / (1 - phi), odds, 1e-9 * odds) << z;
  }
  EXPECT_NEAR(state.at(1).M, 0.5, 1e-14);
}

/// Constant rate and D: the known closed form.
TEST(SteadyLogistic, IsThatOfAUniformBed) {
  for (const double D : {0.01, 0.1, 2.0}) {
    SceneSpec<double> spec;
    spec.shear_rate = Piecewise<double>{{}, {0.7}};
    spec.diffusion = Diffusion<double>{D, {}, false};
    spec.initial_breaks = {0.4};
    spec.initial_values = {0.2, 0.9};
    const Scene<double> scene(spec);
    const SteadyLogistic state(scene);
    const diffusion::SteadyState<double> known(0, 1, 0.7, D, scene.mass());
    for (const double z : {0.0, 0.2, 0.6, 0.77, 1.0}) {
      EXPECT_NEAR(state.at(z).phi, known.at(z).phi, 1e-12) << D << ' ' << z;
      EXPECT_NEAR(state.at(z).M, known.at(z).cumulative, 1e-12) << D << ' ' << z;
    }
  }
}

/// D proportional to a: int s a / D dz is linear, whatever a is.
TEST(SteadyLogistic, KnowsOnlyTheRatioOfRateAndDiffusivity) {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{2, 0.3};
  spec.diffusion = Diffusion<double>{0.05, {}, true};
  spec.initial_values = {0.35};
  const SteadyLogistic state{Scene<double>(spec)};
  const diffusion::SteadyState<double> known(0, 1, 1, 0.05, 0.35);
  for (const double z : {0.0, 0.3, 0.4, 1.0}) EXPECT_NEAR(state.at(z).phi, known.at(z).phi, 1e-12) << z;
}

TEST(SteadyLogistic, IsWhatTheSchemeComesTo) {
  for (const int kind : {0, 1, 2}) {
    SceneSpec<double> spec;
    spec.diffusion = Diffusion<double>{0.05, {}, kind == 2};
    spec.initial_breaks = {0.5};
    spec.initial_values = {0, 1};
    spec.shear_rate = Chute<double>{0.4, 0.4, 0.3};
    if (kind == 1) spec.shear_rate = slope().shear_rate;
    const Scene<double> scene(spec);
    const SteadyLogistic state(scene);
    double before = 0;
    for (const std::uint64_t cells : {100u, 200u}) {
      SolverRequest request;
      request.times = {std::numeric_limits<double>::infinity()};
      request.heights = {0.1, 0.3, 0.5, 0.7, 0.9};
      const auto solution = solve<CrankNicolsonSolver>(scene, request, {.cells = cells});
      ASSERT_TRUE(solution.summary.usable());
      double worst = 0;
      for (std::size_t i = 0; i < request.heights.size(); ++i)
        worst = std::max(worst, std::abs(solution.samples[i].phi - state.at(request.heights[i]).phi));
      if (before > 0) {
        EXPECT_LT(worst, before / 2.5) << kind;
      }
      before = worst;
    }
    EXPECT_LT(before, 2e-3) << kind;
  }
}

TEST(SteadyLogistic, IsAskedForByAnOption) {
  const Scene<double> scene(slope());
  EXPECT_NE(ColeHopfSolver::refusal(scene, {}), "");
  EXPECT_EQ(ColeHopfSolver::refusal(scene, {.steady = true}), "");
  const auto run = ColeHopfSolver::start(scene, {.steady = true}, {});
  EXPECT_EQ(run->advance(1), Status::unsupported);
  const auto other = ColeHopfSolver::start(scene, {.steady = true}, {});
  ASSERT_EQ(other->advance(std::numeric_limits<double>::infinity()), Status::ok);
  EXPECT_NEAR(other->field().at(0.5).phi, 0.496238969738, 1e-10);
}

TEST(SteadyLogistic, RefusesWithASentence) {
  auto spec = slope();
  spec.diffusion.reset();
  EXPECT_EQ(SteadyLogistic::refusal(Scene<double>(spec)), "grains do not diffuse in this bed (no D > 0)");
  spec = slope();
  spec.solid_fraction = Piecewise<double>{{}, {0.6}};
  EXPECT_EQ(SteadyLogistic::refusal(Scene<double>(spec)), "a steady state in closed form needs c = 1");
}

}  // namespace
}  // namespace shearfront
