// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes against the exact solution, and against naive schemes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/cell_states.hpp"
#include "support/checked.hpp"
#include "support/conservative_scheme.hpp"
#include "support/godunov.hpp"
#include "support/printed_engquist_osher.hpp"
#include "support/random_scene.hpp"
#include "support/source_examples.hpp"

namespace shearfront {
namespace {

using support::cell_states;
using support::example_1;
using support::example_2;

/// L1 error of the solver's profile.
template <class Solver>
double l1_error(const Scene<double>& scene, double t, std::size_t n_cells,
                typename Solver::Options options = {}) {
  options.cells = n_cells;
  SolverRequest request{{t}, {}};
  request.profiles = true;
  const SolverResult result = solve<Solver>(scene, request, options);
  return errors_against(ExactSolution<double>(scene), result.profiles.at(0), t).l1;
}

/// The errors of Engquist-Osher in Example 1 as docs/theory/reference-values.md has them, from an independent
/// implementation: rows of cells, error at t = 0.5, error at t = 6.
struct ErrorRow {
  std::size_t cells = 0;
  double early = 0, late = 0;
};
std::vector<ErrorRow> table_of_errors() {
  std::ifstream page(SHEARFRONT_SOURCE_DIR "/docs/theory/reference-values.md");
  std::vector<ErrorRow> rows;
  bool is_inside = false;
  for (std::string line; std::getline(page, line);) {
    if (is_inside && line.empty()) break;
    ErrorRow row;
    if (is_inside && std::sscanf(line.c_str(), "| %zu | %lg | %lg |", &row.cells, &row.early, &row.late) == 3)
      rows.push_back(row);
    if (line == "| cells | t = 0.5 | t = 6 |") is_inside = true;
  }
  return rows;
}

// 5 %: how an error is integrated across a shock inside a cell matters that much.
void expect_errors_of_the_table(std::size_t from, std::size_t to) {
  constexpr double kTolerance = 0.05;
  support::Checked checked({""}, 2);
  const Scene<double> scene = example_1();
  for (const ErrorRow& row : table_of_errors()) {
    if (row.cells < from || row.cells > to) continue;
    EXPECT_NEAR(l1_error<EngquistOsherSolver>(scene, 0.5, row.cells) / row.early, 1, kTolerance) << row.cells;
    EXPECT_NEAR(l1_error<EngquistOsherSolver>(scene, 6, row.cells) / row.late, 1, kTolerance) << row.cells;
    checked.count();
  }
}
TEST(FvErrors, EngquistOsherHasTheErrorsOfAnIndependentImplementation) { expect_errors_of_the_table(1, 999); }
TEST(SlowFvErrors, EngquistOsherHasTheErrorsOfAnIndependentImplementation) {
  expect_errors_of_the_table(1000, 10000);
}

template <class Solver>
class FvConvergence : public testing::Test {};
using Solvers = testing::Types<EngquistOsherSolver, GodunovSolver, MusclSolver>;
TYPED_TEST_SUITE(FvConvergence, Solvers);

template <class Solver>
typename Solver::Options with(bool align_cells) {
  typename Solver::Options options;
  options.align_cells = align_cells;
  return options;
}

// Theory: order 1/2 for any data; a fan costs dz log(1 / dz), shocks cost dz.
template <class Solver>
void expect_orders(bool aligned) {
  const auto order = [&](const Scene<double>& scene, double t) {
    return std::log2(l1_error<Solver>(scene, t, 250, with<Solver>(aligned)) /
                     l1_error<Solver>(scene, t, 1000, with<Solver>(aligned))) /
           2;
  };
  EXPECT_GT(order(example_1(), 0.5), 0.7);
  EXPECT_GT(order(example_1(), 3), 0.8);
  EXPECT_GT(order(example_2(), 0.03), 0.7);
  EXPECT_GT(order(example_2(), 0.6), 0.8);
}
TYPED_TEST(FvConvergence, FansAndShocksOnEqualCells) { expect_orders<TypeParam>(false); }
TYPED_TEST(FvConvergence, FansAndShocksOnAlignedCells) { expect_orders<TypeParam>(true); }

// A fan that bends, from the exact averages at one time to another, away from its edges. (The first steps
// from a jump leave an error of first order in all of the fan.)
double error_inside_a_fan(Limiter limiter, std::size_t n, double begin, double end) {
  const Scene<double> scene = example_2();
  const ExactSolution<double> exact(scene);
  const fv::Grid grid = fv::equal_cells(scene, n);
  const auto average = [&](std::size_t j, double t) {
    return (exact.at(grid.edges[j + 1], t).M - exact.at(grid.edges[j], t).M) / grid.widths[j];
  };
  SceneSpec<double> spec = scene.spec();
  spec.initial_breaks.assign(grid.edges.begin() + 1, grid.edges.end() - 1);
  spec.initial_values.clear();
  for (std::size_t j = 0; j < n; ++j) spec.initial_values.push_back(std::clamp(average(j, begin), 0.0, 1.0));
  fv::March march({fv::Rule::godunov, {}, limiter}, Scene<double>(spec), grid);
  const double dt = march.largest_step(), steps = std::floor((end - begin) / dt);
  for (double i = 0; i < steps; ++i) march.step(dt);
  const fv::CellShares cells = march.shares_after(end - begin - steps * dt);
  double sum = 0, n_inside = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double phi = average(j, end);
    if (phi < 0.2 || phi > 0.8) continue;
    sum += std::abs(cells.x[j] - phi);
    ++n_inside;
  }
  return sum / n_inside;
}

TEST(FvConvergenceMuscl, SecondOrderInsideAFan) {
  for (const Limiter limiter : {Limiter::minmod, Limiter::mc, Limiter::van_leer}) {
    const double coarse = error_inside_a_fan(limiter, 250, 0.015, 0.03);
    const double fine = error_inside_a_fan(limiter, 1000, 0.015, 0.03);
    EXPECT_GE(std::log2(coarse / fine) / 2, 1.9) << int(limiter) << ": " << coarse << ", " << fine;
  }
}

TEST(SlowFvConvergenceMuscl, FirstOrderPastShocks) {
  for (const bool aligned : {false, true}) {
    const double coarse = l1_error<MusclSolver>(example_1(), 6, 200, with<MusclSolver>(aligned));
    const double fine = l1_error<MusclSolver>(example_1(), 6, 3200, with<MusclSolver>(aligned));
    EXPECT_GE(std::log2(coarse / fine) / 4, 0.95) << coarse << ", " << fine;
  }
}

// In a cell next to the jump of a the states adapt to whatever coefficient the face has, and nothing else of
// the solution depends on it.
TEST(FvFaceCoefficient, MattersLittle) {
  EngquistOsherSolver::Options value;
  value.face_coefficient = FaceCoefficient::value;
  for (const std::size_t n : {100u, 400u})
    for (const double t : {0.5, 6.0})
      EXPECT_NEAR(l1_error<EngquistOsherSolver>(example_1(), t, n, value) /
                      l1_error<EngquistOsherSolver>(example_1(), t, n),
                  1, 0.01);
}

TYPED_TEST(FvConvergence, RandomLayersRisingAndFalling) {
  for (std::uint64_t number = 0; number < 12; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    support::SceneMaker maker(support::seed_of(8000 + number));
    const Scene<double> scene(maker.data(maker.integer(2, 6), maker.order(), 4));
    const double t = maker.uniform(0.1, 4);
    const double coarse = l1_error<TypeParam>(scene, t, 100), fine = l1_error<TypeParam>(scene, t, 1600);
    EXPECT_LT(fine, std::max(0.25 * coarse, 1e-3));  // order 1/2
  }
}

// The same cells and rates, another code: interfaces and jumps at edges of cells, where all choices agree.
TEST(FvGodunov, AgreesWithANaiveScheme) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.25, 0.5, 0.75}, {0.5, 2, 1, 4}};
  spec.initial_breaks = {0.125, 0.625};
  spec.initial_values = {0.3, 0.9, 0.1};
  const Scene<double> scene(spec);
  support::ConservativeScheme naive(
      {0, 0.125, 0.25, 0.5, 0.625, 0.75, 1}, [&](double z) { return scene.shear_rate_at(z); },
      [&](double z) { return scene.initial_phi(z); }, 128);
  GodunovSolver::Options options;
  options.cells = 128;
  options.cfl = 0.95;
  const double t = 64 * 0.95 / 128 / 4;  // 64 steps in both
  naive.advance(t * (1 - 1e-15));
  const auto states = cell_states<GodunovSolver>(scene, {t}, options);
  ASSERT_EQ(naive.u.size(), 128u);
  for (std::size_t j = 0; j < 128; ++j) EXPECT_NEAR(states[0][j], naive.u[j], 1e-12) << j;
}

