// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "shearfront/fit/bootstrap.hpp"
#include "shearfront/fit/interval_check.hpp"
#include "shearfront/fit/profile_likelihood.hpp"
#include "support/fit_scenes.hpp"

/// Profile-likelihood and bootstrap intervals against closed forms, and how often they cover the truth.
namespace shearfront::fit {
namespace {

using namespace shearfront::support;

/// beta = 1 / (2 s) and its standard error for sigma = 1, from the regression on z / t and -1 / t.
struct Regression {
  double beta = 0, error = 0, residual = 0;
};
Regression regression(const Observations& data) {
  MatrixXd design(static_cast<Index>(data.rows.size()), 2);
  VectorXd y(design.rows());
  for (Index i = 0; i < y.size(); ++i) {
    const Observation& o = data.rows[static_cast<std::size_t>(i)];
    design.row(i) << o.z / o.t, -1 / o.t;
    y[i] = o.value - 0.5;
  }
  const MatrixXd inverse = (design.transpose() * design).inverse();
  const VectorXd x = inverse * design.transpose() * y;
  return {x[0], std::sqrt(inverse(0, 0)), (y - design * x).squaredNorm()};
}

TEST(FitProfile, OfALinearRegression) {
  // The misfit profiled over z0 is a parabola in beta: the interval of s is 1 / (2 (beta -+ q error)), skew.
  for (const bool with_sigma : {true, false}) {
    FitSpec spec = fan_fit(0.03, 4, with_sigma);
    spec.uncertainty.profile = true;
    const Estimate e = fit(spec);
    const Regression r = regression(spec.observations);
    const double q =
        with_sigma ? 1.959963984540054 * 0.03
                   : boost::math::quantile(boost::math::students_t(12), 0.975) * std::sqrt(r.residual / 12);
    ASSERT_TRUE(e.parameters[0].profile95 && e.parameters[1].profile95);
    const double low = 1 / (2 * (r.beta + q * r.error)), high = 1 / (2 * (r.beta - q * r.error));
    EXPECT_NEAR(e.parameters[0].profile95->low, low, 2e-3 * (high - low));
    EXPECT_NEAR(e.parameters[0].profile95->high, high, 2e-3 * (high - low));
    EXPECT_GT(high - e.parameters[0].estimate, 1.02 * (e.parameters[0].estimate - low));
  }
}

/// At an end of the interval of one unknown, the others fitted anew to the same data with it fixed leave a misfit that has risen by
/// half the quantile of chi^2.
TEST(FitProfile, EndsWhereTheFitOfTheOthersHasRisenByTheQuantile) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  FitSpec spec = fit_of(truth,
                        observed(truth,
                                 {{0.5, 1, 1.5, 2, 3, 4},
                                  {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
                                  Quantity::cumulative,
                                  0},
                                 0.01, 1, true),
                        {"shear_rate.values"}, {2.5, 0.7});
  spec.uncertainty.profile = true;
  const Estimate e = fit(spec);
  int n_ends = 0;
  for (const std::size_t fixed : {0U, 1U}) {
    ASSERT_TRUE(e.parameters[fixed].profile95);
    for (const double end : {e.parameters[fixed].profile95->low, e.parameters[fixed].profile95->high}) {
      if (std::isnan(end)) continue;
      SceneSpec<double> held = truth;
      std::get<Piecewise<double>>(held.shear_rate).values[fixed] = end;
      const std::size_t other = 1 - fixed;
      FitSpec rest = fit_of(held, spec.observations, {"shear_rate.values[" + std::to_string(other) + "]"},
                            {e.parameters[other].estimate});
      EXPECT_NEAR(fit(rest).misfit - e.misfit, 3.841458820694124 / 2, 0.01) << e.parameters[fixed].name;
      ++n_ends;
    }
  }
  EXPECT_GE(n_ends, 3);
}

TEST(FitProfile, AgreesWithErrorBarsForSmallNoise) {
  // Rows with independent noise, sums with correlated noise, and a robust loss.
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  const auto data =
      observed(truth, {{0.5, 1, 2, 3}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, Quantity::bin, 0.1},
               1e-4, 5, true);
  for (const auto& [quantity, loss] :
       {std::pair{"bin", "squared"}, {"cumulative", "squared"}, {"bin", "huber"}}) {
    FitSpec spec = fit_of(truth, data, {"shear_rate.values"}, {3, 0.6});
    spec.misfit.quantity = quantity;
    spec.misfit.loss = loss;
    spec.uncertainty.profile = true;
    const Estimate e = fit(spec);
    // Huber's misfit is a parabola only as long as no residual crosses its bend.
    const double tolerance = std::string_view(loss) == "huber" ? 0.2 : 0.01;
    for (const ParameterEstimate& p : e.parameters) {
      ASSERT_TRUE(p.profile95 && p.ci95) << p.name;
      const double width = p.ci95->high - p.ci95->low;
      EXPECT_NEAR(p.profile95->low, p.ci95->low, tolerance * width) << p.name << quantity << loss;
      EXPECT_NEAR(p.profile95->high, p.ci95->high, tolerance * width) << p.name << quantity << loss;
    }
  }
}

TEST(FitProfile, OpenEndsAreNotInvented) {
  // A layer not seen: no interval; one at its bound: one end.
  const auto truth = small_above_large({0.3, 0.8}, {1, 2, 1.5});
  FitSpec spec = fit_of(
      truth,
      observed(truth, {{0.1, 0.14}, {0.2, 0.25, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.7}, Quantity::bin, 0.05},
               0.01, 1, true),
      {"shear_rate.values"});
  spec.unknown.start = {1, 1.7, 1.5};
  spec.unknown.lower = {0.1, 0.1, 0.1};
  spec.unknown.upper = {10, 1.8, 10};
  spec.uncertainty.profile = true;
  const Estimate e = fit(spec);
  EXPECT_FALSE(e.parameters[2].profile95);
  ASSERT_TRUE(e.parameters[1].at_bound && e.parameters[1].profile95);
  EXPECT_LT(e.parameters[1].profile95->low, 1.8);
  EXPECT_TRUE(std::isnan(e.parameters[1].profile95->high));
  EXPECT_EQ(std::count(e.warnings.begin(), e.warnings.end(),
                       "shear_rate.values[2]: these data give no 95 % profile interval within its bounds"),
            1);
  EXPECT_EQ(std::count(e.warnings.begin(), e.warnings.end(),
                       "shear_rate.values[1]: these data give no upper end of its 95 % profile interval "
                       "within its bounds"),
            1);
}

TEST(FitProfile, RefusesShapes) {
  FitSpec spec = fit_of(small_above_large({0.29}, {3.15, 0.5}),
                        observed(small_above_large({0.29}, {3.15, 0.5}),
                                 {{1}, {0.2, 0.5, 0.7}, Quantity::cumulative, 0}, 0.01, 1, true),
                        {"shear_rate.values"});
  spec.unknown.shape = Shape::decreasing;
  spec.uncertainty.profile = true;
  try {
    (void)fit(spec);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "uncertainty.profile = true; must be false with unknown.shape; use uncertainty.bootstrap");
  }
}

TEST(FitBootstrap, TheSameToTheBitOnAnyNumberOfThreads) {
  FitSpec spec = fan_fit(0.02, 6, false);
  spec.uncertainty.bootstrap = 60;
  std::vector<Estimate> estimates;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    spec.uncertainty.threads = threads;
    estimates.push_back(fit(spec));
  }
  for (const Estimate& e : estimates)
    for (std::size_t i = 0; i < 2; ++i) {
      ASSERT_TRUE(e.parameters[i].bootstrap95);
      EXPECT_EQ(e.parameters[i].bootstrap95->low, estimates[0].parameters[i].bootstrap95->low);
      EXPECT_EQ(e.parameters[i].bootstrap95->high, estimates[0].parameters[i].bootstrap95->high);
    }
  spec.uncertainty.seed = 2;
  EXPECT_NE(fit(spec).parameters[0].bootstrap95->low, estimates[0].parameters[0].bootstrap95->low);
}

