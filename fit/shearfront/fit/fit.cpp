// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/fit/bootstrap.hpp"
#include "shearfront/fit/profile_likelihood.hpp"
#include "shearfront/fit/report.hpp"
#include "shearfront/fit/resolution_shift.hpp"
#include "shearfront/fit/staged_search.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

/// Halvings of the resolution, each four times the work; and none for data that are more exact than the model: half
/// of their residuals, or more, is its error.
constexpr int kMostRefinements = 4;
constexpr double kMostShare = 0.5;

/// With a shape the coordinates are steps between the values, whose profiles say nothing about a single value.
void check_uncertainty(const FitSpec& spec) {
  if (spec.uncertainty.profile && spec.unknown.shape != Shape::none)
    throw InputError("uncertainty.profile", "true",
                     "must be false with unknown.shape; use uncertainty.bootstrap");
}

/// Where a parameter is at a bound, intervals that take it as known are replaced by profiles.
void mind_bounds(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                 const Progress& progress, Estimate& estimate) {
  const bool has_bound = std::any_of(estimate.parameters.begin(), estimate.parameters.end(),
                                     [](const ParameterEstimate& p) { return p.at_bound; });
  if (!has_bound || !objective.has_derivatives() || !has_profiles(spec, objective)) return;
  const Profiles profiles = intervals_beside_bounds(spec, parameters, objective, estimate, progress);
  std::string names;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!profiles.intervals[i]) continue;
    ParameterEstimate& p = estimate.parameters[i];
    p.profile95 = profiles.intervals[i];
    if (p.at_bound) continue;
    p.std_error.reset();
    p.ci95.reset();
    p.check.reset();
    estimate.correlation.row(static_cast<Eigen::Index>(i)).setConstant(kUnknown);
    estimate.correlation.col(static_cast<Eigen::Index>(i)).setConstant(kUnknown);
    names += (names.empty() ? "" : ", ") + p.name;
  }
  if (!names.empty())
    estimate.warnings.push_back(names +
                                ": how far the parameters at a bound are from it matters here, so only the "
                                "profile interval is given");
  estimate.warnings.insert(estimate.warnings.end(), profiles.warnings.begin(), profiles.warnings.end());
}

/// Adds the intervals that [uncertainty] asks for, and their warnings.
void add_uncertainty(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                     const Refit& refit, const Progress& progress, Estimate& estimate) {
  if (!estimate.usable() || estimate.status == Status::interrupted) return;
  const auto warn = [&](const std::vector<std::string>& texts) {
    estimate.warnings.insert(estimate.warnings.end(), texts.begin(), texts.end());
  };
  if (parameters.size() > kMostProfiled && !spec.uncertainty.profile && spec.unknown.shape == Shape::none)
    estimate.warnings.emplace_back(
        "the intervals of so many unknowns are not checked against the misfit, and take parameters at a "
        "bound as known; uncertainty.profile = true finds better ones, which takes long");
  mind_bounds(spec, parameters, objective, progress, estimate);
  // Those asked for, and of what the plain ones are not good enough for: by derivatives they are to be had in a few evaluations.
  std::vector<bool> profiled(parameters.size(), spec.uncertainty.profile);
  if (!spec.uncertainty.profile && has_profiles(spec, objective))
    for (std::size_t i = 0; i < profiled.size(); ++i) {
      const ParameterEstimate& p = estimate.parameters[i];
      const bool is_doubtful = p.check && p.check->is_doubtful();
      profiled[i] = !p.profile95 && p.ci95 && (is_doubtful || is_barely_seen(parameters[i], p));
    }
  if (std::find(profiled.begin(), profiled.end(), true) != profiled.end()) {
    const Profiles profiles = profile_intervals(spec, parameters, objective, estimate, profiled, progress);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (profiled[i]) estimate.parameters[i].profile95 = profiles.intervals[i];
    warn(profiles.warnings);
  }
  if (spec.uncertainty.bootstrap > 0) {
    const Bootstrap replicates = bootstrap(spec, parameters, estimate, refit, progress);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      estimate.parameters[i].bootstrap95 = replicates.intervals[i];
    if (replicates.covariance.size() > 0) estimate.replicates = replicates.estimates;  // enough of them
    warn(replicates.warnings);
  }
}

Estimate report_of(const StagedSearch& search) {
  Estimate estimate =
      report(search.spec(), search.parameters(), search.objective(), search.result(), search.noise());
  if (!search.noise_warning().empty()) estimate.warnings.push_back(search.noise_warning());
  return estimate;
}

/// Goes on with a finer model while its resolution shifts the estimates by more than noise makes worth while; says
/// so, and what shift is left.
void refine(StagedSearch& search, Estimate& estimate) {
  std::string before;
  double largest = 0;  // at first
  for (int round = 0; estimate.usable() && estimate.status == Status::ok; ++round) {
    const auto fine = finer(search.spec().forward.method);
    const auto found =
        fine ? resolution_shift(search.objective(), fine->method, search.result().u, estimate) : std::nullopt;
    if (!found) break;
    Eigen::Index worst = 0;
    const double shift = found->shift.cwiseAbs().maxCoeff(&worst);
    if (round == 0) before = fmt::format("{} = {}", fine->option, number_text(fine->before)), largest = shift;
    const std::string now = fmt::format("{} = {}", fine->option, number_text(fine->before));
    // Of data that are more exact than the model the errors are the model's own, unless they are given.
    const bool has_own_noise = estimate.sigma_is_given || found->share < kMostShare;
    // Half the resolution of fronts is four times the work for a quarter of the error; twice the cells for half of it.
    const bool may_refine = round < kMostRefinements && fine->now < fine->before && has_own_noise;
    if (shift > kMostShift && may_refine && !search.must_stop()) {
      search.go_on_with(fine->method);
      estimate = report_of(search);
      continue;
    }
    if (shift > kMostShift && has_own_noise)
      estimate.warnings.push_back(fmt::format(
          "{} at {} shifts {} by about {} of its standard errors, which they do not contain: choose a "
          "finer one",
          search.spec().forward.method.name(), now, estimate.parameters[static_cast<std::size_t>(worst)].name,
          number_text(shift, 2)));
    if (round > 0)
      estimate.warnings.push_back(
          fmt::format("{} shifts the estimates by up to {} of their standard errors: they are those with {}",
                      before, number_text(largest, 2), now));
    return;
  }
}

/// Nothing but the values found.
std::optional<Eigen::VectorXd> values_of_fit(const FitSpec& spec, const Progress& progress) {
  StagedSearch search(spec, progress);
  search.find();
  return search.values();
}

}  // namespace

Estimate fit(const FitSpec& spec, const Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  StagedSearch search(spec, progress);
  check_uncertainty(spec);
  search.find();
  Estimate estimate = report_of(search);
  refine(search, estimate);
  estimate.iterations = search.iterations();
  estimate.left_out = search.left_out();
  estimate.quantity = search.quantity();
  estimate.loss = search.loss();
  add_uncertainty(search.spec(), search.parameters(), search.objective(), values_of_fit, progress, estimate);
  estimate.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return estimate;
}

}  // namespace shearfront::fit
