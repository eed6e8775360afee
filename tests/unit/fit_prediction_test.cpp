// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "shearfront/exact/events.hpp"
#include "shearfront/fit/prediction.hpp"
#include "shearfront/fit/scene_uncertainty.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/fit_scenes.hpp"
#include "support/own_folder.hpp"

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

// All times of a scene are proportional to 1 / s: bands are the quantiles of 1 / s over the replicates, whatever the error bar.
TEST(FitPrediction, BandsAfterABootstrapAreThoseOfItsReplicates) {
  SceneSpec<double> spec = small_above_large({0.29}, {3.15, 0.5});
  spec.scale = 2;
  const Scene<double> scene(spec);
  const Parameters parameters(scene, {{"shear_rate.scale"}, {}, {}, {}, Shape::none});
  Estimate estimate = estimate_of(parameters, {0.5}, 0);
  constexpr Eigen::Index kPredictionReplicates = 199;  // (n + 1) p is the 5th and the 195th
  estimate.replicates.resize(kPredictionReplicates, 1);
  for (Eigen::Index b = 0; b < kPredictionReplicates; ++b)
    estimate.replicates(b, 0) = 2 * (1 + 0.001 * double(b + 1));
  const DrawnScenes draws = scenes_behind(parameters, estimate, 10, 1);
  EXPECT_TRUE(draws.are_replicates);
  EXPECT_EQ(draws.scenes.size(), 199U);
  EXPECT_TRUE(draws.axes.empty());
  const PredictedEvents events = predict_events(scene, draws, Method());
  const double t_star = events.t_star.value;
  ASSERT_TRUE(events.t_star.band.has_value());
  EXPECT_NEAR(events.t_star.band->low * 1.195 / t_star, 1, 1e-12);
  EXPECT_NEAR(events.t_star.band->high * 1.005 / t_star, 1, 1e-12);
  EXPECT_FALSE(events.t_star.std_error.has_value());
  estimate.replicates.resize(0, 0);
  EXPECT_FALSE(scenes_behind(parameters, estimate, 10, 1).are_replicates);
  EXPECT_EQ(scenes_behind(parameters, estimate, 10, 1).scenes.size(), 10U);
}

// H and the mixing of a scene at t with the scale s are those at s t with the scale 1: their derivatives by s are t / s times those by t.
TEST(FitPrediction, NumbersOfTheBedHaveTheErrorOfTheirCourse) {
  SceneSpec<double> spec = small_above_large({0.29}, {3.15, 0.5});
  spec.scale = 2;
  const Scene<double> scene(spec);
  const Parameters parameters(scene, {{"shear_rate.scale"}, {}, {}, {}, Shape::none});
  const double sd = 1e-3;
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {sd}, 0), 100, 5);
  const std::vector<double> times{0.1, 0.3, 0.8};
  for (const BedFunction& bed : {bed_height_function(scene), mixing_function()}) {
    const auto at = [&](double factor) {
      SolverRequest request;
      for (const double t : times) request.times.push_back(factor * t);
      request.integrand = bed.integrand;
      std::vector<double> all;
      for (const double integral : solve(scene, Method(), request).integrals)
        for (const auto& number : bed.numbers(scene, integral)) all.push_back(number.value);
      return all;
    };
    const double h = 1e-4;
    const std::vector<double> low2 = at(1 - 2 * h), low = at(1 - h), here = at(1), high = at(1 + h),
                              high2 = at(1 + 2 * h);
    const PredictedNumbers predicted = predict_bed(scene, draws, Method(), bed, times);
    ASSERT_EQ(predicted.numbers.size(), here.size());
    EXPECT_EQ(predicted.n_by_draws, 0U);
    for (std::size_t i = 0; i < here.size(); ++i) {
      const PredictedNumber& number = predicted.numbers[i];
      const double by_log_t = (8 * (high[i] - low[i]) - (high2[i] - low2[i])) / (12 * h);
      EXPECT_EQ(number.value, here[i]);
      EXPECT_NEAR(number.std_error.value_or(0), std::abs(by_log_t) / 2 * sd, 1e-8 * sd) << i;
      ASSERT_TRUE(number.band);
      EXPECT_NEAR(number.band->high - here[i], kNormal * *number.std_error, 1e-12);
    }
  }
}