TEST(FitProfile, DoesNotEndWhereTheModelDoes) {
  // The layers about the break are nearly alike, so the data hardly see it; at 0.6 it meets the next one.
  const auto truth = small_above_large({0.3, 0.6}, {1, 1.01, 2});
  FitSpec spec =
      fit_of(truth, observed(truth, {{0.3, 0.6, 1}, {0.2, 0.4, 0.6, 0.8}, Quantity::bin, 0.1}, 0.05, 1, true),
             {"shear_rate.breaks[0]"});
  spec.unknown.lower = {0.1};
  spec.unknown.upper = {0.9};
  spec.uncertainty.profile = true;
  const Estimate e = fit(spec);
  EXPECT_FALSE(e.parameters[0].profile95);
  const auto begins = [&](const std::string& text) {
    return std::count_if(e.warnings.begin(), e.warnings.end(),
                         [&](const std::string& warning) { return warning.starts_with(text); });
  };
  EXPECT_EQ(begins("shear_rate.breaks[0]: these data give no lower end of its 95 % profile interval"), 1);
  // Found to 2 % of its distance from the estimate.
  EXPECT_EQ(begins("shear_rate.breaks[0]: no upper end of its 95 % profile interval up to 0.59") +
                begins("shear_rate.breaks[0]: no upper end of its 95 % profile interval up to 0.6"),
            1);
}

