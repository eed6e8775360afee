// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/correlated_information.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = std::vector<Index>;

constexpr int kMostRelaxedSteps = 100;
constexpr int kMostCorrelatedPasses = 30;
/// An exchange that gains less is none: rounding would go round in circles.
constexpr double kLeastCorrelatedGain = 1e-9;
/// Of the least eigenvalue: what is left of the covariance must not be negative by rounding.
constexpr double kWithinSpectrum = 1 - 1e-9;

Rows rows_of_units(const CorrelatedInformation& information, const std::vector<std::size_t>& units) {
  Rows rows;
  for (const std::size_t g : units)
    rows.insert(rows.end(), information.units[g].begin(), information.units[g].end());
  return rows;
}

/// What a set of units leaves of the candidates: J and, for each unit, the block of C that it does not foretell.
struct Foretold {
  Rows rows;                        ///< of the set
  MatrixXd inverse;                 ///< of their covariance
  MatrixXd weights;                 ///< covariance of all candidates with them, times inverse
  std::vector<MatrixXd> jacobians;  ///< [draw] of all candidates
  std::vector<MatrixXd> blocks;     ///< [unit]
  std::vector<MatrixXd> sums;       ///< [draw] the information of the set
};

Foretold foretold(const CorrelatedInformation& information, const std::vector<std::size_t>& units) {
  Foretold of;
  of.rows = rows_of_units(information, units);
  const auto n = static_cast<Index>(of.rows.size());
  const MatrixXd with_set = information.covariance(Eigen::all, of.rows);
  const MatrixXd within = with_set(of.rows, Eigen::all);
  of.inverse = within.llt().solve(MatrixXd::Identity(n, n));
  of.weights = with_set * of.inverse;
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    const MatrixXd& all = information.jacobians[k];
    const MatrixXd set = all(of.rows, Eigen::all);
    of.jacobians.emplace_back(all - of.weights * set);
    of.sums.emplace_back(information.before[k] + set.transpose() * of.inverse * set);
  }
  for (const Rows& unit : information.units)
    of.blocks.emplace_back(information.covariance(unit, unit) -
                           of.weights(unit, Eigen::all) * with_set(unit, Eigen::all).transpose());
  return of;
}

/// The mean criterion with another unit in place of the one whose rows of the set begin at `first`, for each unit; that of
/// none is infinite. With P = (C_SS)^-1, Q = P_{:,I} (P_II)^(-1/2) and W = C_{:,S} Q, what S without I leaves is J + W Q^T J_S and
/// C_gg + W_g W_g^T, and its information is M(S) - (Q^T J_S)^T (Q^T J_S).
VectorXd criteria_in_place_of(const CorrelatedInformation& information, const InformationCriterion& criterion,
                              const Foretold& of, Index first, Index size,
                              const std::vector<bool>& is_chosen) {
  const Eigen::LLT<MatrixXd> root(of.inverse.block(first, first, size, size));
  const auto turned = [&](const MatrixXd& columns) -> MatrixXd {
    return root.matrixL().solve(columns.transpose()).transpose();
  };
  const MatrixXd q = turned(of.inverse.middleCols(first, size));
  const MatrixXd w = turned(of.weights.middleCols(first, size));
  const auto n_draws = static_cast<double>(information.before.size());
  VectorXd criteria = VectorXd::Constant(static_cast<Index>(information.units.size()),
                                         std::numeric_limits<double>::infinity());
  std::vector<MatrixXd> moved, without;
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    moved.emplace_back(q.transpose() * information.jacobians[k](of.rows, Eigen::all));
    without.emplace_back(of.sums[k] - moved[k].transpose() * moved[k]);
  }
  for (std::size_t g = 0; g < information.units.size(); ++g) {
    if (is_chosen[g]) continue;
    const Rows& rows = information.units[g];
    const MatrixXd w_of = w(rows, Eigen::all);
    const Eigen::LLT<MatrixXd> left(of.blocks[g] + w_of * w_of.transpose());
    double sum = 0;
    for (std::size_t k = 0; k < without.size(); ++k) {
      const MatrixXd jacobian = of.jacobians[k](rows, Eigen::all) + w_of * moved[k];
      const MatrixXd whitened = left.matrixL().solve(jacobian);
      sum += criterion.value(without[k] + whitened.transpose() * whitened) / n_draws;
    }
    criteria[static_cast<Index>(g)] = sum;
  }
  return criteria;
}

}  // namespace

