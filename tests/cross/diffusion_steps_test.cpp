// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/diffusion_problems.hpp"

namespace shearfront::diffusion {
namespace {

using support::Errors;
using Numbers = std::vector<double>;

Problem mixed_bed(double diffusivity) { return support::uniform_problem(1, 200, 1, diffusivity, 0.55); }

Numbers states_at(const Problem& problem, const Options& options, double t) {
  CrankNicolson run(problem, options);
  EXPECT_EQ(run.advance_to(t), Status::ok) << run.message();
  EXPECT_EQ(run.time(), t);
  return {run.states().begin(), run.states().end()};
}

Options fixed(double dt) {
  Options options;
  options.dt = dt;
  return options;
}

Options adaptive(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  return options;
}

TEST(DiffusionSteps, FixedStepsAreOfSecondOrder) {
  const Problem problem = mixed_bed(0.1);
  const Numbers exact = states_at(problem, fixed(1e-4), 0.2);
  double last = 0;
  for (const double dt : {8e-3, 4e-3, 2e-3}) {
    const double error = Errors(states_at(problem, fixed(dt), 0.2), exact, problem.width()).max;
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.2) << dt;
    }
    last = error;
  }
}

TEST(DiffusionSteps, AdaptiveErrorFollowsTheTolerance) {
  for (const double diffusivity : {0.5, 0.1, 0.02}) {
    const Problem problem = mixed_bed(diffusivity);
    CrankNicolson fine(problem, adaptive(1e-7));
    for (const double t : {0.05, 0.3, 1.0}) {
      fine.advance_to(t);
      double errors[2];
      for (int i = 0; i < 2; ++i) {
        const double tolerance = i == 0 ? 1e-3 : 1e-5;
        errors[i] = Errors(states_at(problem, adaptive(tolerance), t), fine.states(), problem.width()).max;
        EXPECT_LE(errors[i], tolerance) << diffusivity << ' ' << t;
      }
      const double exponent = std::log(errors[0] / errors[1]) / std::log(100.0);
      EXPECT_NEAR(exponent, 1, 0.25) << diffusivity << ' ' << t;
    }
  }
}

TEST(DiffusionSteps, AdaptiveRunsComeToRest) {
  for (const double diffusivity : {0.5, 0.02, 0.005}) {
    CrankNicolson run(mixed_bed(diffusivity), adaptive(1e-4));
    EXPECT_EQ(run.advance_to(std::numeric_limits<double>::infinity()), Status::steady) << run.message();
    EXPECT_TRUE(run.is_steady());
    EXPECT_LE(run.n_steps(), 5000);
    // The logistic profile with the mass 0.55: phi = 1 / (1 + exp((z - m) / D)) up to exp(-1 / D).
    if (diffusivity < 0.1) {
      for (std::size_t j = 0; j < 200; ++j) {
        const double z = (static_cast<double>(j) + 0.5) / 200;
        EXPECT_NEAR(run.states()[j], 1 / (1 + std::exp((z - 0.55) / diffusivity)),
                    0.01 * std::pow(0.005 / diffusivity, 2) + 1e-4)
            << diffusivity << ' ' << z;
      }
    }
  }
}

TEST(DiffusionSteps, ABedAtRestStaysThere) {
  Problem problem = mixed_bed(0.1);
  problem.ends = Ends::periodic;
  CrankNicolson run(problem, adaptive(1e-3));
  EXPECT_EQ(run.advance_to(5), Status::steady);
  for (const double phi : run.states()) EXPECT_EQ(phi, 0.55);
}

TEST(DiffusionSteps, CanBeRepeated) {
  const Problem problem = mixed_bed(0.02);
  CrankNicolson first(problem, adaptive(1e-3)), second(problem, adaptive(1e-3));
  first.advance_to(0.1);
  first.advance_to(0.7);
  EXPECT_EQ(second.repeat(first.steps()), Status::ok);
  EXPECT_NEAR(second.time(), first.time(), 1e-12);
  // Rejected steps leave other predictions, not other solutions of the steps.
  EXPECT_LE(Errors(first.states(), second.states(), problem.width()).max, 1e-9);
}

TEST(DiffusionSteps, SmoothedStartsDoNotRing) {
  // Steps 2500 times as long as the grid resolves: dt D = 2500 dz^2.
  const Problem problem = support::uniform_problem(1, 1000, 1, 0.5, 0.55);
  Options plain = fixed(5e-3);
  plain.smoothed_steps = 0;
  const Numbers exact = states_at(problem, adaptive(1e-6), 0.05);
  const double ringing = Errors(states_at(problem, plain, 0.05), exact, problem.width()).max;
  const double smoothed = Errors(states_at(problem, fixed(5e-3), 0.05), exact, problem.width()).max;
  EXPECT_LE(smoothed, 2e-4);
  EXPECT_GE(ringing, 20 * smoothed);
}

// phi^{n+1} - phi^n + dt (F_{j+1} - F_j) / dz = 0 with F at the mean of phi^n and phi^{n+1}, whatever the iteration.
TEST(DiffusionSteps, SolveTheEquationsOfTheScheme) {
  for (const double diffusivity : {0.5, 0.02}) {
    const Problem problem = mixed_bed(diffusivity);
    const std::size_t n = problem.n_cells;
    Options options = fixed(2e-3);
    options.iteration_tolerance = 1e-13;
    options.smoothed_steps = 0;
    CrankNicolson run(problem, options);
    const auto rule = FaceRule::make(problem, Scheme::central);
    FaceFluxes fluxes(n + 1);
    for (int i = 1; i <= 50; ++i) {
      const Numbers before(run.states().begin(), run.states().end());
      ASSERT_EQ(run.advance_to(i * options.dt), Status::ok) << run.message();
      ASSERT_EQ(run.n_steps(), static_cast<std::uint64_t>(i));
      Numbers v(n + 2);
      for (std::size_t j = 0; j < n; ++j) v[j + 1] = (before[j] + run.states()[j]) / 2;
      v[0] = v[1], v[n + 1] = v[n];
      rule->evaluate(v.data(), fluxes);
      for (std::size_t j = 0; j < n; ++j)
        ASSERT_NEAR(run.states()[j] - before[j] + run.step() * (fluxes.value[j + 1] - fluxes.value[j]), 0,
                    1e-12)
            << i << ", cell " << j;
    }
  }
}

TEST(DiffusionSteps, StopWithAReason) {
  Options options = fixed(1e-3);
  options.max_steps = 7;
  CrankNicolson few(mixed_bed(0.1), options);
  EXPECT_EQ(few.advance_to(1), Status::budget_reached);
  EXPECT_NEAR(few.time(), 7e-3, 2e-3);
  EXPECT_FALSE(few.message().empty());

  options = fixed(1e-3);
  options.progress = [](double t, std::uint64_t) { return t < 0.1; };
  CrankNicolson stopped(mixed_bed(0.1), options);
  EXPECT_EQ(stopped.advance_to(1), Status::interrupted);

  // Central fluxes at a cell Peclet number of 10^4, which no step makes stable.
  CrankNicolson wild(support::uniform_problem(1, 20, 2, 1e-5, 0.5), fixed(1));
  EXPECT_EQ(wild.advance_to(50), Status::not_converged);
  EXPECT_NE(wild.message().find("fitted"), std::string::npos) << wild.message();
}

}  // namespace
}  // namespace shearfront::diffusion
