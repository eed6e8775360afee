// SPDX-License-Identifier: BSD-3-Clause
// Beds with diffusion on grids that are too coarse for them, with coefficients that jump, with ends that a closed
// form does not know, and with more work than can be done.
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/diffusion/cole_hopf_kink.hpp"
#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/face_rule.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

using GridOptions = CrankNicolsonSolver::Options;

SceneSpec<double> bed_of_may(double D) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  if (D > 0) spec.diffusion = Diffusion<double>{D, {}, false};
  return spec;
}

std::vector<double> middles(double bottom, double top, int n) {
  std::vector<double> z;
  for (int i = 0; i < n; ++i) z.push_back(bottom + (top - bottom) * (i + 0.5) / n);
  return z;
}

SolverResult on_grid(const Scene<double>& scene, const std::vector<double>& times,
                     const std::vector<double>& heights, const GridOptions& options) {
  SolverResult result = solve<CrankNicolsonSolver>(scene, {times, heights, false, false, false}, options);
  EXPECT_TRUE(result.summary.usable()) << result.summary.message;
  return result;
}

double largest_difference(const SolverResult& a, const SolverResult& b, double Sample::*entry) {
  EXPECT_EQ(a.samples.size(), b.samples.size());
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i)
    most = std::max(most, std::abs(a.samples[i].*entry - b.samples[i].*entry));
  return most;
}

// Kind of fault: a scheme used where it is not stable. With the central flux phi went from -0.17 to 1.07.
TEST(DiffusionCases, CoarseCellsStayInTheRangeAndSayWhatTheyDo) {
  const std::vector<double> z = middles(0, 1, 200), times{0.1, 0.5, 2};
  for (const double D : {1e-3, 1e-6}) {
    for (const std::uint64_t cells : {std::uint64_t{0}, std::uint64_t{60}}) {
      GridOptions options;
      options.cells = cells;
      const SolverResult result = on_grid(Scene<double>(bed_of_may(D)), times, z, options);
      for (const Sample& at : result.samples) {
        EXPECT_GE(at.phi, -1e-5) << D << ' ' << cells;
        EXPECT_LE(at.phi, 1 + 1e-5) << D << ' ' << cells;
      }
      // 1600 cells, the most that are chosen, are as narrow as 1.8 D / (s a) = 7.5e-4 for the first D only.
      EXPECT_EQ(result.summary.remark.empty(), D == 1e-3 && cells == 0) << D << ' ' << cells;
    }
  }
}

// Why they stay in it: F never falls as the state below rises and never rises as the state above does.
TEST(DiffusionCases, RaisedFluxesAreMonotone) {
  constexpr std::size_t kCells = 24;
  constexpr double kRounding = 1e-13;  // of r / dz, 68 at most
  for (const bool is_equal : {true, false})
    for (const double D : {1e-12, 1e-3, 0.02, 0.03, 0.05, 1.0}) {
      diffusion::Problem problem;
      problem.n_cells = kCells;
      problem.diffusivity.assign(kCells + 1, D);
      for (std::size_t i = 0; i <= kCells; ++i) problem.rate.push_back(i % 3 == 0 ? -1.7 : 1.1);
      if (!is_equal) {  // widths 1, 2, 2 in turn
        problem.faces.push_back(0);
        for (std::size_t j = 0; j < kCells; ++j)
          problem.faces.push_back(problem.faces.back() + (j % 3 == 0 ? 1.0 : 2.0) / 40);
        problem.top = problem.faces.back();
      }
      const auto rule = diffusion::FaceRule::make(problem, diffusion::Scheme::raised);
      diffusion::FaceFluxes at(kCells + 1);
      for (std::size_t shift = 0; shift < 7; ++shift) {
        std::vector<double> v;
        for (std::size_t j = 0; j < kCells + 2; ++j)
          v.push_back(static_cast<double>((5 * j + 3 * shift) % 11) / 10);
        v.front() = v[1], v.back() = v[kCells];
        rule->evaluate(v.data(), at);
        for (std::size_t i = 1; i < kCells; ++i) {
          EXPECT_GE(at.by_below[i], -kRounding) << D << ' ' << i;
          EXPECT_LE(at.by_above[i], kRounding) << D << ' ' << i;
        }
      }
    }
  const double tiny = 1e-7;
  for (double p = 0; p < 3; p += 0.01) {
    const double h = diffusion::raised_share(p);
    EXPECT_GE(h, std::max(1.0, p) * (1 - 1e-15)) << p;
    EXPECT_NEAR(diffusion::raised_share(p + tiny) - h, h - diffusion::raised_share(p - tiny), 1e-12) << p;
  }
}

