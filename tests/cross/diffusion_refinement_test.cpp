// SPDX-License-Identifier: BSD-3-Clause
// Unequal cells, and cells that follow the fronts of a bed with diffusion: order, closed forms, mass, bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/refinement.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/diffusion_problems.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using diffusion::CrankNicolson;
using diffusion::Problem;
using support::SceneMaker;
using support::seed_of;

/// The travelling kink at t = 2 on cells of the widths h, h / 2, h / 4, h / 2, ... in six parts of [-1, 1]:
/// largest error of a mean.
double kink_error_on_unequal_cells(std::size_t n) {
  Problem p;
  p.bottom = -1;
  p.top = 1;
  p.ends = diffusion::Ends::neumann;
  p.faces = {-1};
  for (const auto& [end, parts] : {std::pair{-0.6, 1}, {-0.35, 2}, {-0.2, 4}, {0.1, 2}, {0.4, 4}, {1.0, 1}}) {
    const double begin = p.faces.back();
    const auto m = static_cast<std::size_t>(std::lround((end - begin) * static_cast<double>(n) * parts));
    for (std::size_t i = 1; i <= m; ++i)
      p.faces.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(m));
  }
  p.n_cells = p.faces.size() - 1;
  p.rate.assign(p.n_cells + 1, 1);
  p.diffusivity.assign(p.n_cells + 1, 0.01);
  const auto means = [&](double t) {
    std::vector<double> all;
    for (std::size_t j = 0; j < p.n_cells; ++j)
      all.push_back(diffusion::support::mean_over(p.face(j), p.face(j + 1),
                                                  [&](double y) { return diffusion::support::kink(y, t); }));
    return all;
  };
  p.initial = means(0);
  diffusion::Options options;
  options.dt = 0.5 / static_cast<double>(n);
  CrankNicolson run(p, options);
  EXPECT_EQ(run.advance_to(2), Status::ok) << run.message();
  const std::vector<double> exact = means(2);
  double largest = 0;
  for (std::size_t j = 0; j < exact.size(); ++j)
    largest = std::max(largest, std::abs(run.states()[j] - exact[j]));
  return largest;
}

TEST(DiffusionRefinement, UnequalCellsAreOfSecondOrder) {
  double last = kink_error_on_unequal_cells(200);
  for (const std::size_t n : {400u, 800u, 1600u}) {
    const double error = kink_error_on_unequal_cells(n);
    EXPECT_NEAR(std::log2(last / error), 2, 0.06) << n;
    last = error;
  }
}

SceneSpec<double> uniform_start(double D) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.55};
  spec.diffusion = Diffusion<double>{D, {}, false};
  return spec;
}

// The number of cells for an error does not depend on D: widths follow fronts.
TEST(DiffusionRefinement, ErrorFollowsTheToleranceForEveryD) {
  const std::vector<double> times{0.3, 1.2, 2.5};
  for (const double D : {2e-2, 2e-3, 5e-4}) {
    const Scene<double> scene(uniform_start(D));
    double last = 0;
    for (const double tolerance : {1e-2, 2.5e-3}) {
      CrankNicolsonSolver::Options options;
      options.cells = 100;
      options.cell_tolerance = tolerance;
      options.tolerance = 0.1 * tolerance;
      const auto grid = solve<CrankNicolsonSolver>(scene, {times, {}, false, false, true}, options);
      ASSERT_EQ(grid.profiles.size(), times.size()) << grid.summary.message;
      double error = 0;
      for (std::size_t i = 0; i < times.size(); ++i) {
        const std::vector<double>& z = grid.profiles[i].z();
        const auto exact = solve<ColeHopfSolver>(scene, {{times[i]}, z, false, false, false});
        ASSERT_EQ(exact.samples.size(), z.size());
        for (std::size_t j = 0; j + 1 < z.size(); ++j) {
          const double amount = exact.samples[j + 1].M - exact.samples[j].M;
          const double mean = (grid.profiles[i].below()[j] + grid.profiles[i].above()[j]) / 2;
          // M of the closed form has 1e-13, which narrow cells magnify.
          error = std::max(error, std::abs(mean - amount / (z[j + 1] - z[j])));
        }
        EXPECT_LE(z.size(), 1500u);
        EXPECT_NEAR(grid.profiles[i].mass(), 0.55, 1e-13);
      }
      EXPECT_LE(error, tolerance) << D;
      if (last > 0) {
        EXPECT_GE(last / error, 2.5) << D;
      }
      last = error;
    }
  }
}

