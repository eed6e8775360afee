// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/fit.hpp"
#include "shearfront/fit/model_choice.hpp"
#include "shearfront/fit/model_comparison.hpp"
#include "shearfront/fit/parameters.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

using namespace shearfront::support;

SceneSpec<double> exponential_bed() {
  SceneSpec<double> scene = small_above_large({}, {1});
  scene.shear_rate = Exponential<double>{4.2, 0.21};
  return scene;
}
Observations sums_of(const SceneSpec<double>& truth, double sigma) {
  const ObservationPlan plan{
      {0.5, 1, 2, 4}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, Quantity::cumulative, 0};
  return observed(truth, plan, sigma, 5, true);
}

TEST(FitModelChoice, StartsResembleTheScene) {
  const FitSpec base = fit_of(exponential_bed(), sums_of(exponential_bed(), 1e-3), {});
  const auto start = [&](const char* name, std::size_t n) {
    return with_model(base, {}, {name, n}, base.scene).scene;
  };
  EXPECT_NEAR(start("exponential", 0).shear_rate_at(0.3), 4.2 * std::exp(-0.3 / 0.21), 1e-3);
  EXPECT_NEAR(start("exponential", 0).shear_rate_at(0.9), 4.2 * std::exp(-0.9 / 0.21), 1e-4);
  // The harmonic mean of a layer takes as long to cross as the layer: (e^(h/d) - 1) d / (4.2 h) is its inverse.
  EXPECT_NEAR(1 / start("piecewise", 4).shear_rate_at(0.1), (std::exp(0.25 / 0.21) - 1) * 0.21 / (4.2 * 0.25),
              2e-4);
  EXPECT_NEAR(start("table", 5).shear_rate_at(0.5), 4.2 * std::exp(-0.5 / 0.21), 0.05);
}

TEST(FitModelChoice, UnknownsAreThoseOfTheModelBesideTheOthers) {
  FitSpec base = fit_of(exponential_bed(), sums_of(exponential_bed(), 1e-3), {"initial.breaks"}, {0.45});
  base.unknown.lower = {0.3};
  base.unknown.upper = {0.7};
  const auto names = [&](const ModelChoice& choice, const ModelChoice::Model& model) {
    std::string all;
    const FitSpec spec = with_model(base, choice, model, base.scene);
    for (const Parameter& p : Parameters(spec.scene, spec.unknown)) all += p.name() + " ";
    EXPECT_EQ(spec.unknown.start.back(), 0.45);
    EXPECT_EQ(spec.unknown.lower.back(), 0.3);
    return all;
  };
  EXPECT_EQ(names({}, {"exponential", 0}), "shear_rate.amplitude shear_rate.decay initial.breaks[0] ");
  EXPECT_EQ(names({}, {"piecewise", 2}), "shear_rate.values[0] shear_rate.values[1] initial.breaks[0] ");
  EXPECT_EQ(names({{}, true}, {"piecewise", 2}),
            "shear_rate.breaks[0] shear_rate.values[0] shear_rate.values[1] initial.breaks[0] ");
  EXPECT_EQ(names({{}, true}, {"table", 2}), "shear_rate.values[0] shear_rate.values[1] initial.breaks[0] ");
}

