// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prediction.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/random/chi_squared_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/fit/quantile.hpp"

namespace shearfront::fit {
namespace {

constexpr std::size_t kMostRefusedPerScene = 20;

/// The unknowns that vary, and a root of their correlation.
struct Spread {
  std::vector<std::size_t> unknowns;
  Eigen::MatrixXd root;
};

std::optional<Spread> spread_of(const Estimate& estimate, std::string& why_none) {
  Spread spread;
  for (std::size_t i = 0; i < estimate.parameters.size(); ++i) {
    const ParameterEstimate& p = estimate.parameters[i];
    if (p.std_error && *p.std_error > 0) spread.unknowns.push_back(i);
    if (p.std_error || p.is_held()) continue;
    why_none = p.name + " has no error bar";
    return std::nullopt;
  }
  const auto n = static_cast<Eigen::Index>(spread.unknowns.size());
  Eigen::MatrixXd correlation(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      correlation(i, j) =
          i == j
              ? 1
              : estimate.correlation(static_cast<Eigen::Index>(spread.unknowns[static_cast<std::size_t>(i)]),
                                     static_cast<Eigen::Index>(spread.unknowns[static_cast<std::size_t>(j)]));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation);
  spread.root = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  return spread;
}

std::optional<Interval> band_of(std::vector<double> numbers) {
  if (numbers.size() < 2) return std::nullopt;
  std::sort(numbers.begin(), numbers.end());
  return Interval{quantile(numbers, 0.025), quantile(numbers, 0.975)};
}

/// Solves every drawn scene; take(result) for those that have a result. Returns how many have none.
template <class Take>
std::size_t solve_all(const DrawnScenes& draws, const Method& method, const SolverRequest& request,
                      const Progress& progress, Take&& take) {
  std::size_t n_failed = 0;
  for (std::size_t i = 0; i < draws.scenes.size(); ++i) {
    const SolverResult result = solve(draws.scenes[i], method, request);
    if (result.summary.usable())
      take(result);
    else
      ++n_failed;
    if (progress && !progress(i + 1, 0)) break;
  }
  return n_failed;
}

}  // namespace

DrawnScenes draw_scenes(const Parameters& parameters, const Estimate& estimate, std::size_t n,
                        std::uint64_t seed) {
  DrawnScenes draws;
  const auto spread = spread_of(estimate, draws.why_none);
  if (!spread) return draws;
  boost::random::mt19937_64 generator(seed);
  boost::random::normal_distribution<double> normal;
  const bool has_estimated_noise = !estimate.sigma_is_given && estimate.freedom > 0;
  boost::random::chi_squared_distribution<double> chi_squared(has_estimated_noise ? estimate.freedom : 1);
  const auto n_unknowns = static_cast<Eigen::Index>(spread->unknowns.size());
  while (draws.scenes.size() < n) {
    Eigen::VectorXd independent(n_unknowns);
    for (double& x : independent) x = normal(generator);
    if (has_estimated_noise) independent /= std::sqrt(chi_squared(generator) / estimate.freedom);
    const Eigen::VectorXd errors = spread->root * independent;
    Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = estimate.parameters[i].estimate;
    for (Eigen::Index k = 0; k < n_unknowns; ++k) {
      const std::size_t i = spread->unknowns[static_cast<std::size_t>(k)];
      const ParameterEstimate& p = estimate.parameters[i];
      const double error = *p.std_error * errors[k];
      values[static_cast<Eigen::Index>(i)] = parameters[i].entry.range == Range::positive
                                                 ? p.estimate * std::exp(error / p.estimate)
                                                 : p.estimate + error;
    }
    std::string failure;
    std::optional<Scene<double>> scene;
    if (values.allFinite()) scene = parameters.scene_at(values, failure);
    if (scene) {
      draws.scenes.push_back(std::move(*scene));
    } else if (++draws.n_refused > kMostRefusedPerScene * n) {
      draws.scenes.clear();
      draws.why_none = fmt::format("hardly a draw from the error bars is a valid scene ({})", failure);
      return draws;
    }
  }
  return draws;
}

PredictedSamples predict_samples(const Scene<double>& estimated, const DrawnScenes& draws,
                                 const Method& method, const std::vector<double>& times,
                                 const std::vector<double>& heights, const Progress& progress) {
  SolverRequest request;
  request.times = times;
  request.heights = heights;
  const SolverResult at_estimate = solve(estimated, method, request);
  if (!at_estimate.summary.usable())
    throw InputError(std::string(method.name()), "",
                     "has no solution at the estimate: " + at_estimate.summary.message);
  const std::size_t n = at_estimate.samples.size();
  std::vector<std::vector<double>> phi(n), M(n);
  PredictedSamples result;
  result.n_failed = solve_all(draws, method, request, progress, [&](const SolverResult& drawn) {
    for (std::size_t i = 0; i < n; ++i) {
      phi[i].push_back(drawn.samples[i].phi);
      M[i].push_back(drawn.samples[i].M);
    }
  });
  for (std::size_t i = 0; i < n; ++i) {
    result.phi.push_back({at_estimate.samples[i].phi, band_of(std::move(phi[i]))});
    result.M.push_back({at_estimate.samples[i].M, band_of(std::move(M[i]))});
  }
  return result;
}

PredictedEvents predict_events(const Scene<double>& estimated, const DrawnScenes& draws, const Method& method,
                               const Progress& progress) {
  SolverRequest request;
  request.timeline = true;
  const SolverResult at_estimate = solve(estimated, method, request);
  if (!at_estimate.summary.usable() || !at_estimate.timeline)
    throw InputError(std::string(method.name()), "",
                     "has no event times at the estimate: " + at_estimate.summary.message);
  PredictedEvents result;
  result.at_estimate = *at_estimate.timeline;
  const std::size_t n = result.at_estimate.interfaces.size();
  std::vector<double> t0, t1, t_star;
  std::vector<std::vector<double>> first(n), last(n);
  result.n_failed = solve_all(draws, method, request, progress, [&](const SolverResult& drawn) {
    const Timeline<double>& timeline = *drawn.timeline;
    t0.push_back(timeline.t0.value_or(kNever));
    t1.push_back(timeline.t1.value_or(kNever));
    t_star.push_back(timeline.t_star.value_or(kNever));
    for (std::size_t i = 0; i < std::min(n, timeline.interfaces.size()); ++i) {
      first[i].push_back(timeline.interfaces[i].first.value_or(kNever));
      last[i].push_back(timeline.interfaces[i].last.value_or(kNever));
    }
  });
  result.t0 = band_of(std::move(t0));
  result.t1 = band_of(std::move(t1));
  result.t_star = band_of(std::move(t_star));
  for (std::size_t i = 0; i < n; ++i)
    result.interfaces.push_back({band_of(std::move(first[i])), band_of(std::move(last[i]))});
  return result;
}

}  // namespace shearfront::fit
