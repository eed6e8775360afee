// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "support/fit_scenes.hpp"

/// What needs many fits: error bars against the scatter of estimates, and the valleys of noisy bins.
namespace shearfront::fit {
namespace {

using namespace shearfront::support;

const std::vector<double> kTenths{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};

/// Standard error over scatter of log(estimate), per parameter, for data refitted with fresh noise.
std::vector<double> stated_over_scatter(FitSpec spec, const std::vector<double>& truth, double sigma, int n) {
  std::vector<double> squares(truth.size()), stated(truth.size());
  const Observations exact = spec.observations;
  spec.unknown.start = truth;
  for (int b = 0; b < n; ++b) {
    spec.observations = exact;
    add_noise(spec.observations, sigma, 17, static_cast<std::uint64_t>(b));
    const Estimate e = fit(spec);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      squares[i] += std::pow(std::log(e.parameters[i].estimate / truth[i]), 2);
      stated[i] += std::pow(e.parameters[i].std_error.value_or(0) / e.parameters[i].estimate, 2);
    }
  }
  for (std::size_t i = 0; i < truth.size(); ++i) stated[i] = std::sqrt(stated[i] / squares[i]);
  return stated;
}

// The scatter of 400 estimates is known to 3.5 %.
constexpr int kReplicates = 400;
constexpr double kTolerance = 0.12;

TEST(SlowFitMonteCarlo, ErrorBarsAreTheScatterOfTheEstimates) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  for (const Quantity quantity : {Quantity::bin, Quantity::cumulative})
    for (const char* compared : {"bin", "cumulative"})
      for (const char* loss : {"squared", "huber"}) {
        SCOPED_TRACE(std::string(name_of(quantity)) + " as " + compared + ", " + loss);
        const ObservationPlan plan{{0.5, 1, 2, 3}, kTenths, quantity, quantity == Quantity::bin ? 0.1 : 0};
        FitSpec spec = fit_of(truth, observed(truth, plan, 0, 1, false), {"shear_rate.values"});
        spec.misfit.quantity = compared;
        spec.misfit.loss = loss;
        for (const double ratio : stated_over_scatter(spec, {3.15, 0.5}, 1e-3, kReplicates))
          EXPECT_NEAR(ratio, 1, kTolerance);
      }
}

// Five layers, 99 bins: a kink wherever a shock enters a bin, and a minimum next to most kinks. Replicates
// that a search straight from the sums leaves in a valley higher by 9 to 42 than the one around the truth.
TEST(SlowFitMonteCarlo, NoisyBinsEndInTheLowestValley) {
  const auto truth = small_above_large({0.2, 0.4, 0.6, 0.8}, {3.25, 2.32, 1.63, 1.05, 0.53});
  ObservationPlan plan;
  plan.quantity = Quantity::bin;
  plan.width = 0.01;
  for (int i = 1; i <= 20; ++i) plan.times.push_back(i / 2.0);
  for (int i = 1; i <= 99; ++i) plan.depths.push_back(i / 100.0);
  const Observations exact = observed(truth, plan, 0, 1, false);
  for (const std::uint64_t replicate : {1U, 6U, 39U, 48U}) {
    FitSpec spec = fit_of(truth, exact, {"shear_rate.values"}, {3.3, 2.5, 1.7, 1.1, 0.5});
    add_noise(spec.observations, 0.05, 20100504, replicate);
    const double found = fit(spec).misfit;
    spec.unknown.start = {3.25, 2.32, 1.63, 1.05, 0.53};
    spec.misfit.two_stage = false;
    EXPECT_LT(found, fit(spec).misfit + 1) << replicate;
  }
}

}  // namespace
}  // namespace shearfront::fit
