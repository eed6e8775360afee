// SPDX-License-Identifier: BSD-3-Clause
// The fits of the two particle simulations of datasets/ by the law of segregation, beside those of a free scale: the tables of
// docs/evidence/rheology.md, and what is said there.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/fit_file.hpp"

namespace shearfront::fit {
namespace {

/// rms of the residuals as printed, and the estimates, by `shearfront fit` to as many digits as the page has of them and one more.
struct ParticleFit {
  const char *data, *file;
  double rms;
  std::vector<double> estimates;
  friend void PrintTo(const ParticleFit& x, std::ostream* out) { *out << x.data << " " << x.file; }
};

Estimate particle_fit(const std::string& data, const std::string& file) {
  return fit(read_fit(SHEARFRONT_SOURCE_DIR "/datasets/dem-shear-cell-" + data + "/fit-" + file + ".toml"));
}
double rms_of(const Estimate& estimate) {
  return estimate.residual_norm / std::sqrt(static_cast<double>(estimate.observations));
}

class SlowParticleFit : public testing::TestWithParam<ParticleFit> {};

TEST_P(SlowParticleFit, HasThePrintedNumbers) {
  const ParticleFit& should = GetParam();
  const Estimate estimate = particle_fit(should.data, should.file);
  ASSERT_TRUE(estimate.usable()) << estimate.message;
  EXPECT_NEAR(rms_of(estimate), should.rms, 1e-4);
  ASSERT_EQ(estimate.parameters.size(), should.estimates.size());
  for (std::size_t i = 0; i < should.estimates.size(); ++i)
    EXPECT_NEAR(estimate.parameters[i].estimate, should.estimates[i], 2e-3 * should.estimates[i])
        << estimate.parameters[i].name;
}

INSTANTIATE_TEST_SUITE_P(
    DemShearCells, SlowParticleFit,
    testing::Values(ParticleFit{"piecewise", "diffusion", 0.1098, {0.03157, 0.04938}},
                    ParticleFit{"piecewise", "scaling", 0.1242, {0.1405, 0.05965}},
                    ParticleFit{"piecewise", "scaling-cubic", 0.1094, {0.3203, 0.0487, 1}},
                    ParticleFit{"piecewise", "early-diffusion", 0.0681, {0.06895, 0.03523}},
                    ParticleFit{"piecewise", "early-scaling", 0.0762, {0.0005, 0.09356}},  // B at its bound
                    ParticleFit{"piecewise", "early-scaling-cubic", 0.0541, {0.6606, 0.03434, 1}},
                    ParticleFit{"piecewise", "inner-diffusion", 0.0654, {0.02122, 0.06766}},
                    ParticleFit{"piecewise", "inner-scaling", 0.0653, {0.1222, 0.0639}},
                    ParticleFit{"piecewise", "inner-scaling-cubic", 0.0623, {0.2199, 0.06624, 0.9217}},
                    ParticleFit{"exponential", "diffusion", 0.1028, {0.03358, 0.05389}},
                    ParticleFit{"exponential", "scaling", 0.1167, {0.1668, 0.06078}},
                    ParticleFit{"exponential", "scaling-cubic", 0.1026, {0.3511, 0.04476, 1}},
                    ParticleFit{"exponential", "early-diffusion", 0.0582, {0.09292, 0.01621}},
                    ParticleFit{"exponential", "early-scaling", 0.0808, {0.0481, 0.08962}},
                    ParticleFit{"exponential", "early-scaling-cubic", 0.0443, {0.7402, 0.02447, 0.9387}},
                    ParticleFit{"exponential", "inner-diffusion", 0.0622, {0.02943, 0.06501}},
                    ParticleFit{"exponential", "inner-scaling", 0.0623, {0.1599, 0.06138}},
                    ParticleFit{"exponential", "inner-scaling-cubic", 0.0547, {0.3167, 0.0601, 1}}),
    [](const auto& at) {
      std::string name = std::string(at.param.data) + "_" + at.param.file;
      for (char& c : name)
        if (c == '-') c = '_';
      return name;
    });

/// The search from elsewhere comes to the same: the numbers are those of the data, not of the start.
TEST(SlowParticleFits, DoNotDependOnTheStart) {
  for (const char* data : {"piecewise", "exponential"})
    for (const char* file : {"diffusion", "inner-diffusion", "early-diffusion", "scaling", "inner-scaling"}) {
      SCOPED_TRACE(std::string(data) + " " + file);
      FitSpec spec = read_fit(std::string(SHEARFRONT_SOURCE_DIR "/datasets/dem-shear-cell-") + data +
                              "/fit-" + file + ".toml");
      const Estimate from_file = fit(spec);
      for (double& x : spec.unknown.start) x *= 1.7;
      const Estimate from_elsewhere = fit(spec);
      ASSERT_TRUE(from_file.usable() && from_elsewhere.usable());
      EXPECT_NEAR(rms_of(from_elsewhere), rms_of(from_file), 1e-5);
      for (std::size_t i = 0; i < from_file.parameters.size(); ++i)
        EXPECT_NEAR(from_elsewhere.parameters[i].estimate, from_file.parameters[i].estimate,
                    5e-3 * from_file.parameters[i].estimate)
            << from_file.parameters[i].name;
    }
}

}  // namespace
}  // namespace shearfront::fit