// phi(2, 0.1) = 0.0292 on cells of 1 / 12800 and on cells that follow the fronts; 0.0869 came out.
TEST(DiffusionCases, CoarseCellsFindTheFan) {
  const Scene<double> scene(bed_of_may(1e-4));
  EXPECT_NEAR(on_grid(scene, {2}, {0.1}, {}).phi(0, 0), 0.0292, 1e-4);
  GridOptions coarse;
  coarse.cells = 400;
  EXPECT_NEAR(on_grid(scene, {2}, {0.1}, coarse).phi(0, 0), 0.0292, 5e-4);
}

// Kind of fault: "at rest" concluded from states that hardly change. Without diffusion the bed mixes; 1e-12 is none.
TEST(DiffusionCases, AnUnstableBedIsNotAtRest) {
  const std::vector<double> z = middles(0, 1, 100);
  GridOptions options;
  options.cells = 400;
  const SolverResult result = on_grid(Scene<double>(bed_of_may(1e-12)), {2}, z, options);
  EXPECT_EQ(result.summary.status, Status::ok) << result.summary.message;
  const ExactSolution<double> exact{Scene<double>(bed_of_may(0))};
  for (std::size_t j = 0; j < z.size(); ++j) EXPECT_NEAR(result.M(0, j), exact.at(z[j], 2.0).M, 5e-3) << z[j];
}

/// logit phi = c - int a / D of two pieces, the steady state between walls; M up to z by the closed integral.
class SteadyOfTwo {
 public:
  SteadyOfTwo(double edge, double below, double above, double mass)
      : edge_(edge), below_(below), above_(above) {
    double low = -100, high = 100;
    for (int i = 0; i < 200; ++i) {
      at_edge_ = (low + high) / 2;
      (M(1) > mass ? high : low) = at_edge_;
    }
  }
  [[nodiscard]] double phi(double z) const { return 1 / (1 + std::exp(-logit(z))); }
  [[nodiscard]] double M(double z) const {
    const double lower = std::min(z, edge_), upper = std::max(z, edge_);
    return (softplus(logit(0)) - softplus(logit(lower))) / below_ +
           (softplus(at_edge_) - softplus(logit(upper))) / above_;
  }

 private:
  [[nodiscard]] double logit(double z) const {
    return at_edge_ - (z < edge_ ? below_ : above_) * (z - edge_);
  }
  static double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

  double edge_, below_, above_, at_edge_ = 0;
};

SceneSpec<double> jump_of_both(double edge) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{edge}, {2, 0.2}};
  spec.initial_values = {0.6};
  Diffusion<double> diffusion{0.1, {}, false};
  diffusion.variation = Piecewise<double>{{edge}, {1, 0.4}};
  spec.diffusion = diffusion;
  return spec;
}

// Kind of fault: a mean that is right for one coefficient is not right for two. The order was 1.
TEST(DiffusionCases, SecondOrderWhereRateAndDiffusivityJump) {
  for (const double edge : {0.5, 0.5625, 0.4321}) {
    const Scene<double> scene(jump_of_both(edge));
    const SteadyOfTwo exact(edge, 2 / 0.1, 0.2 / 0.04, 0.6);
    const std::vector<double> z = middles(0, 1, 16);
    double last = 0;
    for (const std::uint64_t cells : {std::uint64_t{64}, std::uint64_t{256}}) {
      GridOptions options;
      options.cells = cells;
      options.tolerance = 1e-8;
      const SolverResult result = on_grid(scene, {std::numeric_limits<double>::infinity()}, z, options);
      double error = 0;
      for (std::size_t j = 0; j < z.size(); ++j)
        error = std::max(error, std::abs(result.M(0, j) - exact.M(z[j])));
      if (last > 0) {
        EXPECT_LT(error, last / 10) << edge;  // 16 if of second order, 4 if of first
      }
      EXPECT_LT(error, 2e-3) << edge;
      last = error;
    }
  }
}