/// Layers between walls, steps of phi, D over three decades.
SceneSpec<double> random_diffusive_bed(SceneMaker& maker) {
  SceneSpec<double> spec;
  Piecewise<double> rate;
  rate.values.push_back(maker.uniform(0.1, 3));
  for (int i = maker.integer(0, 3); i > 0; --i) {
    rate.breaks.push_back((rate.breaks.empty() ? 0 : rate.breaks.back()) + maker.uniform(0.05, 0.25));
    rate.values.push_back(maker.uniform(0.1, 3));
  }
  spec.shear_rate = rate;
  spec.initial_values.push_back(maker.integer(0, 1));
  for (int i = maker.integer(0, 3); i > 0; --i) {
    spec.initial_breaks.push_back((spec.initial_breaks.empty() ? 0 : spec.initial_breaks.back()) +
                                  maker.uniform(0.05, 0.25));
    spec.initial_values.push_back(maker.uniform(0, 1));
  }
  spec.diffusion = Diffusion<double>{std::pow(10, maker.uniform(-4, -1)), {}, false};
  return spec;
}

TEST(DiffusionRefinement, KeepsMassAndBoundsAtEveryStep) {
  std::size_t n_grids = 0;
  for (std::uint64_t number = 0; number < 24; ++number) {
    SceneMaker maker(seed_of(600 + number));
    const Scene<double> scene(random_diffusive_bed(maker));
    const bool is_fitted = number % 2 == 0;
    diffusion::Refinement refinement(scene, static_cast<std::size_t>(maker.integer(4, 100)),
                                     std::pow(10, maker.uniform(-3, -1)));
    diffusion::Options options;
    options.tolerance = std::pow(10, maker.uniform(-3, -1));
    options.scheme = is_fitted ? diffusion::Scheme::fitted : diffusion::Scheme::central;
    options.regrid = [&](const Problem& present, std::span<const double> states) {
      auto next = refinement.next(present, states);
      n_grids += next ? 1 : 0;
      return next;
    };
    const CrankNicolson* running = nullptr;
    const double mass = scene.initial_amount(0, 1);
    double drift = 0, beyond = 0;
    options.progress = [&](double, std::uint64_t steps) {
      CompensatedSum<double> sum;
      for (std::size_t j = 0; j < running->states().size(); ++j) {
        sum += running->states()[j] * running->problem().width(j);
        beyond = std::max({beyond, -running->states()[j], running->states()[j] - 1});
      }
      drift = std::max(drift, std::abs(sum.value() - mass));
      return steps < 150;
    };
    CrankNicolson run(refinement.start(), options);
    running = &run;
    run.advance_to(10);
    EXPECT_LE(drift, 1e-13) << "seed " << seed_of(600 + number);
    if (is_fitted) {
      EXPECT_LE(beyond, 1e-14) << "seed " << seed_of(600 + number);
    }
  }
  EXPECT_GT(n_grids, 300u);
}

