// SPDX-License-Identifier: BSD-3-Clause
// Designs under correlated noise: against dense matrices, all choices there are, fits, and refits.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/design/correlated_information.hpp"
#include "shearfront/fit/design/design.hpp"
#include "support/design_checks.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

using namespace shearfront::support;

/// Candidates at random times, one or two of them a unit.
CorrelatedInformation random_correlated(boost::random::mt19937_64& random, std::size_t n_units, Index p,
                                        std::size_t n_draws) {
  boost::random::normal_distribution<double> normal;
  boost::random::uniform_real_distribution<double> uniform;
  CorrelatedInformation information;
  std::vector<double> times;
  for (std::size_t g = 0; g < n_units; ++g) {
    auto& unit = information.units.emplace_back();
    for (std::size_t k = 0; k <= g % 2; ++k) {
      unit.push_back(static_cast<Index>(times.size()));
      times.push_back(uniform(random));
    }
  }
  const auto n = static_cast<Index>(times.size());
  const double length = 0.05 + uniform(random), alone = 0.3 * uniform(random);
  information.covariance.resize(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      information.covariance(i, j) =
          (i == j ? alone : 0) + (1 - alone) * std::exp(-std::abs(times[static_cast<std::size_t>(i)] -
                                                                  times[static_cast<std::size_t>(j)]) /
                                                        length);
  for (std::size_t k = 0; k < n_draws; ++k) {
    information.before.emplace_back(0.1 * MatrixXd::Identity(p, p));
    MatrixXd& j = information.jacobians.emplace_back(n, p);
    for (double& x : j.reshaped()) x = normal(random) * std::exp(normal(random));
  }
  return information;
}

MatrixXd dense_information(const CorrelatedInformation& information, std::size_t draw,
                           const std::vector<std::size_t>& units) {
  std::vector<Index> rows;
  for (const std::size_t g : units)
    rows.insert(rows.end(), information.units[g].begin(), information.units[g].end());
  const MatrixXd j = information.jacobians[draw](rows, Eigen::all);
  return information.before[draw] + j.transpose() * information.covariance(rows, rows).inverse() * j;
}

double dense_mean(const CorrelatedInformation& information, const InformationCriterion& criterion,
                  const std::vector<std::size_t>& units) {
  double sum = 0;
  for (std::size_t k = 0; k < information.before.size(); ++k)
    sum += criterion.value(dense_information(information, k, units));
  return sum / static_cast<double>(information.before.size());
}

TEST(FitCorrelatedDesign, IsAsGoodAsItSaysAndBetterThanNoneIsTheBound) {
  CheckedChoices checked;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    boost::random::mt19937_64 random(seed);
    const CorrelatedInformation information = random_correlated(random, 10, 3, 1 + seed % 2);
    for (const Criterion kind : kEveryCriterion) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", criterion " + std::to_string(static_cast<int>(kind)));
      const InformationCriterion criterion(kind, 2);
      check_choice(
          information, criterion, 10, 4,
          [&](const std::vector<std::size_t>& some) { return dense_mean(information, criterion, some); },
          checked);
    }
  }
  EXPECT_EQ(checked.n, 48);
  // Exchange of one by one may end beside the best, but seldom.
  EXPECT_GE(checked.n_best, 46);
  // The bound says something: 0.81 on the average.
  EXPECT_GT(checked.efficiency / checked.n, 0.75);
}

/// The tangent at the relaxed design is as high as any, and no exchange of one unit for another, each by a dense inverse, is better.
TEST(FitCorrelatedDesign, NothingIsLeftToGain) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    for (const Criterion kind : kEveryCriterion) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", criterion " + std::to_string(static_cast<int>(kind)));
      boost::random::mt19937_64 random(seed);
      const std::size_t n = 12, n_units = 90, n_draws = 1 + seed % 2;
      const CorrelatedInformation information = random_correlated(random, n_units, 3, n_draws);
      const InformationCriterion criterion(kind, 1);
      const auto continuous = continuous_design(information, criterion, n);
      ASSERT_TRUE(continuous);
      EXPECT_NEAR(continuous->bound, continuous->value, 1e-5);
      EXPECT_NEAR(continuous->weights.sum(), 1, 1e-12);
      EXPECT_GE(continuous->weights.minCoeff(), 0);
      EXPECT_LE(continuous->weights.maxCoeff(), 1.0 / n + 1e-12);
      const auto chosen = exchanged_design(information, criterion, n, *continuous);
      const double found = dense_mean(information, criterion, chosen);
      EXPECT_GE(found, continuous->bound);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t g = 0; g < n_units; ++g) {
          if (std::find(chosen.begin(), chosen.end(), g) != chosen.end()) continue;
          auto other = chosen;
          other[i] = g;
          EXPECT_GE(dense_mean(information, criterion, other), found - 1e-8) << chosen[i] << " for " << g;
        }
    }
}

