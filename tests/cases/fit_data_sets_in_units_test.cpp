// SPDX-License-Identifier: BSD-3-Clause
// The kind of fault: a step of a difference, a tolerance or a default that has a unit. Every fit of the data sets with heights
// times L and times times T, by even powers of two: but for logarithms every operation is the same except for its exponent, and so
// is the fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "support/scene_units.hpp"

namespace shearfront::fit {
namespace {

/// What each unknown is multiplied by, arrays expanded.
std::vector<double> unknown_factors(const FitSpec& spec, double L, double T) {
  std::vector<double> factors;
  for (const std::string& name : spec.unknown.parameters)
    for (const Entry& entry : entries(spec.scene.spec()))
      if (entry.name() == name || entry.field == name) factors.push_back(support::unit_factor(entry, L, T));
  return factors;
}

FitSpec in_units(FitSpec spec, double L, double T) {
  const std::vector<double> factors = unknown_factors(spec, L, T);
  for (std::vector<double>* numbers : {&spec.unknown.start, &spec.unknown.lower, &spec.unknown.upper})
    for (std::size_t i = 0; i < numbers->size(); ++i) (*numbers)[i] *= factors.at(i);
  const Quantity quantity = spec.observations.quantity;
  const double of_value = quantity == Quantity::cumulative || quantity == Quantity::bed_height ? L : 1;
  for (Observation& o : spec.observations.rows) {
    o.t *= T;
    o.z *= L;
    o.width *= L;
    o.value *= of_value;
    o.sigma *= of_value;
  }
  spec.scene = Scene<double>(support::in_units(spec.scene.spec(), L, T));
  return spec;
}

TEST(SlowFitUnits, EveryFitOfTheDataSets) {
  std::size_t n_fits = 0;
  std::vector<std::string> files;
  for (const auto& file : std::filesystem::recursive_directory_iterator(SHEARFRONT_SOURCE_DIR "/datasets"))
    if (file.path().filename().string().starts_with("fit") && file.path().extension() == ".toml")
      files.push_back(file.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    FitSpec spec = read_fit(file);
    if (spec.scene.spec().velocity) continue;  // a chute has units of velocities besides
    spec.uncertainty = {};
    const Estimate one = fit(spec);
    const double L = std::exp2(-16), T = std::exp2(24);
    const std::vector<double> factors = unknown_factors(spec, L, T);
    const Estimate other = fit(in_units(spec, L, T));
    EXPECT_EQ(name_of(other.status), name_of(one.status));
    EXPECT_EQ(other.warnings.size(), one.warnings.size());
    ASSERT_EQ(other.parameters.size(), one.parameters.size());
    for (std::size_t i = 0; i < one.parameters.size(); ++i) {
      SCOPED_TRACE(one.parameters[i].name);
      const ParameterEstimate &found = other.parameters[i], &expected = one.parameters[i];
      EXPECT_NEAR(found.estimate / factors.at(i) / expected.estimate, 1, 1e-9);
      ASSERT_EQ(found.std_error.has_value(), expected.std_error.has_value());
      if (!expected.std_error) continue;
      // Without noise in the data the error is that of rounding itself.
      const bool is_rounding = *expected.std_error < 1e-9 * std::abs(expected.estimate);
      EXPECT_NEAR(*found.std_error / factors.at(i) / *expected.std_error, 1, is_rounding ? 0.5 : 1e-6);
    }
    ++n_fits;
  }
  EXPECT_GE(n_fits, 100U);
}

}  // namespace
}  // namespace shearfront::fit