// 1, 2 and 4 equal layers are models of each other: the misfit must not rise. Data of the exponential choose it.
TEST(FitModelChoice, FinerLayersFitNoWorseAndTheTruthIsChosen) {
  FitSpec base = fit_of(exponential_bed(), sums_of(exponential_bed(), 1e-3), {});
  base.scene = Scene<double>(small_above_large({}, {1}));  // nothing is known of a
  const ModelChoice choice{{{"piecewise", 1}, {"piecewise", 2}, {"piecewise", 4}, {"exponential", 0}}, false};
  const ChosenModels models = fit_models(base, choice);
  ASSERT_EQ(models.estimates.size(), 4U);
  for (const Estimate& e : models.estimates) ASSERT_TRUE(e.usable()) << e.message;
  EXPECT_LE(models.estimates[1].misfit, models.estimates[0].misfit * (1 + 1e-9));
  EXPECT_LE(models.estimates[2].misfit, models.estimates[1].misfit * (1 + 1e-9));
  EXPECT_LT(models.estimates[3].aic.value(), models.estimates[2].aic.value());
  EXPECT_NEAR(models.estimates[3].parameters[1].estimate, 0.21, 0.01);
  // chi^2 of 36 data and 2 unknowns, 1e-6 to either side.
  EXPECT_GT(2 * models.estimates[3].misfit, 8);
  EXPECT_LT(2 * models.estimates[3].misfit, 85);
}

// A search for many breaks at once ended in wrong valleys: eight layers of ten fitted 8 times worse than now. The least misfit is no more than
// that of the truth, whose layers BIC and mBIC find.
TEST(FitModelChoice, LayersWithUnknownBreaksAreBuiltFromTheData) {
  const std::vector<double> breaks{0.2, 0.35, 0.55, 0.8}, values{2, 0.9, 1.6, 0.5, 0.25};
  const SceneSpec<double> truth = small_above_large(breaks, values);
  const ObservationPlan plan{{0.4, 0.8, 1.2, 1.8, 2.5, 3.5}, {}, Quantity::bin, 0.05};
  ObservationPlan filled = plan;
  for (int i = 0; i < 19; ++i) filled.depths.push_back(0.05 + 0.05 * i);
  FitSpec base = fit_of(truth, observed(truth, filled, 0.003, 11, true), {});
  const FitSpec true_fit = fit_of(truth, base.observations, {"shear_rate.breaks", "shear_rate.values"});
  base.scene = Scene<double>(small_above_large({}, {1}));
  ModelChoice choice{{}, true, ModelCriterion::mbic};
  for (std::size_t n = 1; n <= 6; ++n) choice.models.push_back({"piecewise", n});
  const ChosenModels models = fit_models(base, choice);
  ASSERT_EQ(models.estimates.size(), 6U);
  const Estimate at_truth = fit(true_fit);
  std::size_t best = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_TRUE(models.estimates[i].usable()) << models.estimates[i].message;
    const double before = i > 0 ? models.estimates[i - 1].misfit : HUGE_VAL;
    EXPECT_LE(models.estimates[i].misfit, before * (1 + 1e-9)) << i + 1 << " layers";
    if (*models.estimates[i].bic < *models.estimates[best].bic) best = i;
  }
  EXPECT_EQ(best, 4U);
  std::vector<std::string> names;
  std::vector<std::size_t> searched;
  for (const ModelChoice::Model& model : choice.models) {
    names.push_back(ModelChoice::text(model));
    searched.push_back(n_searched(choice, model));
  }
  EXPECT_EQ(searched, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
  const auto compared = compare_models(names, models.estimates, choice.criterion, searched);
  EXPECT_EQ(compared.front().model, "5 layers");
  EXPECT_NEAR(*compared.front().mbic, *models.estimates[4].bic + 4 * std::log(6 * 19), 1e-9);
  EXPECT_LE(models.estimates[4].misfit, at_truth.misfit * (1 + 1e-6));
  for (std::size_t i = 0; i < breaks.size(); ++i)
    EXPECT_NEAR(models.estimates[4].parameters[i].estimate, breaks[i], 0.02) << i;
}

TEST(FitModelChoice, WhatIsNoModelIsRefused) {
  EXPECT_EQ(refusal({"exponential", 0}), "");
  EXPECT_EQ(refusal({"exponential", 3}), "must be without a number");
  EXPECT_EQ(refusal({"table", 0}), "must say of how many numbers, at least 2, such as table:6");
  EXPECT_EQ(refusal({"quartic", 0}).substr(0, 15), "must be one of:");
}

}  // namespace
}  // namespace shearfront::fit
