// SPDX-License-Identifier: BSD-3-Clause
// Intervals of parameters whose neighbour is at a bound.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/solution/observe.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/table_bed.hpp"

namespace shearfront::fit {
namespace {

/// Bins of the bed of 42 mm with 1 % noise, of which the lowest rate is hardly seen, and its start for a fit of all twelve.
FitSpec twelve_rates(std::uint64_t replicate) {
  const SceneSpec<double> truth = support::bed_of_42_mm();
  const Scene<double> scene(truth);
  ObservationPlan plan{{}, {}, Quantity::bin, 0};
  for (int i = 0; i < 40; ++i) plan.times.push_back(20 * std::pow(1.12, i));
  for (int i = 0; i < 42; ++i) plan.depths.push_back(0.5 + i);
  plan.width = 1;
  FitSpec spec{"", scene, observe(plan, scene, solve(scene, Method(), request_of(plan, scene))), {}, {}, {},
               {}, {}};
  spec.unknown.parameters = {"shear_rate.values"};
  for (const double z : std::get<Table<double>>(truth.shear_rate).z)
    spec.unknown.start.push_back(0.4 * std::exp(-z / 16));
  add_noise(spec.observations, 0.01, 20100504, replicate);
  return spec;
}

/// In one fit of ten the lowest rate ends at its lower bound. With it taken as known the interval of the second misses the truth.
TEST(SlowFitBounds, WhatANeighbourAtABoundLeavesOpenIsNotTakenAsKnown) {
  const FitSpec spec = twelve_rates(24);
  const std::vector<double> truth = std::get<Table<double>>(support::bed_of_42_mm().shear_rate).values;
  const Estimate e = fit(spec);
  ASSERT_TRUE(e.parameters[0].at_bound);
  ASSERT_TRUE(e.parameters[0].profile95 && e.parameters[1].profile95);
  EXPECT_TRUE(std::isnan(e.parameters[0].profile95->low));
  EXPECT_GT(e.parameters[0].profile95->high, truth[0]);
  EXPECT_FALSE(e.parameters[1].ci95 || e.parameters[1].std_error);
  EXPECT_LT(e.parameters[1].profile95->low, truth[1]);
  EXPECT_GT(e.parameters[1].profile95->high, truth[1]);
  EXPECT_TRUE(std::isnan(e.correlation(1, 2)));
  for (const std::size_t far : {5u, 6u, 7u, 8u, 9u, 10u, 11u}) {
    EXPECT_TRUE(e.parameters[far].ci95) << far;
    EXPECT_FALSE(e.parameters[far].profile95) << far;
  }
  bool says_so = false;
  for (const std::string& warning : e.warnings)
    says_so = says_so || warning.find("only the profile interval is given") != std::string::npos;
  EXPECT_TRUE(says_so);

  FitSpec known = spec;
  SceneSpec<double> at_bound = spec.scene.spec();
  std::get<Table<double>>(at_bound.shear_rate).values[0] = e.parameters[0].estimate;
  known.scene = Scene<double>(at_bound);
  known.unknown.parameters.clear();
  for (int i = 1; i < 12; ++i)
    known.unknown.parameters.push_back("shear_rate.values[" + std::to_string(i) + "]");
  known.unknown.start.erase(known.unknown.start.begin());
  const Estimate narrow = fit(known);
  ASSERT_TRUE(narrow.parameters[0].ci95);
  EXPECT_GT(narrow.parameters[0].ci95->low, truth[1]);
}

/// Where a rate hardly matters any longer the misfit is level in its logarithm: a search that has come there is not at the minimum, which lies
/// near the truth.
TEST(SlowFitBounds, ALevelPlaceNextToABoundIsLeft) {
  const FitSpec spec = twelve_rates(38);
  const std::vector<double> truth = std::get<Table<double>>(support::bed_of_42_mm().shear_rate).values;
  const Estimate e = fit(spec);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_FALSE(e.parameters[i].at_bound) << i;
    ASSERT_TRUE(e.parameters[i].ci95) << i;
  }
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_LT(e.parameters[i].ci95->low, truth[i]);
    EXPECT_GT(e.parameters[i].ci95->high, truth[i]);
  }
}

}  // namespace
}  // namespace shearfront::fit
