// SPDX-License-Identifier: BSD-3-Clause
// Numbers of rheology from synthetic bins: what data tell, how sure, and what they cannot tell.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

using namespace shearfront::support;

SceneSpec<double> bed(DepthFunction<double> rate) {
  SceneSpec<double> scene;
  scene.initial_breaks = {0.5};
  scene.initial_values = {0, 1};
  scene.shear_rate = std::move(rate);
  return scene;
}
Kinetic<double> kinetic(double length, double load) {
  Kinetic<double> a;
  a.length = length;
  a.load = load;
  a.lid = 1;
  return a;
}
const std::vector<std::string> kKinetic{"shear_rate.amplitude", "shear_rate.length", "shear_rate.load"};

/// Twenty bins at twelve times that grow from `first`.
FitSpec bins(const SceneSpec<double>& truth, double first, double sigma, std::vector<std::string> parameters,
             std::vector<double> start) {
  ObservationPlan plan;
  plan.quantity = Quantity::bin;
  plan.width = 0.05;
  for (int i = 0; i < 12; ++i) plan.times.push_back(first * std::pow(1.6, i));
  for (int i = 0; i < 20; ++i) plan.depths.push_back(0.025 + 0.05 * i);
  FitSpec spec =
      fit_of(truth, observed(truth, plan, sigma, 3, true), std::move(parameters), std::move(start));
  spec.forward.method = Method::of<ExactSolver>({.tolerance = 1e-4});
  return spec;
}

bool warns(const Estimate& estimate, std::string_view text) {
  for (const std::string& warning : estimate.warnings)
    if (warning.find(text) != std::string::npos) return true;
  return false;
}

TEST(FitRheology, FindsAmplitudeLengthAndLoadUnderALightLid) {
  const Estimate e = fit(bins(bed(kinetic(0.2, 0.3)), 0.2, 0.01, kKinetic, {0.8, 0.25, 0.4}));
  ASSERT_TRUE(e.usable());
  const double truth[] = {1, 0.2, 0.3};
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(e.parameters[i].std_error) << e.parameters[i].name;
    EXPECT_NEAR(e.parameters[i].estimate, truth[i], 4 * *e.parameters[i].std_error);
    EXPECT_LT(*e.parameters[i].std_error, 0.2 * truth[i]) << e.parameters[i].name;
  }
}

/// Under a heavy lid w depends on length^2 load alone.
TEST(FitRheology, SaysThatAHeavyLidHidesLengthAndLoad) {
  const Estimate e = fit(bins(bed(kinetic(0.004, 1e4)), 0.3, 0.01, kKinetic, {1, 0.004, 1e4}));
  ASSERT_TRUE(e.usable());
  EXPECT_TRUE(warns(e, "determined") || (warns(e, "shear_rate.load is barely seen")));
  EXPECT_FALSE(e.parameters[1].std_error && *e.parameters[1].std_error < 0.5 * e.parameters[1].estimate);
  const double length = e.parameters[1].estimate, load = e.parameters[2].estimate;
  EXPECT_NEAR(length * length * load, 0.16, 0.016);
  EXPECT_NEAR(e.parameters[0].estimate, 1, 0.05);
}

/// B and E act by one factor, C where pressure is small.
TEST(FitRheology, FindsConstantsOfTheLawWhereTheyShow) {
  Scaling<Exponential<double>> a;
  a.shear = {20, 0.5};
  a.small_diameter = 0.05;
  a.size_ratio = 2;
  a.pressure = 0;
  a.lid = 1;
  const Estimate both = fit(bins(bed(a), 0.2, 0.01, {"shear_rate.B", "shear_rate.C"}, {0.3, 0.4}));
  ASSERT_TRUE(both.usable());
  const double truth[] = {0.3744, 0.2712};
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(both.parameters[i].std_error);
    EXPECT_NEAR(both.parameters[i].estimate, truth[i], 4 * *both.parameters[i].std_error);
  }
  const Estimate one = fit(bins(bed(a), 0.2, 0.01, {"shear_rate.B", "shear_rate.E"}, {0.3, 2}));
  EXPECT_TRUE(warns(one, "determined"));
}

}  // namespace
}  // namespace shearfront::fit
