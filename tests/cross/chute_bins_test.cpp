// SPDX-License-Identifier: BSD-3-Clause
// Means of phi over heights of steady chutes, where M is what passes: closed forms, sums over many points, fits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/fit_scenes.hpp"

namespace shearfront {
namespace {

SceneSpec<double> binned_chute(const Velocity<double>& u, std::vector<double> breaks,
                               std::vector<double> values) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.scale = 1.0 / 3;
  spec.velocity = u;
  spec.initial_breaks = std::move(breaks);
  spec.initial_values = std::move(values);
  return spec;
}
ObservationPlan ten_bins(std::vector<double> distances) {
  ObservationPlan plan{std::move(distances), {}, Quantity::bin, 0.1};
  for (int i = 0; i < 10; ++i) plan.depths.push_back(0.05 + 0.1 * i);
  return plan;
}
Observations bins_of(const SceneSpec<double>& spec, const ObservationPlan& plan, const Method& method) {
  const Scene<double> scene(spec);
  const SolverResult result = solve(scene, method, request_of(plan, scene));
  EXPECT_TRUE(result.summary.usable()) << result.summary.message;
  return observe(plan, scene, result);
}

TEST(ChuteBins, OfPlugFlowAreThoseOfTheBed) {
  for (const double speed : {1.0, 2.5}) {
    SceneSpec<double> bed = binned_chute(UniformVelocity<double>{speed}, {0.4}, {0.25, 0.75}), chute = bed;
    bed.velocity.reset();
    const ObservationPlan along = ten_bins({0.3, 1.1, 2.7}),
                          in_time = ten_bins({0.3 / speed, 1.1 / speed, 2.7 / speed});
    const Observations is = bins_of(chute, along, "exact"), should = bins_of(bed, in_time, "exact");
    ASSERT_EQ(is.rows.size(), should.rows.size());
    EXPECT_TRUE(is.units.is_chute);
    for (std::size_t i = 0; i < is.rows.size(); ++i)
      EXPECT_NEAR(is.rows[i].value, should.rows[i].value, 2e-14);
  }
}

/// u = 2 z, so that psi = z^2. Mixed inflow phi_in: pure grains up to psi = s phi_in x, none above psi = 1 - s (1 - phi_in) x.
TEST(ChuteBins, OfSimpleShearHaveTheClosedFormOfMixedInflow) {
  const double phi_in = 0.6, s = 1.0 / 3;
  const ObservationPlan plan = ten_bins({0.2, 1, 2.5});
  const Observations is = bins_of(binned_chute(LinearVelocity<double>{0, 2}, {}, {phi_in}), plan, "exact");
  for (const Observation& o : is.rows) {
    const double pure = std::sqrt(s * phi_in * o.t), none = std::sqrt(1 - s * (1 - phi_in) * o.t);
    const auto volume = [&](double z) {
      return std::min(z, pure) + phi_in * (std::clamp(z, pure, none) - pure);
    };
    EXPECT_NEAR(o.value, (volume(o.z + 0.05) - volume(o.z - 0.05)) / 0.1, 1e-11) << o.t << " " << o.z;
  }
}

/// Small grains above z = 0.4 spread as a fan, phi = 1/2 + (z^2 - 0.16) / (2 s x).
TEST(ChuteBins, OfSimpleShearHaveTheClosedFormOfAFan) {
  const double psi0 = 0.16, s = 1.0 / 3;
  const ObservationPlan plan = ten_bins({0.1, 0.3, 0.45});
  const Observations is = bins_of(binned_chute(LinearVelocity<double>{0, 2}, {0.4}, {0, 1}), plan, "exact");
  for (const Observation& o : is.rows) {
    const double r = s * o.t, low = std::sqrt(psi0 - r), high = std::sqrt(psi0 + r);
    const auto volume = [&](double z) {
      const double end = std::clamp(z, low, high);
      const auto fan = [&](double y) { return y / 2 + (y * y * y / 3 - psi0 * y) / (2 * r); };
      return fan(end) - fan(low) + std::max(0.0, z - high);
    };
    EXPECT_NEAR(o.value, (volume(o.z + 0.05) - volume(o.z - 0.05)) / 0.1, 1e-11) << o.t << " " << o.z;
  }
}

/// Every method, and what varies with height: the sum of phi at many heights, and all that lies in the chute where phi is 1.
TEST(ChuteBins, AreSumsOfPhiByEveryMethod) {
  const auto with_rate = [](const Velocity<double>& u, const DepthFunction<double>& a) {
    SceneSpec<double> spec = binned_chute(u, {0.5}, {0.1, 0.9});
    spec.shear_rate = a;
    return spec;
  };
  std::vector<SceneSpec<double>> specs{
      with_rate(TableVelocity<double>{{0, 0.5, 1}, {0, 0.8, 1.2}}, Piecewise<double>{{0.35}, {1, 0.4}}),
      with_rate(LinearVelocity<double>{0.2, 1.5}, Exponential<double>{2, 0.5})};
  for (std::size_t i = 0; i < 2; ++i) {
    specs.push_back(specs[i]);
    specs.back().diffusion = Diffusion<double>{0.02, {}, false};
  }
  std::size_t n_methods = 0;
  for (const SceneSpec<double>& spec : specs)
    for (const std::string& name : Method::names()) {
      const Scene<double> scene(spec);
      const Method method(name);
      if (!method.refusal(scene).empty()) continue;
      SCOPED_TRACE(name);
      ++n_methods;
      constexpr std::size_t kPoints = 2000;
      SolverRequest request;
      request.times = {0.4};
      for (std::size_t i = 0; i < kPoints; ++i)
        request.heights.push_back((static_cast<double>(i) + 0.5) / kPoints);
      const SolverResult at = solve(scene, method, request);
      ASSERT_TRUE(at.summary.usable()) << at.summary.message;
      const Observations bins = bins_of(spec, ten_bins({0.4}), method);
      for (std::size_t k = 0; k < bins.rows.size(); ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < kPoints / 10; ++i) sum += at.phi(0, k * kPoints / 10 + i);
        EXPECT_NEAR(bins.rows[k].value, sum / (kPoints / 10), 3e-3) << k;
      }
    }
  EXPECT_GE(n_methods, 12u);
}

