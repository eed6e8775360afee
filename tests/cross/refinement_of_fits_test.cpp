// SPDX-License-Identifier: BSD-3-Clause
// What a fit finds converges with the order of its forward method: M without noise, fitted by every method that promises one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/fit.hpp"
#include "support/checked.hpp"
#include "support/fit_scenes.hpp"
#include "support/random_scene.hpp"
#include "support/refinement.hpp"

namespace shearfront {
namespace {

using support::Convergence;

/// Largest error of the rates of a bed of two layers, relative to them, from M at a few places.
double error_of_fit(const SceneSpec<double>& truth, const Method& method) {
  const ObservationPlan plan{{0.3, 0.8, 1.7}, {0.15, 0.35, 0.55, 0.75}, Quantity::cumulative, 0};
  const auto& rate = std::get<Piecewise<double>>(truth.shear_rate);
  std::vector<double> start;
  for (const double a : rate.values) start.push_back(1.1 * a);
  fit::FitSpec spec =
      support::fit_of(truth, support::observed(truth, plan, 0, 1, false), {"shear_rate.values"}, start);
  spec.forward.method = method;
  const fit::Estimate estimate = fit::fit(spec);
  EXPECT_TRUE(estimate.usable()) << estimate.message;
  double largest = 0;
  for (std::size_t i = 0; i < estimate.parameters.size(); ++i)
    largest = std::max(largest, std::abs(estimate.parameters[i].estimate / rate.values[i] - 1));
  return largest;
}

void check(int n_scenes, int n_levels) {
  support::Checked checked;
  for (const support::RefinedMethod& method : support::refined_methods())
    for (int number = 0; number < n_scenes; ++number) {
      support::SceneMaker make(support::seed_of(9300 + static_cast<std::uint64_t>(number)));
      const SceneSpec<double> truth =
          support::small_above_large({make.uniform(0.3, 0.7)}, {make.uniform(0.5, 2), make.uniform(0.5, 2)});
      const Scene<double> scene(truth);
      const support::PromisedOrders orders(method, scene);
      if (orders.M == 0 || method.is_linear || !method.at(0).refusal(scene).empty()) continue;
      SCOPED_TRACE(method.name() + ", scene " + std::to_string(number));
      Convergence errors{orders.M, 1e-9, 0.25 * std::pow(0.08, orders.M), {}};
      for (int level = 0; level < n_levels; ++level)
        errors.errors.push_back(error_of_fit(truth, method.at(level)));
      checked.count();
      std::string text;
      for (const double error : errors.errors) text += " " + number_text(error, 3);
      EXPECT_TRUE(errors.shows_order(2) || errors.comes_to_order()) << "errors" << text;
    }
}

TEST(RefinementOfFits, ShowsTheOrderOfM) { check(1, 4); }
TEST(SlowRefinementOfFits, ShowsTheOrderOfM) { check(8, 5); }

}  // namespace
}  // namespace shearfront
