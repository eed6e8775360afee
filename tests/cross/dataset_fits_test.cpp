// SPDX-License-Identifier: BSD-3-Clause
// Fits of synthetic data sets find the numbers the data were made with: entries of fluxes, the scale,
// solid fraction.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/scene/entries.hpp"

namespace shearfront::fit {
namespace {

double truth(const Scene<double>& scene, const std::string& name) {
  SceneSpec<double> spec = scene.spec();
  const std::vector<Entry> all = entries(spec);
  const std::vector<double*> places = entry_places(spec);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name() == name) return *places[i];
  ADD_FAILURE() << "no entry " << name;
  return 0;
}

class DatasetFit : public testing::TestWithParam<const char*> {};

TEST_P(DatasetFit, FindsTheTruthWithinFourStandardErrors) {
  const FitSpec spec = read_fit(std::string(SHEARFRONT_SOURCE_DIR "/datasets/") + GetParam());
  const Estimate estimate = fit(spec);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  for (const ParameterEstimate& p : estimate.parameters) {
    ASSERT_TRUE(p.std_error.has_value()) << p.name;
    const double true_value = truth(spec.scene, p.name);
    EXPECT_GT(std::abs(p.start - true_value), 4 * *p.std_error) << p.name << " starts at the truth";
    EXPECT_LE(std::abs(p.estimate - true_value), 4 * *p.std_error) << p.name;
  }
  // Nothing is left but the noise the data were given: chi squared within four standard deviations.
  const double freedom = static_cast<double>(estimate.observations - estimate.parameters.size());
  EXPECT_NEAR(2 * estimate.misfit, freedom, 4 * std::sqrt(2 * freedom));
}

INSTANTIATE_TEST_SUITE_P(Synthetic, DatasetFit,
                         testing::Values("segregation-gamma-0.9/fit.toml", "settling-column/fit.toml",
                                         "packing-example-1/fit.toml", "packing-example-4/fit.toml",
                                         "packing-example-4/fit-share.toml",
                                         "may-2010-diffusion/fit-noise.toml", "chute-steady-shear/fit.toml",
                                         "chute-steady-shear/fit-bins.toml"));

}  // namespace
}  // namespace shearfront::fit
