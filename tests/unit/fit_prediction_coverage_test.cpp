// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/fit/prediction.hpp"
#include "support/fit_scenes.hpp"

/// How often 95 % bands of predictions contain the truth.
namespace shearfront::fit {
namespace {

using namespace shearfront::support;

constexpr int kPredictionReplicates = 500;
constexpr std::size_t kCoverageDraws = 199;  // (n + 1) p whole: no interpolation between draws
constexpr std::size_t kCoveredPlaces = 20;

/// Places of phi in rarefactions: 0 < phi < 1, where pure regions and shocks, whose bands are points or jumps, are not.
struct PlacesInFans {
  std::vector<double> times{0.6, 1.1, 1.7, 2.6}, heights;
  std::vector<std::size_t> samples;
  std::vector<double> truth;
};
PlacesInFans places_in_fans(const Scene<double>& scene) {
  PlacesInFans places;
  for (int i = 1; i < 40; ++i) places.heights.push_back(i / 40.0 + 0.003);
  SolverRequest request;
  request.times = places.times;
  request.heights = places.heights;
  const SolverResult at = solve(scene, Method(), request);
  std::vector<std::size_t> all;
  for (std::size_t i = 1; i + 1 < at.samples.size(); ++i) {
    const auto phi = [&](std::size_t k) { return at.samples[k].phi; };
    const bool is_smooth = std::abs(phi(i + 1) - phi(i)) < 0.12 && std::abs(phi(i) - phi(i - 1)) < 0.12;
    if (phi(i) > 0.08 && phi(i) < 0.92 && is_smooth) all.push_back(i);
  }
  for (std::size_t k = 0; k < kCoveredPlaces; ++k) {
    const std::size_t i = all[k * all.size() / kCoveredPlaces];
    places.samples.push_back(i);
    places.truth.push_back(at.samples[i].phi);
  }
  return places;
}

/// Shares covered, of phi over all places and of t*.
struct Coverage {
  double phi = 0, t_star = 0;
};
/// With a bootstrap of so many replicates, if there is to be one.
Coverage coverage_of(const SceneSpec<double>& truth, const std::vector<double>& rates, double sigma,
                     std::size_t n_bootstrap = 0, int n_data = kPredictionReplicates) {
  const Scene<double> scene(truth);
  const PlacesInFans places = places_in_fans(scene);
  SolverRequest request;
  request.timeline = true;
  const double t_star = solve(scene, Method(), request).timeline->t_star.value();
  ObservationPlan plan;
  plan.quantity = Quantity::cumulative;
  for (int i = 1; i <= 20; ++i) plan.times.push_back(i / 2.0);
  for (int i = 1; i <= 33; ++i) plan.depths.push_back(0.03 * i);
  const Observations exact = observed(truth, plan, 0, 1, false);
  FitSpec spec = fit_of(truth, exact, {"shear_rate.values"}, rates);
  spec.uncertainty.bootstrap = n_bootstrap;
  const Parameters parameters(spec.scene, spec.unknown);
  Coverage covered;
  for (int b = 0; b < n_data; ++b) {
    spec.observations = exact;
    add_noise(spec.observations, sigma, 41, static_cast<std::uint64_t>(b));
    const Estimate estimate = fit(spec);
    const DrawnScenes draws =
        scenes_behind(parameters, estimate, kCoverageDraws, static_cast<std::uint64_t>(b));
    EXPECT_EQ(draws.why_none, "");
    EXPECT_EQ(draws.are_replicates, n_bootstrap > 0);
    const PredictedSamples samples =
        predict_samples(*estimate.scene, draws, Method(), places.times, places.heights);
    for (std::size_t k = 0; k < kCoveredPlaces; ++k) {
      const auto& band = samples.phi[places.samples[k]].band;
      covered.phi += band && band->low <= places.truth[k] && places.truth[k] <= band->high ? 1 : 0;
    }
    const PredictedEvents events = predict_events(*estimate.scene, draws, Method());
    const auto& band = events.t_star.band;
    covered.t_star += band && band->low <= t_star && t_star <= band->high ? 1 : 0;
  }
  covered.phi /= n_data * static_cast<double>(kCoveredPlaces);
  covered.t_star /= n_data;
  return covered;
}

void expect_nominal(const Coverage& covered) {
  testing::Test::RecordProperty(
      "covered", std::to_string(covered.phi) + " of phi, " + std::to_string(covered.t_star) + " of t*");
  std::printf("covered: %.2f %% of phi, %.2f %% of t*\n", 100 * covered.phi, 100 * covered.t_star);
  EXPECT_NEAR(covered.phi, 0.95, 0.02);
  EXPECT_NEAR(covered.t_star, 0.95, 0.02);
}

TEST(SlowFitPrediction, BandsOfExample3CoverTheTruth) {
  expect_nominal(coverage_of(small_above_large({0.29}, {3.15, 0.5}), {3.15, 0.5}, 1e-3));
}

TEST(SlowFitPrediction, BandsOfExample4CoverTheTruth) {
  expect_nominal(coverage_of(small_above_large({0.2, 0.4, 0.6, 0.8}, {3.25, 2.32, 1.63, 1.05, 0.53}),
                             {3.25, 2.32, 1.63, 1.05, 0.53}, 1e-3));
}

// Fewer data sets, for each has a bootstrap: 95 +- 2.2 of 100. 79 replicates: (n + 1) p is whole.
TEST(SlowFitPrediction, BandsOfABootstrapCoverTheTruth) {
  const Coverage covered = coverage_of(small_above_large({0.29}, {3.15, 0.5}), {3.15, 0.5}, 1e-3, 79, 100);
  std::printf("covered: %.2f %% of phi, %.2f %% of t*\n", 100 * covered.phi, 100 * covered.t_star);
  EXPECT_NEAR(covered.phi, 0.95, 0.05);
  EXPECT_NEAR(covered.t_star, 0.95, 0.06);
}

}  // namespace
}  // namespace shearfront::fit