TEST(DiffusionCases, SecondOrderOnTheWayWhereRateAndDiffusivityJump) {
  SceneSpec<double> spec = jump_of_both(0.5);
  spec.shear_rate = Piecewise<double>{{0.5}, {2, 0.2}};
  spec.diffusion = Diffusion<double>{0.02, {}, true};
  const std::vector<double> z = middles(0, 1, 50);
  std::vector<SolverResult> results;
  for (const std::uint64_t cells : {250U, 500U, 1000U}) {
    GridOptions options;
    options.cells = cells;
    options.tolerance = 1e-7;
    results.push_back(on_grid(Scene<double>(spec), {0.2, 1}, z, options));
  }
  EXPECT_LT(largest_difference(results[1], results[2], &Sample::M),
            largest_difference(results[0], results[1], &Sample::M) / 3.5);
}

SceneSpec<double> kink_in(double bottom, double top) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.diffusion = Diffusion<double>{0.01, {}, false};
  spec.initial_state = KinkInitial<double>{0.75, 0, 0.2, 0.01 / 0.75};
  spec.bottom = bottom, spec.top = top;
  spec.is_neumann = true;
  return spec;
}

// Kind of fault: a closed form of the whole line offered for a bed with ends. 0.5389 was "exact to rounding" where
// 0.1136 is right.
TEST(DiffusionCases, AKinkIsGivenOnlyBeforeItMeetsAnEnd) {
  const auto at = [](double bottom, double top, double t) {
    const std::vector<double> z{bottom, top};
    return solve<ColeHopfSolver>(Scene<double>(kink_in(bottom, top)), {{t}, z, false, false, false}).summary;
  };
  EXPECT_EQ(at(-0.5, 0.5, 3).status, Status::unsupported);
  EXPECT_EQ(at(-0.5, 0.5, std::numeric_limits<double>::infinity()).status, Status::unsupported);
  EXPECT_EQ(at(0.15, 0.25, 0.1).status, Status::unsupported);
  EXPECT_TRUE(at(-0.5, 0.5, 2).usable());
  EXPECT_NE(at(-0.5, 0.5, 2).message.find("at most"), std::string::npos);
  EXPECT_EQ(at(-1.5, 1.5, 2).message, "exact to rounding");
}

TEST(DiffusionCases, EndsChangeAKinkByLessThanIsSaid) {
  // The same cells with ends near and far: what differs is what the ends do. Half widths of the near bed, times.
  const struct {
    double bottom, top, t;
  } cases[] = {{-0.5, 0.5, 2}, {-0.25, 0.5, 1}, {-0.05, 0.45, 0.4}, {0, 0.4, 0.1}};
  for (const auto& c : cases) {
    constexpr double kCellsPerUnit = 400;
    GridOptions near, far;
    near.time_step = far.time_step = 2e-3;
    near.cells = static_cast<std::uint64_t>(std::round((c.top - c.bottom) * kCellsPerUnit));
    far.cells = static_cast<std::uint64_t>(4 * kCellsPerUnit);
    // The middles of cells: beside faces rounding may take the line of either side.
    const std::vector<double> z = middles(c.bottom, c.top, static_cast<int>(near.cells));
    const SolverResult bounded = on_grid(Scene<double>(kink_in(c.bottom, c.top)), {c.t}, z, near);
    const SolverResult wide = on_grid(Scene<double>(kink_in(-2, 2)), {c.t}, z, far);
    const diffusion::Kink<double> kink(c.bottom, 1, 0.01, 0.2, -0.25);
    const double change = largest_difference(bounded, wide, &Sample::phi);
    EXPECT_LE(change, kink.end_effect(c.top, c.t) + 1e-7) << c.bottom << ' ' << c.t;
  }
}