MatrixXd information_of(const CorrelatedInformation& information, std::size_t draw,
                        const std::vector<std::size_t>& units) {
  const Rows rows = rows_of_units(information, units);
  const MatrixXd jacobian = information.jacobians[draw](rows, Eigen::all);
  const Eigen::LLT<MatrixXd> factor(information.covariance(rows, rows));
  const MatrixXd whitened = factor.matrixL().solve(jacobian);
  return information.before[draw] + whitened.transpose() * whitened;
}

std::optional<ContinuousDesign> continuous_design(const CorrelatedInformation& information,
                                                  const InformationCriterion& criterion, std::size_t n) {
  const MatrixXd& covariance = information.covariance;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(covariance, Eigen::EigenvaluesOnly);
  const double s = kWithinSpectrum * spectrum.eigenvalues()[0];
  const Index n_rows = covariance.rows();
  const MatrixXd rest = covariance - s * MatrixXd::Identity(n_rows, n_rows);
  const auto count = static_cast<double>(n), n_draws = static_cast<double>(information.before.size());
  const auto value = [&](const VectorXd& weights, VectorXd* worth) {
    VectorXd d(n_rows);  // A^(1/2)
    for (std::size_t g = 0; g < information.units.size(); ++g)
      for (const Index i : information.units[g])
        d[i] = std::sqrt(std::clamp(count * weights[static_cast<Index>(g)], 0.0, 1.0));
    MatrixXd scaled = d.asDiagonal() * rest * d.asDiagonal();
    scaled.diagonal().array() += s;
    const Eigen::LLT<MatrixXd> factor(scaled);
    if (worth) worth->setZero(weights.size());
    double sum = 0;
    for (std::size_t k = 0; k < information.before.size(); ++k) {
      const MatrixXd j = d.asDiagonal() * information.jacobians[k];
      const MatrixXd v = factor.solve(j);
      const auto at = criterion.tangent(information.before[k] + j.transpose() * v);
      if (!at) return std::numeric_limits<double>::infinity();
      sum += at->value / n_draws;
      if (!worth) continue;
      // dM = s u_i u_i^T dA_ii, u = (s 1 + K A)^-1 J.
      const MatrixXd u = (information.jacobians[k] - rest * (d.asDiagonal() * v)) / s;
      const VectorXd by_row = s * (u * at->slope).cwiseProduct(u).rowwise().sum();
      for (std::size_t g = 0; g < information.units.size(); ++g)
        for (const Index i : information.units[g])
          (*worth)[static_cast<Index>(g)] -= count * by_row[i] / n_draws;
    }
    return sum;
  };
  return continuous_design(WeightedCriterion(value), information.units.size(), n, kMostRelaxedSteps);
}

std::vector<std::size_t> exchanged_design(const CorrelatedInformation& information,
                                          const InformationCriterion& criterion, std::size_t n,
                                          const ContinuousDesign& start) {
  std::vector<std::size_t> chosen = weightiest(start, n);
  std::vector<bool> is_chosen(information.units.size(), false);
  for (const std::size_t g : chosen) is_chosen[g] = true;
  double value = mean_criterion(information, criterion, chosen);
  Foretold of = foretold(information, chosen);
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < kMostCorrelatedPasses; ++pass) {
    has_changed = false;
    Index first = 0;
    for (std::size_t& out : chosen) {
      const auto size = static_cast<Index>(information.units[out].size());
      const VectorXd criteria = criteria_in_place_of(information, criterion, of, first, size, is_chosen);
      Index best = 0;
      const double least = criteria.minCoeff(&best);
      first += size;
      if (!(least < value - kLeastCorrelatedGain)) continue;
      is_chosen[out] = false;
      first -= size;
      out = static_cast<std::size_t>(best);
      first += static_cast<Index>(information.units[out].size());
      is_chosen[out] = true;
      of = foretold(information, chosen);
      value = least;
      has_changed = true;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace shearfront::fit
