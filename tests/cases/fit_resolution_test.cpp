// SPDX-License-Identifier: BSD-3-Clause
// The kind of fault: an error that is not noise, left out of the error bars. A fit by front tracking at resolution 0.02
// gave 1.4092 +- 0.0018 for an exponent of 1.4: what the resolution shifts is now less than a third of the error, and
// said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shearfront/fit/resolution_shift.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

SceneSpec<double> settling(double rate, double exponent) {
  SceneSpec<double> scene;
  scene.fluxes = {RichardsonZaki<double>{exponent}};
  scene.shear_rate = Piecewise<double>{{}, {rate}};
  scene.initial_values = {0.6};
  return scene;
}

/// Bins of a settling column, computed at a resolution so fine that its error is far below the noise.
FitSpec column_fit(double resolution) {
  const Scene<double> truth(settling(1, 1.4));
  ObservationPlan plan{{}, {}, Quantity::bin, 0.02};
  for (int i = 1; i <= 12; ++i) plan.times.push_back(0.25 * i);
  for (int i = 0; i < 49; ++i) plan.depths.push_back(0.02 + 0.02 * i);
  Method fine("front-tracking");
  fine.set("resolution", 0.0005);
  Observations data = observe(plan, truth, solve(truth, fine, request_of(plan, truth)));
  add_noise(data, 0.003, 5);
  FitSpec spec =
      support::fit_of(settling(1, 1.4), std::move(data), {"shear_rate.values", "flux.exponent"}, {1.1, 1.6});
  spec.forward.method = Method("front-tracking");
  spec.forward.method.set("resolution", resolution);
  return spec;
}

TEST(FitResolution, ShiftsNoEstimateByMoreThanAThirdOfItsError) {
  const Estimate fine = fit(column_fit(0.001));
  ASSERT_EQ(fine.status, Status::ok) << fine.message;
  for (const double resolution : {0.08, 0.02}) {
    SCOPED_TRACE(resolution);
    const Estimate coarse = fit(column_fit(resolution));
    ASSERT_EQ(coarse.status, Status::ok) << coarse.message;
    bool is_said = false;
    for (const std::string& warning : coarse.warnings)
      is_said = is_said || warning.find("shifts the estimates by up to") != std::string::npos;
    EXPECT_TRUE(is_said);
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(coarse.parameters[i].std_error && fine.parameters[i].std_error);
      // A third for each of the two, and what the difference of two such models leaves to noise.
      EXPECT_LE(std::abs(coarse.parameters[i].estimate - fine.parameters[i].estimate),
                2 * kMostShift * *fine.parameters[i].std_error)
          << coarse.parameters[i].name;
      EXPECT_NEAR(*coarse.parameters[i].std_error / *fine.parameters[i].std_error, 1, 0.25);
    }
  }
}

TEST(FitResolution, HalvesOneOptionAndNoneOfExactMethods) {
  Method tracking("front-tracking");
  tracking.set("resolution", 0.02);
  const auto finer_tracking = finer(tracking);
  ASSERT_TRUE(finer_tracking);
  EXPECT_EQ(finer_tracking->option, "resolution");
  EXPECT_EQ(finer_tracking->now, 0.01);
  const auto finer_cells = finer(Method("godunov"));
  ASSERT_TRUE(finer_cells);
  EXPECT_EQ(finer_cells->option, "cells");
  EXPECT_EQ(finer_cells->now, 2 * finer_cells->before);
  EXPECT_FALSE(finer(Method("exact")));
}

}  // namespace
}  // namespace shearfront::fit
