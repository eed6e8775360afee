// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

using namespace shearfront::support;
const std::vector<double> kHeights{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};

FitSpec layers(const SceneSpec<double>& truth, std::vector<double> times, double sigma,
               bool with_sigma = true) {
  return fit_of(truth,
                observed(truth, {std::move(times), kHeights, Quantity::bin, 0.1}, sigma, 5, with_sigma),
                {"shear_rate.values"});
}

void expect_warning(const Estimate& e, std::string_view text) {
  std::string all;
  for (const std::string& w : e.warnings) all += w + "\n";
  EXPECT_NE(all.find(text), std::string::npos) << all;
}
void expect_only_warning(const Estimate& e, const std::string& text) {
  EXPECT_EQ(e.warnings, std::vector<std::string>{text});
}

void expect_no_error_bar(const ParameterEstimate& p) {
  EXPECT_FALSE(p.std_error) << p.name;
  EXPECT_FALSE(p.ci95) << p.name;
}

TEST(FitWarnings, NoneForAGoodFit) {
  for (const bool with_sigma : {true, false}) {
    const Estimate e = fit(layers(small_above_large({0.29}, {3.15, 0.5}), {0.5, 1, 2, 3}, 0.01, with_sigma));
    EXPECT_EQ(e.warnings, std::vector<std::string>{});
    for (const ParameterEstimate& p : e.parameters) EXPECT_TRUE(p.std_error && p.ci95 && !p.at_bound);
    EXPECT_NEAR(e.correlation(0, 0), 1, 0);
    EXPECT_LE(std::abs(e.correlation(0, 1)), 1);
  }
}

TEST(FitWarnings, AtABound) {
  FitSpec spec = layers(small_above_large({0.29}, {3.15, 0.5}), {0.5, 1, 2, 3}, 0.01);
  spec.unknown.start = {2, 0.4};
  spec.unknown.lower = {0.1, 0.1};
  spec.unknown.upper = {2.5, 20};
  const Estimate e = fit(spec);
  expect_warning(e,
                 "shear_rate.values[0] is at its upper bound 2.5: it has no error bar, and those "
                 "of the others take it as known");
  EXPECT_TRUE(e.parameters[0].at_bound);
  expect_no_error_bar(e.parameters[0]);
  EXPECT_TRUE(e.parameters[1].std_error);
  EXPECT_TRUE(std::isnan(e.correlation(0, 1)));
}

TEST(FitWarnings, AnActiveShape) {
  FitSpec spec = layers(small_above_large({0.3, 0.55}, {1, 2, 1}), {0.5, 1, 2, 3}, 0.01);
  spec.unknown.start = {3, 2, 1};
  spec.unknown.shape = Shape::decreasing;
  const Estimate e = fit(spec);
  expect_warning(e,
                 "shear_rate.values[0] and [1] are equal: the shape decreasing is active there and "
                 "they have no error bars");
  expect_no_error_bar(e.parameters[0]);
  expect_no_error_bar(e.parameters[1]);
  EXPECT_TRUE(e.parameters[2].std_error);
}

TEST(FitWarnings, AnUnseenLayer) {
  // A layer above all data that no wave has left yet. With noise 0.01 the first has an open interval.
  const auto truth = small_above_large({0.3, 0.8}, {1, 2, 1.5});
  FitSpec spec = fit_of(
      truth,
      observed(truth, {{0.1, 0.14}, {0.2, 0.25, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.7}, Quantity::bin, 0.05},
               0.001, 1, true),
      {"shear_rate.values"});
  const Estimate e = fit(spec);
  expect_only_warning(e, "shear_rate.values[2] is not seen by these data: no observation depends on it");
  expect_no_error_bar(e.parameters[2]);
  EXPECT_TRUE(e.parameters[0].std_error && e.parameters[1].std_error);
  EXPECT_EQ(e.parameters[2].estimate, 1.5);
}

TEST(FitWarnings, AnIntervalThatIsNotToBeTrusted) {
  // Sums over z: the profile interval of the lower rate ends 1.54 times as far above it, in the logarithm.
  FitSpec spec = layers(small_above_large({0.29}, {3.15, 0.5}), {0.5, 1, 2, 3}, 0.01);
  spec.misfit.quantity = "cumulative";
  std::optional<Interval> profile;
  for (const bool is_asked_for : {true, false}) {
    spec.uncertainty.profile = is_asked_for;
    const Estimate e = fit(spec);
    expect_warning(e, "do not trust the 95 % interval of shear_rate.values[0], ");
    expect_warning(
        e, "the misfit is no parabola, its upper end should be farther off; believe its profile interval");
    EXPECT_FALSE(e.parameters[1].check->is_doubtful());
    // With derivatives it is there without being asked for, and the same.
    ASSERT_TRUE(e.parameters[0].profile95);
    EXPECT_EQ(e.parameters[1].profile95.has_value(), is_asked_for);
    if (is_asked_for) profile = e.parameters[0].profile95;
    EXPECT_EQ(e.parameters[0].profile95->low, profile->low);
    EXPECT_EQ(e.parameters[0].profile95->high, profile->high);
    EXPECT_GT(profile->high, 1.2 * e.parameters[0].ci95->high);
  }
  spec.forward.method = Method("muscl");  // has no derivatives
  spec.forward.method.set("cells", std::uint64_t{300});
  const Estimate e = fit(spec);
  expect_warning(e, "ask for uncertainty.profile = true");
  EXPECT_FALSE(e.parameters[0].profile95);
}