TEST(DiffusionRefinement, AgreesWithEqualCells) {
  for (std::uint64_t number = 0; number < 12; ++number) {
    SceneMaker maker(seed_of(700 + number));
    SceneSpec<double> spec = random_diffusive_bed(maker);
    spec.diffusion->D = std::pow(10, maker.uniform(-2.5, -1));
    const Scene<double> scene(spec);
    CrankNicolsonSolver::Options options;
    options.tolerance = 1e-4;
    options.cells = 4000;
    const SolverRequest request{{0.1, 0.7, 4}, {0.1, 0.33, 0.5, 0.77, 0.9}, false, false, false};
    const auto equal = solve<CrankNicolsonSolver>(scene, request, options);
    options.cells = 100;
    options.cell_tolerance = 1e-3;
    const auto refined = solve<CrankNicolsonSolver>(scene, request, options);
    ASSERT_TRUE(equal.summary.usable() && refined.summary.usable()) << refined.summary.message;
    for (std::size_t i = 0; i < equal.samples.size(); ++i) {
      EXPECT_NEAR(refined.samples[i].phi, equal.samples[i].phi, 1e-3) << "seed " << seed_of(700 + number);
      EXPECT_NEAR(refined.samples[i].M, equal.samples[i].M, 1e-4) << "seed " << seed_of(700 + number);
    }
  }
}

SceneSpec<double> step_at(double z, double rate, double D) {
  SceneSpec<double> spec = uniform_start(D);
  spec.shear_rate = Piecewise<double>{{}, {rate}};
  spec.initial_breaks = {z};
  spec.initial_values = {0, 1};
  return spec;
}

// phi = (1 + erf(x)) / 2, x = (z - z0) / sqrt(4 D t), until the walls are felt: wider than any front there
// is.
TEST(DiffusionRefinement, ResolvesStepsThatOnlyDiffuse) {
  struct Case {
    double D, t;
  };
  for (const auto& [D, t] : {Case{1e-4, 1}, Case{0.1, 1e-3}, Case{1e-2, 0.1}}) {
    CrankNicolsonSolver::Options options;
    options.cells = 100;
    options.cell_tolerance = options.tolerance = 1e-3;
    std::vector<double> depths;
    for (int i = -4; i <= 4; ++i) depths.push_back(0.513 + 0.5 * i * std::sqrt(D * t));
    const auto result = solve<CrankNicolsonSolver>(Scene<double>(step_at(0.513, 1e-9, D)),
                                                   {{t}, depths, false, false, false}, options);
    ASSERT_EQ(result.samples.size(), depths.size()) << result.summary.message;
    for (std::size_t i = 0; i < depths.size(); ++i)
      EXPECT_NEAR(result.samples[i].phi, 0.5 * (1 + std::erf((depths[i] - 0.513) / std::sqrt(4 * D * t))),
                  3e-3)
          << D;
  }
}

/// Points of a table are edges of cells that no cell may straddle: once the same cells were halved and merged at every step.
TEST(DiffusionRefinement, HundredsOfPointsOfATableCostNoMoreThanTheFunction) {
  SceneSpec<double> spec = step_at(0.5, 1, 0.02);
  const Exponential<double> a{2, 0.4};
  spec.shear_rate = a;
  Table<double> table;
  for (int i = 0; i <= 400; ++i) {
    table.z.push_back(i / 400.0);
    table.values.push_back(a.value(table.z.back()));
  }
  auto of_points = spec;
  of_points.shear_rate = table;
  CrankNicolsonSolver::Options options;
  options.cells = 100;
  options.cell_tolerance = 0.01;
  options.tolerance = 1e-4;
  const SolverRequest request{{1}, {0.2, 0.5, 0.8}, false, false, false};
  const auto smooth = solve<CrankNicolsonSolver>(Scene<double>(spec), request, options);
  const auto points = solve<CrankNicolsonSolver>(Scene<double>(of_points), request, options);
  ASSERT_TRUE(smooth.summary.usable() && points.summary.usable());
  EXPECT_LT(points.summary.cell_updates, 2 * smooth.summary.cell_updates);
  for (std::size_t i = 0; i < request.heights.size(); ++i)
    EXPECT_NEAR(points.samples[i].phi, smooth.samples[i].phi, 1e-3) << request.heights[i];
}

