// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prediction.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/random/chi_squared_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <utility>

namespace shearfront::fit {
namespace {

constexpr std::size_t kMostRefusedPerScene = 20;

/// The first unknown that is not held and has no error bar; empty if all have one.
std::string unknown_without_error(const Estimate& estimate) {
  const auto p = std::find_if(estimate.parameters.begin(), estimate.parameters.end(),
                              [](const ParameterEstimate& q) { return !q.std_error && !q.is_held(); });
  return p == estimate.parameters.end() ? "" : p->name + " has no error bar";
}

/// The unknowns that vary, and a root of their correlation.
struct Spread {
  std::vector<std::size_t> unknowns;
  Eigen::MatrixXd root;
};

std::optional<Spread> spread_of(const Estimate& estimate, std::string& why_none) {
  why_none = unknown_without_error(estimate);
  if (!why_none.empty()) return std::nullopt;
  Spread spread;
  for (std::size_t i = 0; i < estimate.parameters.size(); ++i)
    if (estimate.parameters[i].std_error.value_or(0) > 0) spread.unknowns.push_back(i);
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

/// The values of the unknowns with these errors, in units of their standard errors.
class ErrorMap {
 public:
  ErrorMap(const Parameters& parameters, const Estimate& estimate, const Spread& spread)
      : parameters_(&parameters), estimate_(&estimate), spread_(&spread) {}

  [[nodiscard]] std::optional<Scene<double>> scene(const Eigen::VectorXd& errors,
                                                   std::string& failure) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(parameters_->size()));
    for (std::size_t i = 0; i < parameters_->size(); ++i)
      values[static_cast<Eigen::Index>(i)] = estimate_->parameters[i].estimate;
    for (Eigen::Index k = 0; k < errors.size(); ++k) {
      const std::size_t i = spread_->unknowns[static_cast<std::size_t>(k)];
      const ParameterEstimate& p = estimate_->parameters[i];
      const double error = *p.std_error * errors[k];
      values[static_cast<Eigen::Index>(i)] = (*parameters_)[i].entry.range == Range::positive
                                                 ? p.estimate * std::exp(error / p.estimate)
                                                 : p.estimate + error;
    }
    if (!values.allFinite()) return std::nullopt;
    return parameters_->scene_at(values, failure);
  }

  /// Along column k of the root.
  [[nodiscard]] DrawnScenes::Axis axis(Eigen::Index k, double reach) const {
    DrawnScenes::Axis axis;
    axis.slopes.assign(parameters_->size(), 0);
    for (std::size_t i = 0; i < spread_->unknowns.size(); ++i)
      axis.slopes[spread_->unknowns[i]] = *estimate_->parameters[spread_->unknowns[i]].std_error *
                                          spread_->root(static_cast<Eigen::Index>(i), k);
    std::string failure;
    const auto at = [&](double xi) { return scene(xi * spread_->root.col(k), failure); };
    axis.near_low = at(-DrawnScenes::kNear);
    axis.near_high = at(DrawnScenes::kNear);
    axis.far_low = at(-reach);
    axis.far_high = at(reach);
    return axis;
  }

 private:
  const Parameters* parameters_;
  const Estimate* estimate_;
  const Spread* spread_;
};

}  // namespace

DrawnScenes draw_scenes(const Parameters& parameters, const Estimate& estimate, std::size_t n,
                        std::uint64_t seed) {
  constexpr double kUpper = 0.975;
  DrawnScenes draws;
  const auto spread = spread_of(estimate, draws.why_none);
  if (!spread) return draws;
  const ErrorMap map(parameters, estimate, *spread);
  const bool has_estimated_noise = !estimate.sigma_is_given && estimate.freedom > 0;
  draws.quantile = has_estimated_noise
                       ? boost::math::quantile(boost::math::students_t(estimate.freedom), kUpper)
                       : boost::math::quantile(boost::math::normal(), kUpper);
  draws.entries = parameters.entries();
  const auto n_unknowns = static_cast<Eigen::Index>(spread->unknowns.size());
  for (Eigen::Index k = 0; k < n_unknowns; ++k)
    draws.axes.push_back(map.axis(k, draws.quantile * std::sqrt(static_cast<double>(n_unknowns))));
  boost::random::mt19937_64 generator(seed);
  boost::random::normal_distribution<double> normal;
  boost::random::chi_squared_distribution<double> chi_squared(has_estimated_noise ? estimate.freedom : 1);
  while (draws.scenes.size() < n) {
    Eigen::VectorXd independent(n_unknowns);
    for (double& x : independent) x = normal(generator);
    if (has_estimated_noise) independent /= std::sqrt(chi_squared(generator) / estimate.freedom);
    std::string failure;
    if (auto scene = map.scene(spread->root * independent, failure)) {
      draws.scenes.push_back(std::move(*scene));
    } else if (++draws.n_refused > kMostRefusedPerScene * n) {
      draws.scenes.clear();
      draws.axes.clear();
      draws.why_none = fmt::format("hardly a draw from the error bars is a valid scene ({})", failure);
      return draws;
    }
  }
  return draws;
}

DrawnScenes scenes_behind(const Parameters& parameters, const Estimate& estimate, std::size_t n,
                          std::uint64_t seed) {
  if (estimate.replicates.rows() == 0) return draw_scenes(parameters, estimate, n, seed);
  DrawnScenes draws;
  draws.are_replicates = true;
  draws.why_none = unknown_without_error(estimate);
  if (!draws.why_none.empty()) return draws;
  for (Eigen::Index b = 0; b < estimate.replicates.rows(); ++b) {
    std::string failure;
    if (auto scene = parameters.scene_at(estimate.replicates.row(b).transpose(), failure))
      draws.scenes.push_back(std::move(*scene));
    else
      ++draws.n_refused;
  }
  return draws;
}

}  // namespace shearfront::fit
