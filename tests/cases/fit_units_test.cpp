// SPDX-License-Identifier: BSD-3-Clause
// The kind of fault: a step of a difference, or a tolerance, that has a unit. A fit was right in a bed of height 1
// and had no error bars at 0.03. Here heights are multiplied by a number and times by another, data, start and scene
// alike: what comes out must be multiplied with them, by powers of two to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

struct UnitsCase {
  std::string name, method;
  Quantity quantity;
  bool has_sigma;
  bool is_smooth = true;  ///< false: the misfit jumps with the rounding of the number of time steps
  /// Of error bars; those from differences follow the noise of the model, which rounding changes, through the step.
  double error_tolerance = 1e-9;
};

void PrintTo(const UnitsCase& c, std::ostream* out) { *out << c.name; }

/// Heights times L, times times T. Unknown: both rates and the break between them.
FitSpec in_units(const UnitsCase& c, double L, double T) {
  SceneSpec<double> truth = support::small_above_large({0.29}, {2.4, 0.31});
  const ObservationPlan plan{{0.5, 1.1, 1.7, 2.9, 4.0},
                             {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9},
                             c.quantity,
                             c.quantity == Quantity::bin ? 0.1 : 0};
  Observations data = support::observed(truth, plan, 0.01, 7, c.has_sigma);
  const double of_value = c.quantity == Quantity::cumulative ? L : 1;
  for (Observation& o : data.rows) {
    o.t *= T;
    o.z *= L;
    o.width *= L;
    o.value *= of_value;
    o.sigma *= of_value;
  }
  SceneSpec<double> scene = support::small_above_large({0.29 * L}, {2.4 * (L / T), 0.31 * (L / T)});
  scene.initial_breaks = {0.5 * L};
  scene.top = L;
  FitSpec spec = support::fit_of(scene, std::move(data), {"shear_rate.values", "shear_rate.breaks"},
                                 {2 * (L / T), 0.4 * (L / T), 0.33 * L});
  spec.forward.method = Method(c.method);
  if (c.method == "godunov") spec.forward.method.set("cells", std::uint64_t{60});
  if (c.method == "front-tracking") spec.forward.method.set("resolution", 0.02);
  spec.forward.method.prefer_smooth(spec.scene);
  return spec;
}

/// Estimates, then standard errors, in the units of L = T = 1.
std::vector<double> numbers(const Estimate& estimate, double L, double T) {
  std::vector<double> all;
  for (const bool is_error : {false, true})
    for (std::size_t i = 0; i < estimate.parameters.size(); ++i) {
      const ParameterEstimate& p = estimate.parameters[i];
      EXPECT_TRUE(p.std_error.has_value()) << p.name << " has no error bar";
      const double x = is_error ? p.std_error.value_or(NAN) : p.estimate;
      all.push_back(x / (i < 2 ? L / T : L));
    }
  return all;
}

class FitUnits : public testing::TestWithParam<UnitsCase> {};

TEST_P(FitUnits, EstimatesScaleWithHeightAndTime) {
  const Estimate one = fit(in_units(GetParam(), 1, 1));
  ASSERT_EQ(one.status, Status::ok) << one.message;
  const std::vector<double> expected = numbers(one, 1, 1);
  std::size_t compared = 0;
  const auto compare = [&](double L, double T, double tolerance) {
    SCOPED_TRACE("L = " + std::to_string(std::log10(L)) + ", T = " + std::to_string(std::log10(T)) +
                 " (powers of ten)");
    const Estimate other = fit(in_units(GetParam(), L, T));
    ASSERT_EQ(other.status, Status::ok) << other.message;
    EXPECT_EQ(other.warnings.size(), one.warnings.size());
    const std::vector<double> found = numbers(other, L, T);
    for (std::size_t i = 0; i < expected.size(); ++i, ++compared)
      EXPECT_NEAR(found[i], expected[i],
                  (tolerance > 0 && i >= 3 ? GetParam().error_tolerance : tolerance) * std::abs(expected[i]))
          << i;
  };
  for (const auto& [k, m] : {std::pair{-30, 0}, {30, 0}, {0, 30}, {-17, 23}})
    compare(std::exp2(k), std::exp2(m), 0);
  if (GetParam().is_smooth)
    for (const auto& [k, m] : {std::pair{-9, 0}, {9, 0}, {0, -9}, {0, 9}, {-9, 9}, {4, -7}})
      compare(std::pow(10.0, k), std::pow(10.0, m), 1e-9);
  EXPECT_GE(compared, 4 * expected.size());
}

INSTANTIATE_TEST_SUITE_P(
    All, FitUnits,
    testing::Values(UnitsCase{"ExactBins", "exact", Quantity::bin, true},
                    UnitsCase{"ExactBinsWithoutSigma", "exact", Quantity::bin, false},
                    UnitsCase{"ExactSumsWithoutSigma", "exact", Quantity::cumulative, false},
                    UnitsCase{"ExactPointsWithoutSigma", "exact", Quantity::point, false},
                    UnitsCase{"TrackedBins", "front-tracking", Quantity::bin, true},
                    UnitsCase{"TrackedSumsWithoutSigma", "front-tracking", Quantity::cumulative, false},
                    UnitsCase{"GodunovBins", "godunov", Quantity::bin, true, false},
                    UnitsCase{"GodunovSumsWithoutSigma", "godunov", Quantity::cumulative, false, false}),
    [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace shearfront::fit