TEST(FitCheck, IsQuietWhereTheMisfitIsAParabola) {
  for (const bool with_sigma : {true, false}) {
    const Estimate e = fit(fan_fit(0.002, 11, with_sigma));
    for (const ParameterEstimate& p : e.parameters) {
      ASSERT_TRUE(p.check) << p.name;
      EXPECT_FALSE(p.check->is_doubtful()) << p.name;
    }
    EXPECT_TRUE(e.warnings.empty());
  }
}

TEST(FitCheck, SaysWhatProfilesSay) {
  // Sums say little about a thin fast layer at the bottom: no upper bound at 5 % noise.
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  std::size_t near = 0, far = 0, open = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    FitSpec spec = fit_of(truth,
                          observed(truth,
                                   {{0.5, 1, 1.5, 2, 3, 4},
                                    {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
                                    Quantity::cumulative,
                                    0},
                                   0.01, seed, true),
                          {"shear_rate.values"}, {2.5, 0.7});
    spec.uncertainty.profile = true;
    const Estimate e = fit(spec);
    for (const ParameterEstimate& p : e.parameters) {
      if (!p.check || !p.profile95) continue;
      const double log_width = std::log(p.ci95->high / p.estimate);
      const double low = std::log(p.estimate / p.profile95->low) / log_width;
      const double high = std::log(p.profile95->high / p.estimate) / log_width;
      for (const auto& [fault, factor] : {std::pair{p.check->low, low}, {p.check->high, high}}) {
        // 2 %: how well ends of profiles and refits are found.
        const bool is_wrong = (fault == EndFault::too_near && factor < 0.98 * kMostOff) ||
                              (fault == EndFault::too_far && !(factor < 1.02 / kMostOff));
        EXPECT_FALSE(is_wrong) << p.name << " seed " << seed << ": " << factor;
        near += fault == EndFault::too_near ? 1 : 0;
        far += fault == EndFault::too_far ? 1 : 0;
        open += fault == EndFault::too_near && std::isnan(factor) ? 1 : 0;
      }
      const std::string text = "do not trust the 95 % interval of " + p.name;
      EXPECT_EQ(std::any_of(e.warnings.begin(), e.warnings.end(),
                            [&](const std::string& warning) { return warning.starts_with(text); }),
                p.check->is_doubtful());
    }
  }
  EXPECT_GT(near, 0U);
  EXPECT_GT(far, 0U);
  EXPECT_GT(open, 0U);
}

TEST(FitCheck, IsNotMadeWhereItHasNoMeaning) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  const ObservationPlan plan{{0.5, 1, 2, 3}, {0.1, 0.3, 0.5, 0.7, 0.9}, Quantity::bin, 0.1};
  FitSpec spec = fit_of(truth, observed(truth, plan, 1e-3, 5, true), {"shear_rate.values"}, {3, 0.6});
  spec.unknown.shape = Shape::decreasing;
  for (const ParameterEstimate& p : fit(spec).parameters) {
    EXPECT_TRUE(p.ci95);
    EXPECT_FALSE(p.check);
  }
}

TEST(FitBootstrap, AgreesWithErrorBars) {
  FitSpec spec = fan_fit(0.01, 7, true);
  spec.uncertainty.bootstrap = 400;
  const Estimate e = fit(spec);
  for (const ParameterEstimate& p : e.parameters) {
    ASSERT_TRUE(p.bootstrap95);
    // A 2.5 % quantile of 400 numbers has a standard deviation of 0.13 standard deviations.
    EXPECT_NEAR(p.bootstrap95->low, p.ci95->low, 0.5 * *p.std_error);
    EXPECT_NEAR(p.bootstrap95->high, p.ci95->high, 0.5 * *p.std_error);
  }
}

/// A fit that returns the mean of the data as its only parameter: everything is known about it.
std::optional<VectorXd> mean_of(const FitSpec& spec, const Progress& /*progress*/) {
  double sum = 0;
  for (const Observation& o : spec.observations.rows) sum += o.value;
  return VectorXd::Constant(1, sum / static_cast<double>(spec.observations.rows.size()));
}