TEST(FvAnyFlux, AgreesWithANaiveSchemeWithoutFormula) {
  SceneSpec<double> spec;
  const Cubic<double> skewed{0.7};
  spec.fluxes = {skewed};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.25, 0.75};
  spec.initial_values = {0.4, 1, 0.2};
  const Scene<double> scene(spec);
  GodunovSolver::Options options;
  options.cells = 100;
  options.cfl = 0.9;
  // 32 steps of the same length in both: the fastest wave is that of f'(0) = -1.
  const double t = 32 * 0.9 / 100;
  const auto states = cell_states<GodunovSolver>(scene, {t}, options);
  const auto naive =
      support::godunov_any_flux([&](double phi) { return skewed.value(phi); }, 1,
                                [&](double z) { return scene.initial_phi(z); }, t * (1 - 1e-15), 100, 40000);
  ASSERT_EQ(naive.size(), states[0].size());
  // Of a flux at most |f''| / (8 40000^2) = 2.7e-10 is missed, 0.9 of that in a cell and step.
  for (std::size_t j = 0; j < naive.size(); ++j) EXPECT_NEAR(states[0][j], naive[j], 32 * 0.9 * 2.7e-10) << j;
}

// What the flux as printed in Buerger, Martinez & Villada (2023) gives: errors of their Table 2, and a mass
// that is not kept.
TEST(FvPrintedFlux, DoesNotConverge) {
  const Scene<double> scene = example_1();
  const ExactSolution<double> exact(scene);
  for (const std::size_t n : {100u, 200u, 400u}) {
    const Profile<double> printed = support::profile_of(scene, support::printed_engquist_osher(scene, 6, n));
    const double error = errors_against(exact, printed, 6.0).l1;
    EXPECT_GT(error, 0.05) << n;
    EXPECT_GT(error, 20 * l1_error<EngquistOsherSolver>(scene, 6, n) * (static_cast<double>(n) / 400)) << n;
    EXPECT_GT(scene.mass() - printed.mass(), 0.3) << n;
    const Profile<double> early = support::profile_of(scene, support::printed_engquist_osher(scene, 0.5, n));
    EXPECT_GT(errors_against(exact, early, 0.5).l1, 0.05) << n;
  }
}