TEST(FitPrediction, ANumberOfTheBedThatStepsHasABandByDraws) {
  SceneSpec<double> spec = small_above_large({0.29}, {3.15, 0.5});
  spec.scale = 2;
  const Scene<double> scene(spec);
  const Parameters parameters(scene, {{"shear_rate.scale"}, {}, {}, {}, Shape::none});
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {0.02}, 0), 2000, 5);
  BedFunction bed = bed_height_function(scene);
  bed.numbers = [](const Scene<double>& at, double) {
    return std::vector<BedFunction::Number>{{7, 0, 0}, {at.scale() > 2 ? 1.0 : 0.0, 0, 0}};
  };
  const PredictedNumbers predicted = predict_bed(scene, draws, Method(), bed, {0.3});
  ASSERT_EQ(predicted.numbers.size(), 2U);
  EXPECT_EQ(predicted.numbers[0].band->low, 7);
  EXPECT_EQ(predicted.numbers[0].band->high, 7);
  EXPECT_EQ(predicted.numbers[1].band->low, 0);
  EXPECT_EQ(predicted.numbers[1].band->high, 1);
  EXPECT_EQ(predicted.n_by_draws, 1U);
  // A method without derivatives has draws only.
  EXPECT_EQ(predict_bed(scene, draws, Method("godunov"), bed, {0.3}).n_by_draws, 2U);
}

// All times of a scene are proportional to 1 / s: what is relative to them is the error of s.
TEST(FitPrediction, BandsOfTimesAreThoseOfTheScale) {
  const Scene<double> scene(small_above_large({0.29}, {3.15, 0.5}));
  const Parameters parameters(scene, {{"shear_rate.scale"}, {}, {}, {}, Shape::none});
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {0.1}, 0), 4000, 11);
  const PredictedEvents events = predict_events(scene, draws, Method());
  const Timeline<double>& at = events.at_estimate;
  const double factor = std::exp(kNormal * 0.1);
  const auto expect_band = [&](const PredictedNumber& number, const std::optional<double>& t, double slack) {
    ASSERT_TRUE(number.band && t);
    EXPECT_NEAR(number.band->low * factor / *t, 1, slack);
    EXPECT_NEAR(number.band->high / factor / *t, 1, slack);
  };
  ASSERT_EQ(events.interfaces.size(), 1U);
  for (const auto& [number, t] : {std::pair(events.t_star, at.t_star), std::pair(events.t1, at.t1),
                                  std::pair(events.interfaces[0].last, at.interfaces[0].last)}) {
    expect_band(number, t, 1e-11);
    EXPECT_NEAR(number.std_error.value_or(0), 0.1 * *t, 1e-11 * *t);
  }
  EXPECT_EQ(events.n_by_draws, 0U);
  // The same by draws: three errors of a quantile of 4000 of them.
  DrawnScenes without_axes = draws;
  without_axes.axes.clear();
  const PredictedEvents drawn = predict_events(scene, without_axes, Method());
  expect_band(drawn.t_star, at.t_star, 0.02);
  EXPECT_FALSE(drawn.t_star.std_error);
  EXPECT_EQ(drawn.n_by_draws, 5U);
  EXPECT_EQ(drawn.n_failed, 0U);
}

// By numbers that have no exact derivatives, as those of a flux, times and heights are differenced.
TEST(FitPrediction, UnknownsWithoutExactDerivativesAreDifferenced) {
  SceneSpec<double> spec = small_above_large({0.29}, {3.15, 0.5});
  Cubic<double> flux;
  flux.gamma = 0.2;
  spec.fluxes = {flux};
  const Scene<double> scene(spec);
  const Parameters parameters(scene, {{"flux.gamma"}, {}, {}, {}, Shape::none});
  ASSERT_FALSE(Method().has_derivative(scene, entries(spec)[parameters.entries()[0]]));
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {1e-4}, 0), 20, 5);
  const PredictedEvents events = predict_events(scene, draws, Method());
  EXPECT_EQ(events.n_by_draws, 0U);
  const double h = 1e-4;
  const auto t_star_at = [&](double gamma) {
    Cubic<double> other;
    other.gamma = gamma;
    SceneSpec<double> moved = spec;
    moved.fluxes = {other};
    return *exact_timeline(Scene<double>(moved)).t_star;
  };
  const double by_gamma = (t_star_at(0.2 + h) - t_star_at(0.2 - h)) / (2 * h);
  EXPECT_NEAR(events.t_star.std_error.value_or(0), std::abs(by_gamma) * 1e-4,
              1e-5 * std::abs(by_gamma) * 1e-4);
  EXPECT_EQ(predict_bed(scene, draws, Method(), bed_height_function(scene), {0.3}).n_by_draws, 0U);
}