// Kind of fault: a count computed from a ratio of doubles. 1e20 steps were none, and the start was the result.
TEST(DiffusionCases, StepsBeyondAllBudgetsAreRefusedBeforeAnyIsMade) {
  const Scene<double> scene(bed_of_may(1e-2));
  for (const double step : {1e-20, 1e-17, 1e-10, 5e-324}) {
    GridOptions options;
    options.time_step = step;
    const SolverResult result =
        solve<CrankNicolsonSolver>(scene, {{1e-9, 1}, {0.5}, false, false, false}, options);
    EXPECT_EQ(result.summary.status, Status::budget_reached) << step;
    EXPECT_EQ(result.summary.cell_updates, 0) << step;
    EXPECT_NE(result.summary.message.find("steps of"), std::string::npos) << result.summary.message;
    std::any memory;
    EXPECT_EQ(CrankNicolsonSolver::linearise(scene, options, {{1, 0.5}}, {}, memory).summary.status,
              Status::budget_reached);
  }
}

// Kind of fault: a step too short to change anything taken for rest.
TEST(DiffusionCases, ShortStepsAreNotRest) {
  diffusion::Problem problem;
  problem.n_cells = 50;
  problem.rate.assign(51, 1);
  problem.diffusivity.assign(51, 0.1);
  problem.initial.assign(50, 0.55);
  diffusion::Options options;
  options.dt = 1e-19;
  options.max_steps = 20;
  diffusion::CrankNicolson run(problem, options);
  EXPECT_EQ(run.advance_to(1), Status::budget_reached);
  EXPECT_FALSE(run.is_steady());
  options.dt = 0.01;
  options.max_steps = 100'000;
  diffusion::CrankNicolson longer(problem, options);
  EXPECT_EQ(longer.advance_to(500), Status::steady);
}

// Kind of fault: an estimate of second order for steps of first order. At the tolerance 1e-5 the error was 6.8e-4.
TEST(DiffusionCases, MonotoneStepsKeepTheTolerance) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 0.6}};
  spec.initial_values = {0.6};
  spec.diffusion = Diffusion<double>{0.05, {}, false};
  const Scene<double> scene(spec);
  const std::vector<double> z = middles(0, 1, 50), times{0.2, 1, 3};
  GridOptions options;
  options.cells = 100;
  options.monotone = true;
  // D dt = dz^2 / 20: of second order, and 1e-4 of the times in which the bed moves.
  options.time_step = 1e-4;
  const SolverResult fine = on_grid(scene, times, z, options);
  options.time_step = 0;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    options.tolerance = tolerance;
    EXPECT_LE(largest_difference(on_grid(scene, times, z, options), fine, &Sample::phi), tolerance);
  }
}

// Kind of fault: two rules that undo each other: cells were halved and merged in turn at every step, 146 s for 0.04 s
// of work. 1600 equal cells have an error of 2.1e-4 here and those that follow fronts 0.8e-4 to 1.9e-4.
TEST(DiffusionCases, CellsThatFollowFrontsCostNoMoreThanTwiceEqualOnes) {
  const Scene<double> scene(bed_of_may(1e-2));
  const std::vector<double> z = middles(0, 1, 200);
  GridOptions equal, reference;
  equal.cells = 1600;
  reference.cells = 4800;
  const SolverResult fine = on_grid(scene, {0.5, 1}, z, reference), even = on_grid(scene, {0.5, 1}, z, equal);
  for (const std::uint64_t cells : {50U, 100U, 400U}) {
    GridOptions options;
    options.cells = cells;
    options.cell_tolerance = 0.01;
    const SolverResult following = on_grid(scene, {0.5, 1}, z, options);
    EXPECT_LE(largest_difference(following, fine, &Sample::phi),
              largest_difference(even, fine, &Sample::phi));
    EXPECT_LE(following.summary.cell_updates, 2 * even.summary.cell_updates) << cells;
  }
}

}  // namespace
}  // namespace shearfront