TEST(FitWarnings, DataBeforeTheFirstWave) {
  const auto truth = small_above_large({0.3, 0.8}, {1, 2, 1.5});
  const Estimate e =
      fit(fit_of(truth, observed(truth, {{0.01}, {0.1, 0.2, 0.7, 0.8}, Quantity::bin, 0.05}, 0.01, 1, true),
                 {"shear_rate.values"}));
  expect_only_warning(e, "shear_rate.values are not seen by these data: no observation depends on them");
  for (const ParameterEstimate& p : e.parameters) expect_no_error_bar(p);
}

TEST(FitWarnings, ScaleAndAllValuesAreConfounded) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  for (const char* method : {"exact", "front-tracking"}) {
    SCOPED_TRACE(method);
    FitSpec spec = layers(truth, {0.5, 1, 2, 3}, 0.01);
    spec.unknown.parameters = {"shear_rate.scale", "shear_rate.values"};
    spec.forward.method = method;
    const Estimate e = fit(spec);
    expect_only_warning(
        e,
        "shear_rate.scale and shear_rate.values cannot be determined together: the data do not "
        "change along shear_rate.scale * (1 + e), shear_rate.values[0] * (1 - e), "
        "shear_rate.values[1] * (1 - e) for small e; fix one of them");
    for (const ParameterEstimate& p : e.parameters) expect_no_error_bar(p);
  }
}

TEST(FitWarnings, TooFewData) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  const auto two = [&](bool with_sigma) {
    return fit(fit_of(truth, observed(truth, {{1}, {0.2, 0.6}, Quantity::cumulative, 0}, 1e-3, 1, with_sigma),
                      {"shear_rate.values"}));
  };
  const Estimate e = two(false);
  expect_warning(e,
                 "2 observations for 2 unknowns leave nothing to estimate the noise from: there are "
                 "no error bars; give sigma with the data");
  for (const ParameterEstimate& p : e.parameters) expect_no_error_bar(p);
  for (const ParameterEstimate& p : two(true).parameters) EXPECT_TRUE(p.std_error) << p.name;
}

TEST(FitWarnings, SigmaTooSmallAndTooLarge) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  FitSpec spec = layers(truth, {0.5, 0.7, 1, 1.5, 2, 2.5, 3, 4, 5}, 0.02);
  for (Observation& o : spec.observations.rows) o.sigma = 0.01;
  expect_warning(fit(spec), "times larger than their sigma (reduced chi^2 ");
  expect_warning(fit(spec), "sigma is too small, and so are the error bars");
  spec.misfit.loss = "huber";
  expect_warning(fit(spec), "times larger than their sigma (square of their median");
  spec.misfit.loss = "squared";
  for (Observation& o : spec.observations.rows) o.sigma = 0.04;
  expect_warning(fit(spec), "times smaller than their sigma");
  expect_warning(fit(spec), "sigma is too large, and so are the error bars");
}

TEST(FitWarnings, AWrongModel) {
  SceneSpec<double> truth = small_above_large({}, {1});
  truth.shear_rate = Exponential<double>{4.24, 0.205};
  FitSpec spec = layers(truth, {0.5, 1, 2, 3}, 0.01, false);
  spec.scene = Scene<double>(small_above_large({0.29}, {3, 0.5}));
  const Estimate e = fit(spec);
  expect_warning(e,
                 "the model does not describe these data, or their noise is not "
                 "independent: residuals (rms 0.");
  ASSERT_TRUE(e.structure);
  EXPECT_TRUE(e.structure->is_structured);
}

TEST(FitWarnings, BarelySeen) {
  const auto truth = small_above_large({0.29}, {3.15, 0.5});
  const Estimate e = fit(layers(truth, {0.5, 1, 2, 3}, 0.02));
  expect_warning(e, "shear_rate.values[0] is barely seen by these data: its standard error ");
}

TEST(FitWarnings, AnotherQuantityThanMeasured) {
  FitSpec spec = layers(small_above_large({0.29}, {3.15, 0.5}), {0.5, 1, 2, 3}, 0.001);
  spec.misfit.quantity = "cumulative";
  expect_only_warning(
      fit(spec),
      "the data are bin values but are compared as cumulative: their noise is then correlated, "
      "which the error bars account for; misfit.quantity = \"bin\" uses them as they are");
}

}  // namespace
}  // namespace shearfront::fit
