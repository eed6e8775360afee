// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/uncertainty.hpp"

namespace shearfront::fit {

void check_uncertainty(const FitSpec& spec) {
  if (spec.uncertainty.profile && spec.unknown.shape != Shape::none)
    throw InputError("uncertainty.profile", "true",
                     "must be false with unknown.shape; use uncertainty.bootstrap");
}

void add_uncertainty(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                     const Refit& refit, const Progress& progress, Estimate& estimate) {
  if (!estimate.usable() || estimate.status == Status::interrupted) return;
  const auto warn = [&](const std::vector<std::string>& texts) {
    estimate.warnings.insert(estimate.warnings.end(), texts.begin(), texts.end());
  };
  if (spec.uncertainty.profile) {
    const Profiles profiles = profile_intervals(spec, parameters, objective, estimate, progress);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      estimate.parameters[i].profile95 = profiles.intervals[i];
    warn(profiles.warnings);
  }
  if (spec.uncertainty.bootstrap > 0) {
    const Bootstrap replicates = bootstrap(spec, parameters, estimate, refit, progress);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      estimate.parameters[i].bootstrap95 = replicates.intervals[i];
    warn(replicates.warnings);
  }
}

}  // namespace shearfront::fit
