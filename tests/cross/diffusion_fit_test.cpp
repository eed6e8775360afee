// SPDX-License-Identifier: BSD-3-Clause
// Fits of beds with diffusion: derivatives of the forward model against differences of it, and parameters
// found again from what the same scheme computes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/diffusion/problem_tangents.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/fit/forward.hpp"
#include "shearfront/solution/observe.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

SceneSpec<double> may_bed(double D) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.2913}, {2.4, 0.31}};
  spec.initial_breaks = {0.4968};
  spec.initial_values = {0.1, 0.9};
  spec.diffusion = Diffusion<double>{D, {}, false};
  return spec;
}

/// Of the runs whose derivatives are compared.
constexpr std::uint64_t kCells = 100;

ForwardSpec crank_nicolson(std::uint64_t cells, double time_step) {
  return {Method::of<CrankNicolsonSolver>({.cells = cells, .time_step = time_step})};
}

Parameters parameters_of(const SceneSpec<double>& spec, const std::vector<std::string>& names) {
  return {Scene<double>(spec), {names, {}, {}, {}, Shape::none}};
}

/// Fourth-order difference of column j.
VectorXd difference(const Forward& forward, const VectorXd& at, Index j, double h) {
  const auto values = [&](double by) {
    VectorXd moved = at;
    moved[j] += by;
    const Prediction there = forward.predict(moved, true);  // iterates to rounding
    EXPECT_TRUE(there.is_valid()) << there.failure;
    return there.values;
  };
  return (8 * (values(h) - values(-h)) - (values(2 * h) - values(-2 * h))) / (12 * h);
}

/// max |derivative - difference| of a column over its largest entry.
double disagreement(const Parameters& parameters, const ForwardSpec& forward, Observable field, Index j,
                    double h) {
  std::vector<Place> points;
  for (const double t : {0.03, 0.3, 1.7})
    for (int i = 0; i <= 20; ++i) points.push_back({t, i / 20.0});
  const Forward model(parameters, forward, field, points);
  const VectorXd at = parameters.start();
  const Prediction here = model.predict(at, true);
  EXPECT_TRUE(here.is_valid()) << here.failure;
  const VectorXd numeric = difference(model, at, j, h);
  return (here.derivatives.col(j) - numeric).cwiseAbs().maxCoeff() / numeric.cwiseAbs().maxCoeff();
}

void expect_derivatives(const SceneSpec<double>& spec, const std::vector<std::string>& names,
                        const ForwardSpec& forward) {
  const Parameters parameters = parameters_of(spec, names);
  constexpr double cell = 1.0 / kCells;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const bool is_height = parameters[k].entry.field.ends_with("breaks");
    const double h = is_height ? 3e-3 * cell : 2e-5 * parameters[k].start;
    for (const Observable field : {Observable::phi, Observable::M})
      // phi has kinks where the lines in the cells begin to be cut at 0 or 1, which differences pass.
      EXPECT_LT(disagreement(parameters, forward, field, static_cast<Index>(k), h),
                field == Observable::phi ? 1e-6 : 1e-7)
          << parameters[k].name() << (field == Observable::phi ? " phi" : " M");
  }
}

TEST(DiffusionFit, DerivativesAreThoseOfTheScheme) {
  const std::vector<std::string> names{"shear_rate.values", "shear_rate.breaks", "shear_rate.scale",
                                       "diffusion.D",       "initial.values",    "initial.breaks"};
  expect_derivatives(may_bed(1e-2), names, crank_nicolson(kCells, 0.01));
  SceneSpec<double> with_a = may_bed(0);
  with_a.diffusion = Diffusion<double>{5e-3, {}, true};
  expect_derivatives(with_a, names, crank_nicolson(kCells, 0.01));
  expect_derivatives(
      may_bed(1e-2), names,
      {Method::of<CrankNicolsonSolver>({.cells = kCells, .time_step = 0.01, .monotone = true})});
}