TEST(FvOutcomes, SayWhyThereIsNoResult) {
  const Scene<double> scene = example_1();
  const SolverRequest request{{6}, {0.5}};
  for (const std::uint64_t cells : {std::uint64_t{0}, std::uint64_t{100'000'001}, UINT64_MAX}) {
    GodunovSolver::Options options;
    options.cells = cells;
    const Summary summary = solve<GodunovSolver>(scene, request, options).summary;
    EXPECT_EQ(summary.status, Status::unsupported);
    EXPECT_TRUE(summary.message.starts_with("cells = ")) << summary.message;
  }
  for (const double cfl : {0.0, -1.0, 1.0001, std::numeric_limits<double>::quiet_NaN()}) {
    EngquistOsherSolver::Options options;
    options.cfl = cfl;
    EXPECT_EQ(solve<EngquistOsherSolver>(scene, request, options).summary.status, Status::unsupported);
  }
  GodunovSolver::Options options;
  options.cells = 4000;
  const SolverResult result =
      solve<GodunovSolver>(scene, request, options, [](double t, std::uint64_t) { return t < 3; });
  EXPECT_EQ(result.summary.status, Status::interrupted);
  EXPECT_TRUE(result.samples.empty());
  EXPECT_GT(result.summary.cell_updates, 0u);
}

// A layer in which a step moves less than a rounding: the march rests although the bed does not.
TEST(FvOutcomes, RefuseLayersThatRoundingStops) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 1e-17}};
  spec.initial_breaks = {0.7};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  GodunovSolver::Options options;
  options.cells = 20;
  const auto status = [&](double t) {
    return solve<GodunovSolver>(scene, {{t}, {0.8}}, options).summary.status;
  };
  EXPECT_EQ(status(10), Status::ok);
  EXPECT_EQ(status(1e11), Status::not_converged);
  EXPECT_EQ(status(1e17), Status::budget_reached);
}

TEST(FvOutcomes, HugeTimesEndInTheSteadyState) {
  const SolverRequest request{{1e300, std::numeric_limits<double>::max()}, {0.49, 0.51, 1}};
  const SolverResult result = solve<GodunovSolver>(example_1(), request, {});
  EXPECT_EQ(result.summary.status, Status::steady);
  EXPECT_NEAR(result.samples[0].phi, 1, 1e-12);
  EXPECT_NEAR(result.samples[1].phi, 0, 1e-12);
  EXPECT_NEAR(result.samples[5].M, 0.5, 1e-15);
}

// Work known to be too much is refused before it starts, and steps too small to be added to the time end nowhere.
TEST(FvOutcomes, RefuseWorkThatWouldTakeYears) {
  SceneSpec<double> spec = example_1().spec();
  for (const bool is_ring : {false, true}) {
    spec.is_periodic = is_ring;
    if (!is_ring) spec.outside_bottom = OutsideState<double>{{3e17}, {0.2, 0.7}};
    spec.outside_bottom = is_ring ? std::nullopt : spec.outside_bottom;
    for (const double scale : {1.0, 1e200}) {
      spec.scale = scale;
      const Scene<double> scene(spec);
      for (const double t : {1e18, 1e300}) {
        const SolverResult result = solve<EngquistOsherSolver>(scene, {{t}, {0.5}}, {});
        EXPECT_EQ(result.summary.status, Status::budget_reached);
        EXPECT_EQ(result.summary.cell_updates, 0u);
        EXPECT_NE(result.summary.message.find("1e+15 cell updates"), std::string::npos)
            << result.summary.message;
      }
    }
  }
  spec = example_1().spec();
  spec.scale = 1e300;  // between walls the bed rests soon
  EXPECT_EQ(solve<MusclSolver>(Scene<double>(spec), {{1}, {0.5}}, {}).summary.status, Status::steady);
  // What hardly moves near phi = 1 never rests.
  spec = example_1().spec();
  spec.fluxes = {RichardsonZaki<double>{}};
  GodunovSolver::Options options;
  options.cells = 20;
  EXPECT_EQ(solve<GodunovSolver>(Scene<double>(spec), {{1e300}, {0.5}}, options).summary.status,
            Status::budget_reached);
}

}  // namespace
}  // namespace shearfront