/// At weights 1/n and 0 the relaxed information is that of the set, and its slopes are those of differences.
TEST(FitCorrelatedDesign, WorthIsTheSlopeOfTheRelaxedCriterion) {
  boost::random::mt19937_64 random(5);
  const CorrelatedInformation information = random_correlated(random, 6, 2, 1);
  const InformationCriterion criterion(Criterion::D, 0);
  // All units: every weight is 1/n, so the tangent is at the set of all, and the value is that of it.
  const auto all = continuous_design(information, criterion, 6);
  ASSERT_TRUE(all);
  EXPECT_NEAR(all->value, criterion.value(dense_information(information, 0, {0, 1, 2, 3, 4, 5})), 1e-9);
  // M(w) = J^T (s A^-1 + C - s 1)^-1 J: more noise of its own for what has less weight.
  const double s = Eigen::SelfAdjointEigenSolver<MatrixXd>(information.covariance).eigenvalues()[0];
  const auto relaxed = [&](std::size_t unit, double a) {
    MatrixXd c = information.covariance;
    for (const Index i : information.units[unit]) c(i, i) += s / a - s;
    return criterion.value(information.before[0] +
                           information.jacobians[0].transpose() * c.inverse() * information.jacobians[0]);
  };
  for (std::size_t g = 0; g < 6; ++g) {
    const double h = 1e-5;
    const double slope = (relaxed(g, 1 + h) - relaxed(g, 1 - h)) / (2 * h);
    EXPECT_NEAR(all->worth[static_cast<Index>(g)], -6 * slope, 1e-5 * (1 + std::abs(6 * slope))) << g;
  }
}

NoiseSpec known_lengths() {
  NoiseSpec noise;
  noise.model = NoiseModel::exponential;
  noise.length_z = 0.15;
  noise.length_t = 0.5;
  noise.independent = 0.1;
  return noise;
}

double covariance_of(const Observation& a, const Observation& b) {
  return 0.9 * std::exp(-std::abs(a.z - b.z) / 0.15 - std::abs(a.t - b.t) / 0.5);
}

