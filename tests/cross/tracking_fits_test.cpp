// SPDX-License-Identifier: BSD-3-Clause
// Fits by front tracking with derivatives that fronts carry, where the exact engine does not apply: open ends, fluxes that are not
// convex, beds in metres.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit/forward.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

/// What is to be found, and from where.
struct Found {
  std::string name;
  SceneSpec<double> truth;
  ObservationPlan plan;
  std::vector<std::string> parameters;
  std::vector<double> start, expected;
  double sigma;
};

void PrintTo(const Found& c, std::ostream* out) { *out << c.name; }

std::vector<double> steps(double from, double to, int n) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(from + (to - from) * i / (n - 1));
  return all;
}

/// A road in metres with a red light: the state that comes in changes twice.
Found open_road() {
  SceneSpec<double> road;
  road.fluxes = {Lwr<double>{0.5}};
  road.shear_rate = Piecewise<double>{{}, {20}};
  road.bottom = 100, road.top = 400;
  road.initial_breaks = {180, 300};
  road.initial_values = {0.11, 0.21, 0.16};
  road.outside_bottom = OutsideState<double>{{6, 14}, {0.13, 0.22, 0.09}};
  road.outside_top = OutsideState<double>{{10}, {0.16, 0.38}};
  return {"OpenRoadInMetres",
          road,
          {steps(2, 30, 15), steps(120, 380, 14), Quantity::bin, 20},
          {"shear_rate.values", "flux.jam", "boundary.bottom.values", "boundary.top.breaks"},
          {17, 0.55, 0.12, 0.2, 0.11, 9},
          {20, 0.5, 0.13, 0.22, 0.09, 10},
          0.002};
}

/// Points of a flux that is not convex, in two layers.
Found skewed_points() {
  SceneSpec<double> bed;
  bed.fluxes = {Cubic<double>{0.8}};
  bed.shear_rate = Piecewise<double>{{0.35}, {1.5, 0.6}};
  bed.initial_breaks = {0.5};
  bed.initial_values = {0.15, 0.9};
  return {"PointsOfASkewedFlux",
          bed,
          {steps(0.2, 2, 10), steps(0.03, 0.97, 20), Quantity::point, 0},
          {"shear_rate.values", "shear_rate.breaks", "flux.gamma"},
          {1.2, 0.7, 0.4, 0.6},
          {1.5, 0.6, 0.35, 0.8},
          0.005};
}

/// Kynch's column: the speed of a single sphere and the exponent, in metres and seconds.
Found column() {
  SceneSpec<double> bed;
  bed.fluxes = {RichardsonZaki<double>{4.65}};
  bed.shear_rate = Piecewise<double>{{}, {0.01}};
  bed.top = 0.5;
  bed.initial_values = {0.15};
  return {"KynchColumnWithExponent",
          bed,
          {steps(5, 60, 12), steps(0.0125, 0.4875, 20), Quantity::bin, 0.025},
          {"shear_rate.values", "flux.exponent", "initial.values"},
          {0.013, 4, 0.17},
          {0.01, 4.65, 0.15},
          0.005};
}

/// Amounts below a height, in the two-way traffic of a table of a flux.
Found measured_flux() {
  SceneSpec<double> bed;
  bed.fluxes = {FluxTable<double>{{0, 0.1, 0.4, 0.7, 1}, {0, -0.125, -0.25, -0.0625, 0}}};
  bed.shear_rate = Piecewise<double>{{}, {2}};
  bed.top = 3;
  bed.initial_breaks = {1.3};
  bed.initial_values = {0.2, 0.8};
  return {"AmountsOfAMeasuredFlux",
          bed,
          {steps(0.3, 3, 10), steps(0.2, 2.8, 14), Quantity::cumulative, 0},
          {"shear_rate.values", "initial.breaks", "initial.values"},
          {1.6, 1.4, 0.25, 0.75},
          {2, 1.3, 0.2, 0.8},
          0.003};
}

class TrackingFits : public testing::TestWithParam<Found> {};

TEST_P(TrackingFits, FindWhatMadeTheData) {
  const Found& c = GetParam();
  const Scene<double> truth(c.truth);
  Method fine("front-tracking");
  fine.set("resolution", 0.001);
  Observations data = observe(c.plan, truth, solve(truth, fine, request_of(c.plan, truth)));
  add_noise(data, c.sigma, 11);
  FitSpec spec = support::fit_of(c.truth, std::move(data), c.parameters, c.start);
  spec.forward.method = Method("front-tracking");
  spec.forward.method.set("resolution", 0.01);
  spec.forward.method.prefer_smooth(spec.scene);
  {
    const Parameters parameters(spec.scene, spec.unknown);
    const Forward forward(parameters, spec.forward, Observable::phi, {{1, truth.top()}});
    ASSERT_TRUE(forward.has_derivatives());
  }
  const Estimate estimate = fit(spec);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_EQ(estimate.parameters.size(), c.expected.size());
  // With differences each Jacobian took two runs per unknown.
  EXPECT_LT(estimate.evaluations, 150u);
  for (std::size_t i = 0; i < c.expected.size(); ++i) {
    const ParameterEstimate& p = estimate.parameters[i];
    ASSERT_TRUE(p.std_error.has_value()) << p.name;
    // Noise, and what the resolution shifts, which is less than a third of it.
    EXPECT_NEAR(p.estimate, c.expected[i], 4 * *p.std_error) << p.name;
    EXPECT_LT(*p.std_error, 0.1 * c.expected[i]) << p.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, TrackingFits,
                         testing::Values(open_road(), skewed_points(), column(), measured_flux()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace shearfront::fit