/// Volumes of a state that fills the chute are heights, to rounding, whatever flows.
TEST(ChuteBins, OfPureGrainsAreFull) {
  SceneSpec<double> spec = binned_chute(TableVelocity<double>{{0, 0.5, 1}, {0, 0.8, 0.3}}, {}, {1});
  spec.shear_rate = Exponential<double>{2, 0.5};
  for (const Observation& o : bins_of(spec, ten_bins({0.4, 3}), "exact").rows) EXPECT_NEAR(o.value, 1, 1e-13);
}

}  // namespace

namespace fit {
namespace {

/// Bins without noise: the numbers they were made with, of the bed and of the flow.
TEST(ChuteBins, OfTheTruthGiveItBack) {
  SceneSpec<double> truth = binned_chute(LinearVelocity<double>{0.3, 1.4}, {0.5}, {0, 1});
  truth.shear_rate = Piecewise<double>{{0.4}, {1.5, 0.6}};
  const std::vector<double> is{1.5, 0.6, 1.4};
  const Estimate estimate =
      fit(support::fit_of(truth, bins_of(truth, ten_bins({0.2, 0.5, 0.9, 1.4, 2}), "exact"),
                          {"shear_rate.values", "velocity.slope"}, {1, 1, 1}));
  ASSERT_TRUE(estimate.usable()) << estimate.message;
  ASSERT_EQ(estimate.parameters.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(estimate.parameters[i].estimate, is[i], 1e-6) << estimate.parameters[i].name;
}

/// With noise: within four standard errors, and nothing is left but the noise.
TEST(ChuteBins, WithNoiseGiveTheTruthWithinItsErrors) {
  SceneSpec<double> truth = binned_chute(LinearVelocity<double>{0, 2}, {}, {0.6});
  Observations data = bins_of(truth, ten_bins({0.4, 0.9, 1.4, 1.9, 2.4}), "exact");
  add_noise(data, 0.01, 7);
  const Estimate estimate =
      fit(support::fit_of(truth, data, {"shear_rate.scale", "initial.values[0]"}, {0.5, 0.5}));
  ASSERT_TRUE(estimate.usable()) << estimate.message;
  const std::vector<double> is{1.0 / 3, 0.6};
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(estimate.parameters[i].std_error);
    EXPECT_NEAR(estimate.parameters[i].estimate, is[i], 4 * *estimate.parameters[i].std_error);
    EXPECT_LT(*estimate.parameters[i].std_error, 0.01);
  }
  const double freedom = static_cast<double>(estimate.observations) - 2;
  EXPECT_NEAR(2 * estimate.misfit, freedom, 4 * std::sqrt(2 * freedom));
  // What is said to be predicted is what was compared.
  double chi2 = 0;
  for (std::size_t i = 0; i < data.rows.size(); ++i)
    chi2 += std::pow((estimate.predicted[i] - data.rows[i].value) / 0.01, 2);
  EXPECT_NEAR(chi2, 2 * estimate.misfit, 1e-6 * chi2);
  ASSERT_TRUE(estimate.structure);
  EXPECT_FALSE(estimate.structure->is_structured);
}

}  // namespace
}  // namespace fit
}  // namespace shearfront