TEST(DiffusionRefinement, SeesDataThatEqualCellsDoNot) {
  SceneSpec<double> spec = step_at(0.25, 1, 1e-3);
  spec.initial_breaks = {0.25, 0.5, 0.75};
  spec.initial_values = {0, 1, 0, 1};
  spec.is_periodic = true;
  CrankNicolsonSolver::Options options;
  options.cells = 2;
  options.cell_tolerance = options.tolerance = 1e-3;
  const SolverRequest request{{0.1}, {0.1, 0.3, 0.6, 0.8}, false, false, false};
  const auto refined = solve<CrankNicolsonSolver>(Scene<double>(spec), request, options);
  options.cells = 4000;
  options.cell_tolerance = 0;
  const auto equal = solve<CrankNicolsonSolver>(Scene<double>(spec), request, options);
  ASSERT_TRUE(refined.summary.usable() && equal.summary.usable()) << refined.summary.message;
  for (std::size_t i = 0; i < request.heights.size(); ++i)
    EXPECT_NEAR(refined.samples[i].phi, equal.samples[i].phi, 3e-3) << request.heights[i];
}

// Whatever the unit of length: the same numbers, or a reason.
TEST(DiffusionRefinement, WorksInAnyUnitOfLength) {
  for (const double unit : {0x1p-500, 0x1p500}) {
    SceneSpec<double> spec = step_at(0.5 * unit, unit, 1e-3 * unit * unit);
    spec.top = unit;
    CrankNicolsonSolver::Options options;
    options.cells = 50;
    options.cell_tolerance = options.tolerance = 1e-2;
    const auto scaled =
        solve<CrankNicolsonSolver>(Scene<double>(spec), {{1}, {0.4 * unit}, false, false, false}, options);
    const auto plain = solve<CrankNicolsonSolver>(Scene<double>(step_at(0.5, 1, 1e-3)),
                                                  {{1}, {0.4}, false, false, false}, options);
    ASSERT_TRUE(scaled.summary.usable() && plain.summary.usable()) << scaled.summary.message;
    EXPECT_NEAR(scaled.samples[0].phi, plain.samples[0].phi, 1e-12);
  }
}

TEST(DiffusionRefinement, SaysWhenHeightsCannotBeToldApart) {
  SceneSpec<double> spec = step_at(1e5 + 0.5, 1, 1e-11);
  spec.bottom = 1e5;
  spec.top = 1e5 + 1;
  CrankNicolsonSolver::Options options;
  options.cell_tolerance = 1e-2;
  const auto result =
      solve<CrankNicolsonSolver>(Scene<double>(spec), {{1e-9}, {1e5 + 0.5}, false, false, false}, options);
  EXPECT_EQ(result.summary.status, Status::budget_reached) << result.summary.message;
}

TEST(DiffusionRefinement, RefusesWhatCannotEnd) {
  CrankNicolsonSolver::Options options;
  options.time_step = 0.01;
  const auto steady = solve<CrankNicolsonSolver>(
      Scene<double>(uniform_start(0.02)),
      {{std::numeric_limits<double>::infinity()}, {0.5}, false, false, false}, options);
  EXPECT_EQ(steady.summary.status, Status::unsupported);
  options.time_step = 0;
  options.cells = 2'000'000;
  options.cell_tolerance = 1e-2;
  EXPECT_NE(CrankNicolsonSolver::refusal(Scene<double>(uniform_start(0.02)), options).find("1000000"),
            std::string::npos);
}

TEST(DiffusionRefinement, SaysWhenItWouldTakeTooManyCells) {
  CrankNicolsonSolver::Options options;
  options.cells = 999'999;
  options.cell_tolerance = 1e-2;
  SceneSpec<double> spec = uniform_start(1e-9);
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const auto result =
      solve<CrankNicolsonSolver>(Scene<double>(spec), {{1}, {0.5}, false, false, false}, options);
  EXPECT_EQ(result.summary.status, Status::budget_reached);
  EXPECT_NE(result.summary.message.find("cell_tolerance"), std::string::npos) << result.summary.message;
  EXPECT_TRUE(result.samples.empty());
}

}  // namespace
}  // namespace shearfront