Estimate known_mean(const FitSpec& spec) {
  Estimate e;
  e.parameters.resize(1);
  e.parameters[0].estimate = 1;
  e.parameters[0].std_error = 1;
  e.predicted.assign(spec.observations.rows.size(), 1.0);
  e.sigma = 0.5;
  return e;
}

TEST(FitBootstrap, QuantilesAndCovarianceOfAMean) {
  FitSpec spec = fit_of(fan_scene(), observed(fan_scene(), fan_plan(), 0.1, 1, false), {"shear_rate.scale"});
  spec.uncertainty.bootstrap = 2000;
  const Parameters parameters(spec.scene, spec.unknown);
  const Bootstrap b = bootstrap(spec, parameters, known_mean(spec), mean_of);
  const double error = 0.5 / std::sqrt(static_cast<double>(spec.observations.rows.size()));
  EXPECT_EQ(b.estimates.rows(), 2000);
  EXPECT_NEAR(std::sqrt(b.covariance(0, 0)) / error, 1, 0.06);
  EXPECT_NEAR(b.intervals[0]->low, 1 - 1.96 * error, 0.25 * error);
  EXPECT_NEAR(b.intervals[0]->high, 1 + 1.96 * error, 0.25 * error);
  EXPECT_TRUE(b.warnings.empty());
}

TEST(FitBootstrap, CountsFailuresAndNeedsEnoughReplicates) {
  FitSpec spec = fit_of(fan_scene(), observed(fan_scene(), fan_plan(), 0.1, 1, false), {"shear_rate.scale"});
  spec.uncertainty.bootstrap = 100;
  const Parameters parameters(spec.scene, spec.unknown);
  const auto sometimes = [](double above) {
    return [above](const FitSpec& one, const Progress&) -> std::optional<VectorXd> {
      const auto mean = mean_of(one, {});
      if (one.observations.rows[0].value < above) return mean;
      if (one.observations.rows[1].value < 1) return {};
      throw InputError("a", "b", "c");
    };
  };
  const Bootstrap most = bootstrap(spec, parameters, known_mean(spec), sometimes(1.5));
  EXPECT_GT(most.failed, 5U);
  EXPECT_LT(most.failed, 30U);
  ASSERT_EQ(most.warnings.size(), 1U);
  EXPECT_EQ(most.warnings[0], std::to_string(most.failed) +
                                  " of 100 bootstrap replicates could not be fitted and are left out");
  EXPECT_TRUE(most.intervals[0]);
  const Bootstrap few = bootstrap(spec, parameters, known_mean(spec), sometimes(0.5));
  EXPECT_FALSE(few.intervals[0]);
  EXPECT_EQ(few.warnings.size(), 2U);
}

TEST(FitBootstrap, GivesNothingForWhatTheDataDoNotDetermine) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  FitSpec spec = fit_of(
      truth, observed(truth, {{0.5, 1, 2}, {0.1, 0.3, 0.5, 0.7, 0.9}, Quantity::bin, 0.1}, 0.01, 1, true),
      {"shear_rate.scale", "shear_rate.values", "initial.breaks"});
  spec.uncertainty.bootstrap = 50;
  const Estimate e = fit(spec);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(e.parameters[i].bootstrap95) << i;
  EXPECT_TRUE(e.parameters[3].bootstrap95);
}

/// Share of 95 % intervals that cover s = 1, z0 = 0.5: from error bars and from profiles.
TEST(FitIntervals, CoverTheTruthAsOftenAsTheySay) {
  constexpr int kReplicates = 300;
  int by_error = 0, by_profile = 0, total = 0;
  for (int b = 0; b < kReplicates; ++b) {
    FitSpec spec = fan_fit(0.03, 100 + static_cast<std::uint64_t>(b), b % 2 == 0);
    spec.uncertainty.profile = true;
    const Estimate e = fit(spec);
    const double truth[] = {1, 0.5};
    for (std::size_t i = 0; i < 2; ++i) {
      const ParameterEstimate& p = e.parameters[i];
      ASSERT_TRUE(p.ci95 && p.profile95);
      by_error += p.ci95->low <= truth[i] && truth[i] <= p.ci95->high ? 1 : 0;
      by_profile += p.profile95->low <= truth[i] && truth[i] <= p.profile95->high ? 1 : 0;
      ++total;
    }
  }
  // 600 intervals: standard deviation 0.9 %.
  EXPECT_NEAR(100.0 * by_error / total, 95, 2.7);
  EXPECT_NEAR(100.0 * by_profile / total, 95, 2.7);
}

}  // namespace
}  // namespace shearfront::fit
