// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shearfront/fit/prediction.hpp"
#include "shearfront/fit/scene_uncertainty.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/fit_scenes.hpp"

/// Draws have the means, deviations and correlations they are drawn from; bands of what is known in closed form are its quantiles.
namespace shearfront::fit {
namespace {

using namespace shearfront::support;

constexpr double kNormal = 1.959963984540054;  // 97.5 % quantile

/// An estimate of both rates of the two layers with these errors, as a fit to data with their own sigma gives it.
Estimate estimate_of(const Parameters& parameters, const std::vector<double>& errors, double correlation) {
  Estimate e;
  e.sigma_is_given = true;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    ParameterEstimate& p = e.parameters.emplace_back();
    p.name = parameters[i].name();
    p.estimate = parameters[i].start;
    if (errors[i] > 0) p.std_error = errors[i];
  }
  const auto n = static_cast<Eigen::Index>(parameters.size());
  e.correlation = Eigen::MatrixXd::Constant(n, n, correlation);
  e.correlation.diagonal().setOnes();
  return e;
}

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};
Moments moments_of(const std::vector<Eigen::VectorXd>& points) {
  Moments m{Eigen::VectorXd::Zero(points[0].size()),
            Eigen::MatrixXd::Zero(points[0].size(), points[0].size())};
  for (const auto& x : points) m.mean += x / static_cast<double>(points.size());
  for (const auto& x : points)
    m.covariance += (x - m.mean) * (x - m.mean).transpose() / static_cast<double>(points.size() - 1);
  return m;
}

std::vector<Eigen::VectorXd> drawn_numbers(const DrawnScenes& draws, const Parameters& parameters,
                                           bool as_logarithm) {
  std::vector<Eigen::VectorXd> points;
  for (const Scene<double>& scene : draws.scenes) {
    SceneSpec<double> spec = scene.spec();
    const auto places = entry_places(spec);
    Eigen::VectorXd& x = points.emplace_back(static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double value = *places[parameters.entries()[i]];
      x[static_cast<Eigen::Index>(i)] = as_logarithm ? std::log(value) : value;
    }
  }
  return points;
}

TEST(FitPrediction, DrawsHaveTheCovarianceTheyAreDrawnFrom) {
  const Scene<double> scene(small_above_large({0.29}, {3.15, 0.5}));
  const Parameters parameters(scene, {{"shear_rate.values"}, {}, {}, {}, Shape::none});
  const Estimate estimate = estimate_of(parameters, {0.315, 0.1}, -0.6);
  constexpr std::size_t kDraws = 20000;  // sd to 0.5 %, correlation to 0.005
  const DrawnScenes draws = draw_scenes(parameters, estimate, kDraws, 3);
  ASSERT_EQ(draws.scenes.size(), kDraws);
  const Moments m = moments_of(drawn_numbers(draws, parameters, true));
  EXPECT_NEAR(m.mean[0], std::log(3.15), 0.003);
  EXPECT_NEAR(m.mean[1], std::log(0.5), 0.006);
  EXPECT_NEAR(std::sqrt(m.covariance(0, 0)), 0.1, 0.003);
  EXPECT_NEAR(std::sqrt(m.covariance(1, 1)), 0.2, 0.006);
  EXPECT_NEAR(m.covariance(0, 1) / std::sqrt(m.covariance(0, 0) * m.covariance(1, 1)), -0.6, 0.02);
  EXPECT_EQ(draw_scenes(parameters, estimate, 3, 3).scenes[2].spec().initial_breaks,
            draws.scenes[2].spec().initial_breaks);
}

// Estimated noise: Student's t, whose variance is n / (n - 2) times that of a normal number; a break varies as itself.
TEST(FitPrediction, NoiseFromFewResidualsMakesDrawsWider) {
  const Scene<double> scene(small_above_large({0.29}, {3.15, 0.5}));
  const Parameters parameters(scene, {{"initial.breaks"}, {}, {}, {}, Shape::none});
  Estimate estimate = estimate_of(parameters, {0.01}, 0);
  estimate.sigma_is_given = false;
  estimate.freedom = 6;
  const Moments m = moments_of(drawn_numbers(draw_scenes(parameters, estimate, 20000, 5), parameters, false));
  EXPECT_NEAR(m.mean[0], 0.5, 3e-4);
  EXPECT_NEAR(m.covariance(0, 0), 1e-4 * 6 / 4, 1e-5);
}

TEST(FitPrediction, AnUnknownAtItsBoundStaysThereAndOneWithoutErrorGivesNoDraws) {
  const Scene<double> scene(small_above_large({0.29}, {3.15, 0.5}));
  const Parameters parameters(scene, {{"shear_rate.values"}, {}, {}, {}, Shape::none});
  Estimate estimate = estimate_of(parameters, {0, 0.05}, 0);
  EXPECT_EQ(draw_scenes(parameters, estimate, 10, 1).why_none, "shear_rate.values[0] has no error bar");
  estimate.parameters[0].at_bound = true;
  const DrawnScenes draws = draw_scenes(parameters, estimate, 10, 1);
  ASSERT_EQ(draws.scenes.size(), 10U);
  for (const auto& x : drawn_numbers(draws, parameters, false)) {
    EXPECT_EQ(x[0], 3.15);
    EXPECT_NE(x[1], 0.5);
  }
}

