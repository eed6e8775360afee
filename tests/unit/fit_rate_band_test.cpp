// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>

#include "shearfront/fit/rate_band.hpp"
#include "support/fit_scenes.hpp"

/// Bands of s a(z): each height by itself, and all heights at once.
namespace shearfront::fit {
namespace {

using namespace shearfront::support;

constexpr double kOneSided = 1.959963984540054;  // Phi(x) = 0.975
constexpr double kBothOfTwo = 2.236477;          // (2 Phi(x) - 1)^2 = 0.95
constexpr double kStretchOfTwo = kBothOfTwo / kOneSided;
constexpr double kSampled = 0.03;  // three deviations of a quantile of 10,000 draws

struct TwoRates {
  Scene<double> scene{small_above_large({0.29}, {3, 0.5})};
  Parameters parameters{scene, {{"shear_rate.values"}, {}, {}, {}, Shape::none}};
  Estimate estimate;

  explicit TwoRates(double correlation) {
    estimate.scene = scene;
    estimate.sigma_is_given = true;
    for (std::size_t i = 0; i < 2; ++i) {
      ParameterEstimate& p = estimate.parameters.emplace_back();
      p.name = parameters[i].name();
      p.estimate = parameters[i].start;
      p.std_error = 0.1 * p.estimate;
      p.ci95 = Interval{p.estimate * std::exp(-0.1 * kOneSided), p.estimate * std::exp(0.1 * kOneSided)};
    }
    estimate.correlation = Eigen::MatrixXd::Constant(2, 2, correlation);
    estimate.correlation.diagonal().setOnes();
  }
};

void expect_interval(const std::optional<Interval>& band, double low, double high, double relative) {
  ASSERT_TRUE(band.has_value());
  EXPECT_NEAR(band->low / low, 1, relative);
  EXPECT_NEAR(band->high / high, 1, relative);
}

TEST(FitRateBand, OfIndependentLayersHoldsInBothByTheRuleOfSidak) {
  const TwoRates two(0);
  const RateBand band = rate_band(two.parameters, two.estimate);
  EXPECT_NEAR(band.stretch, kStretchOfTwo, kSampled);
  EXPECT_EQ(band.n_replicates, 0U);
  ASSERT_EQ(band.rows.size(), 4U);
  for (const RateRow& row : band.rows) {
    expect_interval(row.band, row.a * std::exp(-0.1 * kOneSided), row.a * std::exp(0.1 * kOneSided), 1e-9);
    const double reach = std::exp(0.1 * kOneSided * band.stretch);
    expect_interval(row.everywhere, row.a / reach, row.a * reach, 1e-9);
  }
}

TEST(FitRateBand, OfLayersThatMoveTogetherIsTheSameAtAllHeights) {
  const TwoRates two(1);
  EXPECT_NEAR(rate_band(two.parameters, two.estimate).stretch, 1, kSampled);
}

// The error bars are left wrong, so that only the replicates can give these numbers.
TEST(FitRateBand, AfterABootstrapLiesBetweenTheQuantilesOfTheReplicates) {
  TwoRates two(0);
  constexpr Eigen::Index kBandReplicates = 199;  // (n + 1) p is the 5th and the 195th
  two.estimate.replicates.resize(kBandReplicates, 2);
  for (Eigen::Index b = 0; b < kBandReplicates; ++b)
    two.estimate.replicates.row(b) << 3 * (1 + 0.001 * double(b + 1)), 0.5 * (1 + 0.001 * double(b + 1));
  const RateBand band = rate_band(two.parameters, two.estimate);
  EXPECT_EQ(band.n_replicates, 199U);
  EXPECT_EQ(band.stretch, 1);  // both rates move together
  for (const RateRow& row : band.rows) {
    expect_interval(row.band, row.a * 1.005, row.a * 1.195, 1e-12);
    expect_interval(row.everywhere, row.a * 1.005, row.a * 1.195, 1e-12);
  }
}

TEST(FitRateBand, AfterABootstrapHoldsInBothLayersAtOnce) {
  TwoRates two(0);
  constexpr Eigen::Index kBandReplicates = 10000;
  boost::random::mt19937_64 generator(7);
  boost::random::normal_distribution<double> normal;
  two.estimate.replicates.resize(kBandReplicates, 2);
  for (Eigen::Index b = 0; b < kBandReplicates; ++b)
    for (Eigen::Index i = 0; i < 2; ++i)
      two.estimate.replicates(b, i) = (i == 0 ? 3 : 0.5) * std::exp(0.02 * normal(generator));
  EXPECT_NEAR(rate_band(two.parameters, two.estimate).stretch, kStretchOfTwo, 2 * kSampled);
}

}  // namespace
}  // namespace shearfront::fit
