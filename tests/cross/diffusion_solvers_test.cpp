// SPDX-License-Identifier: BSD-3-Clause
// The solvers of beds with diffusion, through the interface of all solvers: crank-nicolson against the closed
// forms of cole-hopf, its order, and its limit for D -> 0, front tracking.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"

namespace shearfront {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

SceneSpec<double> uniform(double D, double phi = 0.55) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {phi};
  spec.diffusion = Diffusion<double>{D, {}, false};
  return spec;
}
SceneSpec<double> kink() {
  SceneSpec<double> spec = uniform(0.01);
  spec.initial_values.clear();
  spec.initial_state = KinkInitial<double>{0.75, 0, 0.7, 0.01 / 0.75};
  spec.is_neumann = true;
  return spec;
}
SceneSpec<double> burgers(double mu) {
  SceneSpec<double> spec = uniform(mu);
  spec.fluxes = {Burgers<double>{-2, 2}};
  spec.initial_values.clear();
  spec.top = 2 * std::acos(-1.0);
  spec.initial_state = SineInitial<double>{0.5, 1, spec.top, 0.25};
  spec.is_periodic = true;
  return spec;
}
SceneSpec<double> may(double D) {
  SceneSpec<double> spec = uniform(D);
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

std::vector<double> depths(const Scene<double>& scene) {
  std::vector<double> z;
  for (int i = 0; i <= 40; ++i)
    z.push_back(i == 40 ? scene.top() : scene.bottom() + (scene.top() - scene.bottom()) * i / 40);
  return z;
}

/// Largest differences of phi and M between the two solvers.
std::pair<double, double> distance(const Scene<double>& scene, const std::vector<double>& times,
                                   const CrankNicolsonSolver::Options& options) {
  const SolverRequest request{times, depths(scene), false, false, false};
  const SolverResult grid = solve<CrankNicolsonSolver>(scene, request, options);
  const SolverResult exact = solve<ColeHopfSolver>(scene, request);
  EXPECT_TRUE(grid.summary.usable() && exact.summary.usable())
      << grid.summary.message << exact.summary.message;
  std::pair<double, double> most{0, 0};
  for (std::size_t i = 0; i < std::min(grid.samples.size(), exact.samples.size()); ++i) {
    most.first = std::max(most.first, std::abs(grid.samples[i].phi - exact.samples[i].phi));
    most.second = std::max(most.second, std::abs(grid.samples[i].M - exact.samples[i].M));
  }
  return most;
}

TEST(DiffusionSolvers, AgreeOnEveryClosedForm) {
  for (const SceneSpec<double>& spec :
       {uniform(0.5), uniform(0.1), uniform(0.05, 0.2), kink(), burgers(0.2)}) {
    const Scene<double> scene(spec);
    double last_phi = 1;
    for (const std::size_t cells : {100u, 200u, 400u}) {
      CrankNicolsonSolver::Options options;
      options.cells = cells;
      options.tolerance = 1e-7;
      const auto [phi, M] = distance(scene, {0.2, 0.7, 1.5}, options);
      EXPECT_LT(M, phi + 1e-6);
      if (cells > 100) {
        EXPECT_LT(phi, last_phi / 3.3) << cells;  // second order
      }
      last_phi = phi;
    }
    EXPECT_LT(last_phi, 1e-3);
  }
}

TEST(DiffusionSolvers, AgreeOnEveryClosedFormWithCellsThatFollowFronts) {
  for (const SceneSpec<double>& spec : {uniform(0.5), uniform(0.01, 0.2), kink(), burgers(0.02)}) {
    const Scene<double> scene(spec);
    for (const double cell_tolerance : {1e-2, 1e-3}) {
      CrankNicolsonSolver::Options options;
      options.cells = 20;
      options.cell_tolerance = cell_tolerance;
      options.tolerance = 1e-2 * cell_tolerance;
      const auto [phi, M] = distance(scene, {0.2, 0.7, 1.5}, options);
      EXPECT_LT(phi, cell_tolerance);
      EXPECT_LT(M, 0.1 * cell_tolerance);
    }
  }
}

TEST(DiffusionSolvers, ReachTheSameSteadyState) {
  for (const double D : {0.5, 0.1, 0.05}) {
    CrankNicolsonSolver::Options options;
    options.cells = 400;
    options.tolerance = 1e-6;
    const auto [phi, M] = distance(Scene<double>(uniform(D)), {kForever}, options);
    EXPECT_LT(phi, 1e-4) << D;
    EXPECT_LT(M, 1e-5) << D;
  }
}

TEST(DiffusionSolvers, IntegralsAgree) {
  const Scene<double> scene(uniform(0.1));
  SolverRequest request;
  request.times = {0, 0.3, 1};
  request.integrand = entropy_function();
  CrankNicolsonSolver::Options options;
  options.cells = 800;
  const auto grid = solve<CrankNicolsonSolver>(scene, request, options);
  const auto exact = solve<ColeHopfSolver>(scene, request);
  ASSERT_EQ(grid.integrals.size(), 3u);
  ASSERT_EQ(exact.integrals.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(grid.integrals[i], exact.integrals[i], 1e-4);
}

// A bed turned upside down with the flux of large grains.
TEST(DiffusionSolvers, LargeGrainsRiseAsSmallOnesSink) {
  SceneSpec<double> small = may(1e-2), large = may(1e-2);
  large.fluxes = {Lwr<double>{}};
  large.shear_rate = Piecewise<double>{{1 - 0.29}, {0.31, 2.4}};
  large.initial_values = {1, 0};
  const SolverRequest down{{0.5, 3}, {0.1013, 0.3007, 0.6011, 0.9003}, false, false, false};
  const SolverRequest up{{0.5, 3}, {1 - 0.1013, 1 - 0.3007, 1 - 0.6011, 1 - 0.9003}, false, false, false};
  CrankNicolsonSolver::Options options;
  options.time_step = 2e-3;
  const auto a = solve<CrankNicolsonSolver>(Scene<double>(small), down, options);
  const auto b = solve<CrankNicolsonSolver>(Scene<double>(large), up, options);
  ASSERT_EQ(a.samples.size(), 8u);
  ASSERT_EQ(b.samples.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(a.samples[i].phi, b.samples[i].phi, 1e-8);
}

// Grains driven from the middle to both walls stay symmetric, between 0 and 1, and keep their mass.
TEST(DiffusionSolvers, ChuteIsSymmetricAndBounded) {
  SceneSpec<double> spec = uniform(5e-8, 0.5);
  spec.fluxes = {Quadratic<double>{}, Lwr<double>{}};
  spec.flux_breaks = {0};
  spec.bottom = -0.022, spec.top = 0.022;
  spec.shear_rate = Chute<double>{2.2988e-7, 1 / 280.0, 0};
  const Scene<double> scene(spec);
  SolverRequest request{{1, 10, 100, 1000}, {}, false, false, true};
  CrankNicolsonSolver::Options options;
  options.cells = 1000;
  const auto result = solve<CrankNicolsonSolver>(scene, request, options);
  ASSERT_EQ(result.profiles.size(), 4u) << result.summary.message;
  for (const Profile<double>& p : result.profiles) {
    EXPECT_NEAR(p.mass() / scene.mass(), 1, 1e-13);
    const auto [lo, hi] = std::minmax_element(p.below().begin(), p.below().end());
    EXPECT_GE(*lo, 0);
    EXPECT_LE(*hi, 1);
    for (std::size_t j = 0; j < p.n_cells(); ++j)
      EXPECT_NEAR(p.below()[j], p.above()[p.n_cells() - 1 - j], 1e-9);
  }
}

// As D -> 0 the diffusive bed tends to the one front tracking and the exact engine know. The distance falls
// like D, times the number of fronts and a logarithm.
TEST(DiffusionSolvers, TendToTheHyperbolicSolution) {
  const Scene<double> limit([] {
    SceneSpec<double> spec = may(1);
    spec.diffusion.reset();
    return spec;
  }());
  const ExactSolution<double> exact(limit);
  double last = 1;
  const auto l1 = [&](double D, double t, double tolerance, double cell_tolerance) {
    CrankNicolsonSolver::Options options;
    options.cell_tolerance = cell_tolerance;
    options.tolerance = tolerance;
    const auto result =
        solve<CrankNicolsonSolver>(Scene<double>(may(D)), {{t}, {}, false, false, true}, options);
    EXPECT_EQ(result.profiles.size(), 1u) << result.summary.message;
    return result.profiles.empty() ? 1 : errors_against(exact, result.profiles[0], t).l1;
  };
  for (const double D : {1e-2, 1e-3, 1e-4}) {
    const double now = l1(D, 2, 1e-2, 1e-2);
    EXPECT_LT(now, last / 4) << D;
    last = now;
  }
  last = 1;
  for (const double D : {1e-4, 1e-5, 1e-6}) {  // before there are fronts, which ask for short steps
    const double now = l1(D, 0.5, 1e-5, 1e-3);
    EXPECT_LT(now, last / 6) << D;
    EXPECT_LT(now, 3 * D * std::log(1 / D)) << D;
    last = now;
  }
}

TEST(DiffusionSolvers, EverySolverSaysWhichBedsItTakes) {
  support::Checked checked;
  SolverList::for_each([&]<class S>() { checked.expect(S::kName); });
  SceneSpec<double> still = may(1);
  still.diffusion.reset();
  SceneSpec<double> packed = may(1e-2);
  packed.solid_fraction = Piecewise<double>{{}, {0.6}};
  for (const SceneSpec<double>& spec : {still, may(0), may(1e-2), packed, kink()}) {
    const Scene<double> scene(spec);
    const bool has_diffusion = scene.has_diffusion();
    checked.count();
    SolverList::for_each([&]<class S>() {
      const SolverResult result = solve<S>(scene, {{0.1}, {0.3}, false, false, false});
      const bool is_refused = result.summary.status == Status::unsupported;
      EXPECT_EQ(is_refused, !S::refusal(scene, {}).empty()) << S::kName << result.summary.message;
      if (S::guarantees().diffusion == has_diffusion) return;
      checked.count(S::kName);
      EXPECT_TRUE(is_refused) << S::kName;
      const bool can_be_solved = !has_diffusion || CrankNicolsonSolver::refusal(scene, {}).empty();
      const std::string other = !can_be_solved  ? "no method"
                                : has_diffusion ? "crank-nicolson"
                                                : "front-tracking";
      EXPECT_NE(result.summary.message.find(other), std::string::npos) << S::kName << result.summary.message;
    });
  }
}

}  // namespace
}  // namespace shearfront