TEST(DiffusionFit, DerivativesOfAnExponentialShearRate) {
  SceneSpec<double> spec = may_bed(1e-2);
  spec.shear_rate = Exponential<double>{4.2, 0.205};
  expect_derivatives(spec, {"shear_rate.amplitude", "shear_rate.decay", "diffusion.D"},
                     crank_nicolson(kCells, 0.01));
}

/// Chosen steps are repeated, so the solution is as smooth as with fixed ones.
TEST(DiffusionFit, DerivativesHoldForChosenSteps) {
  expect_derivatives(may_bed(1e-2), {"shear_rate.values", "shear_rate.scale", "diffusion.D"},
                     {Method::of<CrankNicolsonSolver>({.cells = kCells, .tolerance = 1e-4})});
}

/// r and D of a layered bed in closed form: for faces inside a layer a cell away from the break.
TEST(DiffusionFit, TangentsOfTheCoefficients) {
  SceneSpec<double> spec = may_bed(0);
  spec.shear_rate = Exponential<double>{4.2, 0.205};
  spec.diffusion = Diffusion<double>{5e-3, {}, true};
  spec.scale = 1.3;
  constexpr std::size_t kFew = 50;
  const Parameters parameters =
      parameters_of(spec, {"shear_rate.amplitude", "shear_rate.decay", "shear_rate.scale", "diffusion.D"});
  const auto tangents = diffusion::problem_tangents(parameters.scene(), parameters.entries(), kFew);
  for (std::size_t i = 0; i <= kFew; ++i) {
    const double z = static_cast<double>(i) / kFew, e = std::exp(-z / 0.205), a = 4.2 * e;
    const double by_decay = a * z / (0.205 * 0.205);
    EXPECT_NEAR(tangents[0].rate[i], 1.3 * e, 1e-9 * 1.3);
    EXPECT_NEAR(tangents[0].diffusivity[i], 5e-3 * e, 1e-9 * 5e-3);
    EXPECT_NEAR(tangents[1].rate[i], 1.3 * by_decay, 1e-9 * 1.3 * 8);
    EXPECT_NEAR(tangents[1].diffusivity[i], 5e-3 * by_decay, 1e-9 * 5e-3 * 8);
    EXPECT_NEAR(tangents[2].rate[i], a, 1e-9 * 4.2);
    EXPECT_NEAR(tangents[2].diffusivity[i], 0, 1e-9 * 5e-3);  // the scale moves the flux only
    EXPECT_NEAR(tangents[3].rate[i], 0, 1e-9);
    EXPECT_NEAR(tangents[3].diffusivity[i], a, 1e-9 * 4.2);
  }
}

/// The lines through the cells and their derivative, at slopes that are reduced and others.
TEST(DiffusionFit, TangentsOfTheLinesThroughTheCells) {
  diffusion::Problem problem;
  problem.n_cells = 6;
  const std::vector<double> states{0, 0.02, 0.4, 0.9, 0.99, 0.7}, direction{0, 0.3, -0.2, 0.5, 0.7, -0.1};
  std::vector<double> above = states, below = states;
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < 6; ++i) above[i] += kStep * direction[i], below[i] -= kStep * direction[i];
  const Profile<double> tangent = diffusion::profile_tangent(problem, states, direction);
  const Profile<double> up = diffusion::profile_of(problem, above),
                        down = diffusion::profile_of(problem, below);
  for (int i = 0; i <= 60; ++i) {
    const double z = (i + 0.5) / 61;
    EXPECT_NEAR(tangent.at(z).phi, (up.at(z).phi - down.at(z).phi) / (2 * kStep), 1e-9) << z;
    EXPECT_NEAR(tangent.at(z).M, (up.at(z).M - down.at(z).M) / (2 * kStep), 1e-9) << z;
  }
}