/// Two layers in bins, noise of that covariance.
FitSpec correlated_layers(double sigma, std::uint64_t seed) {
  const SceneSpec<double> truth = small_above_large({0.29}, {2.4, 0.31});
  const Scene<double> bed(truth);
  const ObservationPlan plan = bins_of_layers();
  Observations data = observe(plan, bed, solve<ExactSolver>(bed, request_of(plan, bed)));
  const auto n = static_cast<Index>(data.rows.size());
  static const MatrixXd root = [&] {
    MatrixXd c(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        c(i, j) =
            covariance_of(data.rows[static_cast<std::size_t>(i)], data.rows[static_cast<std::size_t>(j)]) +
            (i == j ? 0.1 : 0);
    return MatrixXd(c.llt().matrixL());
  }();
  boost::random::mt19937_64 random(seed);
  boost::random::normal_distribution<double> normal;
  VectorXd white(n);
  for (double& x : white) x = normal(random);
  const VectorXd noise = sigma * root * white;
  for (Index i = 0; i < n; ++i) {
    data.rows[static_cast<std::size_t>(i)].value += noise[i];
    data.rows[static_cast<std::size_t>(i)].sigma = sigma;
  }
  FitSpec spec = fit_of(truth, std::move(data), {"shear_rate.values"});
  spec.noise = known_lengths();
  return spec;
}

TEST(FitCorrelatedDesign, AllThereIsHasTheErrorsOfTheFit) {
  const FitSpec spec = correlated_layers(0.01, 1);
  const Estimate estimate = fit(spec);
  DesignSpec wanted = measured_again(spec, 8, false);
  wanted.unit = DesignUnit::time;
  const Design all = design(spec, estimate, wanted);
  expect_errors_of_fit(all, estimate);
}

/// What is measured beside the data is one experiment with them: a fit of all of it, or of data alone, says so.
TEST(FitCorrelatedDesign, NewMeasurementsAndTheDataAreOneExperiment) {
  for (const NoiseModel model : {NoiseModel::exponential, NoiseModel::discrepancy}) {
    FitSpec whole = correlated_layers(0.01, 1);
    if (model == NoiseModel::discrepancy) {
      whole.noise.model = model;
      whole.noise.tau = 0.02;
    }
    FitSpec half = whole;
    DesignSpec wanted;
    wanted.candidates.quantity = Quantity::bin;
    half.observations.rows.clear();
    for (const Observation& o : whole.observations.rows)
      (o.t < 0.7 ? half.observations.rows : wanted.candidates.rows).push_back(o);
    Estimate estimate = fit(whole);
    const Estimate of_half = fit(half);
    // At the estimate of the whole, of which the errors are.
    estimate.noise = of_half.noise;
    wanted.n = 5;
    wanted.unit = DesignUnit::time;
    const Design rest = design(half, estimate, wanted);
    EXPECT_EQ(rest.choices.size(), 5U);
    for (Index j = 0; j < 2; ++j) {
      const double error = estimate.parameters[static_cast<std::size_t>(j)].std_error.value();
      EXPECT_NEAR(rest.errors.chosen[j] / error, 1, 1e-6) << static_cast<int>(model);
      EXPECT_FALSE(rest.errors.before[j] < error);  // not determined, or less well
    }
  }
  // Without noise of its own the same measurement again says nothing new.
  FitSpec spec = correlated_layers(0.01, 1);
  spec.noise.independent = 0;
  const Design again = design(spec, fit(spec), measured_again(spec, 20, true));
  for (Index j = 0; j < 2; ++j) EXPECT_NEAR(again.errors.chosen[j] / again.errors.before[j], 1, 1e-6);
}

TEST(FitCorrelatedDesign, SpreadsWhatIndependentNoiseWouldPutSideBySide) {
  FitSpec spec = correlated_layers(0.01, 1);
  const Design correlated = design(spec, fit(spec), measured_again(spec, 12, false));
  EXPECT_GT(correlated.efficiency(), 0.5);
  spec.noise = {};
  const Design independent = design(spec, fit(spec), measured_again(spec, 12, false));
  const auto dense_error = [&](const Design& chosen, Index j) {
    // Of a fit of what is chosen, by the covariance that there is.
    FitSpec some = correlated_layers(0.01, 1);
    some.observations.rows.clear();
    for (const DesignChoice& choice : chosen.choices)
      if (choice.is_chosen) some.observations.rows.push_back(spec.observations.rows[choice.rows.front()]);
    return fit(some).parameters[static_cast<std::size_t>(j)].std_error.value();
  };
  double of_correlated = 0, of_independent = 0;
  for (Index j = 0; j < 2; ++j) {
    of_correlated += std::log(dense_error(correlated, j));
    of_independent += std::log(dense_error(independent, j));
  }
  EXPECT_LT(of_correlated, of_independent);
}

TEST(FitCorrelatedDesign, RefusesNoiseThatIsNotKnown) {
  const FitSpec spec = correlated_layers(0.01, 1);
  const Estimate estimate = fit(spec);
  const auto refusal = [&](const DesignSpec& wanted) {
    try {
      (void)design(spec, estimate, wanted);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  DesignSpec wanted = measured_again(spec, 2, false);
  wanted.candidates.quantity = Quantity::point;
  for (Observation& o : wanted.candidates.rows) o.width = 0;
  EXPECT_EQ(
      refusal(wanted),
      "quantity = point; must be that of the data where noise is correlated: of others it is not known");
  wanted = measured_again(spec, 2, false);
  while (wanted.candidates.rows.size() <= 2000)
    wanted.candidates.rows.push_back(wanted.candidates.rows.front());
  EXPECT_EQ(refusal(wanted),
            "candidates = 2001 measurements; must be at most 2000 where noise is correlated");
}

// As of independent noise (fit_design_test.cpp): scatter of 1000 fits as predicted, their own error 2.2 %.
TEST(SlowFitCorrelatedDesign, ErrorsAreThoseOfRefits) {
  constexpr double kSigma = 0.002;
  const FitSpec whole = correlated_layers(kSigma, 1000000);
  const Design best = design(whole, fit(whole), measured_again(whole, 30, false));
  expect_errors_of_refits(best, 1000, 0.07,
                          [&](std::uint64_t seed) { return correlated_layers(kSigma, seed); });
}

}  // namespace
}  // namespace shearfront::fit