// One layer, k t* = 1 + 2 sqrt(z0 (1 - z0)): with z0 and k known up to errors of correlation r, the logarithm of t* has the
// variance (g sd_z)^2 + sd_k^2 - 2 r g sd_z sd_k, g = d log t* / d z0.
TEST(FitPrediction, AnEventTimeHasTheErrorOfItsClosedForm) {
  SceneSpec<double> spec = small_above_large({}, {2.0});
  const double z0 = 0.3, sd_z = 0.004, sd_k = 0.03, r = 0.4;
  spec.initial_breaks = {z0};
  const Scene<double> scene(spec);
  const Parameters parameters(scene, {{"shear_rate.values", "initial.breaks"}, {}, {}, {}, Shape::none});
  const PredictedEvents events = predict_events(
      scene, draw_scenes(parameters, estimate_of(parameters, {2 * sd_k, sd_z}, r), 0, 1), Method());
  const double root = std::sqrt(z0 * (1 - z0)), t = (1 + 2 * root) / 2;
  const double g = (1 - 2 * z0) / root / (1 + 2 * root);
  const double expected = std::sqrt(g * g * sd_z * sd_z + sd_k * sd_k - 2 * r * g * sd_z * sd_k);
  EXPECT_NEAR(events.t_star.value, t, 1e-14);
  EXPECT_NEAR(events.t_star.std_error.value_or(0) / t, expected, 1e-10 * expected);
}

// Where the bed may be at rest already, or one of two waves is the last, no straight line leads from one time to the other.
TEST(FitPrediction, AKinkHasABandByDraws) {
  SceneSpec<double> spec = small_above_large({}, {1.0});
  const Scene<double> scene(spec);  // z0 = 1/2, where t* is largest: it has no slope there, but a curvature
  const Parameters parameters(scene, {{"initial.breaks"}, {}, {}, {}, Shape::none});
  const PredictedEvents events =
      predict_events(scene, draw_scenes(parameters, estimate_of(parameters, {0.1}, 0), 2000, 1), Method());
  EXPECT_FALSE(events.t_star.std_error);
  ASSERT_TRUE(events.t_star.band);
  EXPECT_LT(events.t_star.band->low, 1.99);
  EXPECT_LE(events.t_star.band->high, 2);
  EXPECT_GE(events.n_by_draws, 1U);
}

// A shock at rest between pure states, 2 sd from the place: phi is one state or the other, M has a slope to one side only.
TEST(FitPrediction, AShockThatMayHavePassedHasABandByDraws) {
  const Scene<double> scene(small_above_large({}, {1.0}));
  const Parameters parameters(scene, {{"initial.breaks"}, {}, {}, {}, Shape::none});
  const DrawnScenes draws = draw_scenes(parameters, estimate_of(parameters, {0.01}, 0), 2000, 3);
  const PredictedSamples at_rest = predict_samples(scene, draws, Method(), {20}, {0.1, 0.495, 0.9});
  EXPECT_EQ(at_rest.phi[0].std_error, 0);
  EXPECT_FALSE(at_rest.phi[1].std_error);
  ASSERT_TRUE(at_rest.phi[1].band);
  EXPECT_EQ(at_rest.phi[1].band->low, 0);
  EXPECT_EQ(at_rest.phi[1].band->high, 1);
  EXPECT_EQ(at_rest.phi[2].std_error, 0);
  EXPECT_NEAR(at_rest.M[2].std_error.value_or(0), 0.01, 1e-12);  // all small grains lie below
  EXPECT_EQ(at_rest.n_by_draws, 2U);
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
    EXPECT_NEAR(samples.phi[i].band->low, samples.phi[i].value - half, 1e-12);
    EXPECT_NEAR(samples.phi[i].band->high, samples.phi[i].value + half, 1e-12);
  }
  EXPECT_NEAR(samples.M[2].band->high - samples.M[2].band->low, 2 * kNormal * 0.01, 1e-12);
  EXPECT_EQ(samples.n_by_draws, 0U);
}

// The same scale from [uncertain] of a scene file, and from a file of covariances.
TEST(FitPrediction, AnUncertainSceneHasTheBandsOfItsDeviations) {
  const std::string rest =
      "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.29]\nvalues = [3.15, 0.5]\nscale = "
      "2\n[initial]\nbreaks = [0.5]\n"
      "values = [0, 1]\n[uncertain]\n";
  const std::string folder = own_folder().string();
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