/// Bins of May's bed as the scheme with these settings computes them.
FitSpec bins(double D, const ForwardSpec& forward) {
  SceneSpec<double> spec = may_bed(D);
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  ObservationPlan plan{{0.25, 0.5, 1, 1.5, 2, 3, 4, 6}, {}, Quantity::bin, 0.05};
  for (int i = 0; i < 20; ++i) plan.depths.push_back(0.025 + 0.05 * i);
  FitSpec fit{"",
              scene,
              observe(plan, scene, solve(scene, forward.method, request_of(plan, scene))),
              {{"diffusion.D", "shear_rate.values"}, {3 * D, 1.5, 0.5}, {}, {}, Shape::none},
              forward,
              {},
              {},
              {}};
  return fit;
}

TEST(DiffusionFit, FindsDAndTwoValuesOfAFromBins) {
  for (const double D : {1e-2, 1e-3}) {
    const Estimate estimate = fit(bins(D, crank_nicolson(200, 0.02)));
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    const double truth[] = {D, 2.4, 0.31};
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(estimate.parameters[i].estimate / truth[i], 1, 1e-6) << estimate.parameters[i].name;
  }
}

/// phi is continuous: no point is left out as one a shock may pass.
TEST(DiffusionFit, UsesEveryPoint) {
  FitSpec spec = bins(1e-2, crank_nicolson(50, 0.02));
  ObservationPlan plan{{0.25, 1, 3}, {}, Quantity::point, 0};
  for (int i = 0; i < 20; ++i) plan.depths.push_back(0.025 + 0.05 * i);
  spec.observations =
      observe(plan, spec.scene, solve(spec.scene, spec.forward.method, request_of(plan, spec.scene)));
  add_noise(spec.observations, 0.01, 1);
  const Estimate estimate = fit(spec);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_EQ(estimate.left_out, 0U);
  EXPECT_NEAR(estimate.parameters[0].estimate, 1e-2, 4 * *estimate.parameters[0].std_error);
}

/// 200 data sets with noise 0.02, a few standard deviations of it off the range of phi, half of them fitted
/// without being told the noise: each parameter lies in its interval of 95 % in 95 % of them, within three
/// standard deviations of a count (1.54 %).
TEST(SlowDiffusionFit, IntervalsCoverTheTruth) {
  constexpr std::size_t kReplicates = 200;
  const FitSpec spec = bins(1e-2, crank_nicolson(40, 0.05));
  const double truth[] = {1e-2, 2.4, 0.31};
  std::size_t covered[3] = {};
  for (std::size_t b = 0; b < kReplicates; ++b) {
    FitSpec mine = spec;
    add_noise(mine.observations, 0.02, 20100504, b);
    if (b % 2 == 1)
      for (Observation& o : mine.observations.rows) o.sigma = Observation{}.sigma;
    const Estimate estimate = fit(mine);
    ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_TRUE(estimate.parameters[i].ci95) << b;
      const Interval ci = *estimate.parameters[i].ci95;
      covered[i] += ci.low <= truth[i] && truth[i] <= ci.high ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(static_cast<double>(covered[i]) / kReplicates, 0.95, 0.046) << i;
    RecordProperty("covered_" + std::to_string(i), static_cast<int>(covered[i]));
  }
}

TEST(DiffusionFit, RefusesWhatTheSchemeDoesNotCover) {
  const Parameters parameters = parameters_of(may_bed(1e-2), {"diffusion.D", "domain.top"});
  EXPECT_FALSE(Forward(parameters, crank_nicolson(50, 0), Observable::phi, {}).has_derivatives());
  SceneSpec<double> without = may_bed(0);
  without.diffusion.reset();
  const Parameters hyperbolic = parameters_of(without, {"shear_rate.values"});
  EXPECT_THROW(Forward(hyperbolic, crank_nicolson(50, 0), Observable::phi, {}), InputError);
}

}  // namespace
}  // namespace shearfront::fit