// All times of a scene are proportional to 1 / s.
TEST(FitPrediction, BandsOfTimesAreThoseOfTheScale) {
  const Scene<double> scene(small_above_large({0.29}, {3.15, 0.5}));
  const Parameters parameters(scene, {{"shear_rate.scale"}, {}, {}, {}, Shape::none});
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {0.1}, 0), 4000, 11);
  const PredictedEvents events = predict_events(scene, draws, Method());
  const Timeline<double>& at = events.at_estimate;
  const double factor = std::exp(kNormal * 0.1), slack = 0.02;  // three errors of a quantile of 4000 draws
  const auto expect_band = [&](const std::optional<Interval>& band, const std::optional<double>& t) {
    ASSERT_TRUE(band && t);
    EXPECT_NEAR(band->low * factor / *t, 1, slack);
    EXPECT_NEAR(band->high / factor / *t, 1, slack);
  };
  expect_band(events.t_star, at.t_star);
  expect_band(events.t1, at.t1);
  ASSERT_EQ(events.interfaces.size(), 1U);
  expect_band(events.interfaces[0].last, at.interfaces[0].last);
  EXPECT_EQ(events.n_failed, 0U);
}

// In the fan of one layer phi = 1/2 + (z - z0) / (2 s t), a straight line in z0; at the top of the bed M is the mass.
TEST(FitPrediction, BandsOfSamplesAreThoseOfTheFan) {
  const Scene<double> scene(fan_scene());
  const Parameters parameters(scene, {{"initial.breaks"}, {}, {}, {}, Shape::none});
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {0.01}, 0), 4000, 7);
  const PredictedSamples samples = predict_samples(scene, draws, Method(), {0.4}, {0.45, 0.55, 1});
  for (const std::size_t i : {0U, 1U}) {
    const double half = kNormal * 0.01 / (2 * 0.4);
    ASSERT_TRUE(samples.phi[i].band);
    EXPECT_NEAR(samples.phi[i].value, 0.5 + ((i == 0 ? 0.45 : 0.55) - 0.5) / 0.8, 1e-12);
    EXPECT_NEAR(samples.phi[i].band->low, samples.phi[i].value - half, 0.05 * half);
    EXPECT_NEAR(samples.phi[i].band->high, samples.phi[i].value + half, 0.05 * half);
  }
  EXPECT_NEAR(samples.M[2].band->high - samples.M[2].band->low, 2 * kNormal * 0.01, 0.002);
}

// The same scale from [uncertain] of a scene file, and from a file of covariances.
TEST(FitPrediction, AnUncertainSceneHasTheBandsOfItsDeviations) {
  const std::string rest =
      "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.29]\nvalues = [3.15, 0.5]\nscale = "
      "2\n[initial]\nbreaks = [0.5]\n"
      "values = [0, 1]\n[uncertain]\n";
  const std::string folder = testing::TempDir();
  std::FILE* file = std::fopen((folder + "/prediction-covariance.csv").c_str(), "wb");
  std::fputs("shear_rate.scale,initial.breaks[0]\n0.04,0.0006\n0.0006,0.0001\n", file);
  std::fclose(file);
  const auto draws_of = [&](const std::string& uncertain) {
    const std::string text = rest + uncertain;
    const auto scene = parse_scene<double>(text, folder + "/scene.toml");
    const auto uncertainty = read_uncertainty(text, folder + "/scene.toml", scene);
    return draw_scenes(scene, uncertainty.value(), 4000, 2);
  };
  const Scene<double> scene(small_above_large({0.29}, {3.15, 0.5}));
  const Parameters parameters(scene, {{"shear_rate.scale", "initial.breaks"}, {}, {}, {}, Shape::none});
  const Moments relative = moments_of(
      drawn_numbers(draws_of("shear_rate.scale = 0.1\ninitial.breaks = [0.02]\n"), parameters, false));
  EXPECT_NEAR(std::sqrt(relative.covariance(0, 0)), 0.2, 0.02);
  EXPECT_NEAR(std::sqrt(relative.covariance(1, 1)), 0.01, 0.001);
  const Moments together =
      moments_of(drawn_numbers(draws_of("covariance = \"prediction-covariance.csv\"\n"), parameters, false));
  EXPECT_NEAR(together.covariance(0, 1) / std::sqrt(together.covariance(0, 0) * together.covariance(1, 1)),
              0.3, 0.05);
}

}  // namespace
}  // namespace shearfront::fit
