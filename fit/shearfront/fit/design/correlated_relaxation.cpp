// SPDX-License-Identifier: BSD-3-Clause
// The continuous design under correlated noise. At the best weights most units have 0 and most of the others 1/n, so the problem
// is solved over few at a time: those of 1/n are given, those of 0 left out, and the slopes of all say which to take up next.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "shearfront/fit/design/correlated_information.hpp"
#include "shearfront/fit/design/interior_weights.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the least eigenvalue: what is left of the covariance must not be negative by rounding.
constexpr double kWithinSpectrum = 1 - 1e-9;
/// Of the largest: a least eigenvalue of repeated measurements may come out as 0 or less, and s must be above that.
constexpr double kResolved = 4 * std::numeric_limits<double>::epsilon();
/// How far the bound may be below the relaxed criterion.
constexpr double kGap = 1e-6;
constexpr int kMostWeightRounds = 40;
/// Rows that are taken up in a round beside those that are fractional, on either side; and units, where these are large.
constexpr std::size_t kTakenUp = 64, kTakenUpUnits = 4;
/// Sum of m^3 over the factors of all rounds, some four seconds: after that the bound is what it is.
constexpr double kMostWork = 3e10;
/// Parts nearer to 0 or 1 are there.
constexpr double kPartAtBound = 1e-5;
/// Sums of parts that differ by rounding.
constexpr double kSameSum = 1e-13;

/// Units by what becomes of them in a round.
struct Sorted {
  std::vector<std::size_t> full, free;
};

Index n_rows_of(const CorrelatedInformation& information, const std::vector<std::size_t>& units) {
  Index n = 0;
  for (const std::size_t g : units) n += static_cast<Index>(information.units[g].size());
  return n;
}

/// Indices 0, 1, ..., most of the largest numbers first.
std::vector<std::size_t> by_descending(const VectorXd& numbers) {
  std::vector<std::size_t> order(static_cast<std::size_t>(numbers.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return numbers[static_cast<Index>(a)] > numbers[static_cast<Index>(b)];
  });
  return order;
}

/// Fractional units are free, and so are those whose slopes say that they are at the wrong bound: outside the n steepest with all
/// of their part, or of them with none. Of these the farthest from the border between the two first.
Sorted sorted_units(const CorrelatedInformation& information, const VectorXd& parts, const VectorXd& slopes,
                    std::size_t n) {
  Sorted sorted;
  const std::vector<std::size_t> steepest = by_descending(-slopes);
  std::vector<std::size_t> too_little, too_much;
  for (std::size_t i = 0; i < steepest.size(); ++i) {
    const std::size_t g = steepest[i];
    const double part = parts[static_cast<Index>(g)];
    if (part > 0 && part < 1)
      sorted.free.push_back(g);
    else if (i < n && part == 0)
      too_little.push_back(g);
    else if (i >= n && part == 1)
      too_much.insert(too_much.begin(), g);
    else if (part == 1)
      sorted.full.push_back(g);
  }
  const auto take_up = [&](const std::vector<std::size_t>& units, bool is_full) {
    std::size_t rows = 0, n_taken = 0;
    for (const std::size_t g : units) {
      const bool is_taken = rows < kTakenUp || n_taken < kTakenUpUnits;
      rows += information.units[g].size();
      ++n_taken;
      if (is_taken)
        sorted.free.push_back(g);
      else if (is_full)
        sorted.full.push_back(g);
    }
  };
  take_up(too_little, false);
  take_up(too_much, true);
  return sorted;
}

/// The problem of the free units, given those that are full: what these do not foretell. Its covariance, as a Schur complement,
/// has no eigenvalue below the least of all.
CorrelatedInformation given_full(const CorrelatedInformation& information, const Sorted& sorted) {
  std::vector<Index> full, free;
  CorrelatedInformation given;
  for (const std::size_t g : sorted.full)
    full.insert(full.end(), information.units[g].begin(), information.units[g].end());
  for (const std::size_t g : sorted.free) {
    auto& unit = given.units.emplace_back(information.units[g].size());
    std::iota(unit.begin(), unit.end(), static_cast<Index>(free.size()));
    free.insert(free.end(), information.units[g].begin(), information.units[g].end());
  }
  const MatrixXd& covariance = information.covariance;
  const Eigen::LLT<MatrixXd> factor(covariance(full, full));
  const MatrixXd foretold = factor.matrixL().solve(MatrixXd(covariance(full, free)));
  given.covariance = MatrixXd(covariance(free, free)) - foretold.transpose() * foretold;
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    const MatrixXd& all = information.jacobians[k];
    const auto columns = Eigen::seqN(Index{0}, all.cols());
    const MatrixXd whitened = factor.matrixL().solve(MatrixXd(all(full, columns)));
    given.before.emplace_back(information.before[k] + whitened.transpose() * whitened);
    given.jacobians.emplace_back(MatrixXd(all(free, columns)) - foretold.transpose() * whitened);
  }
  return given;
}

/// Parts all but at their bounds go there, and the others take up what that leaves of the sum; nothing goes where they have no room.
VectorXd settled(const VectorXd& parts, double sum) {
  VectorXd at = parts;
  for (double& a : at) a = a < kPartAtBound ? 0 : a > 1 - kPartAtBound ? 1 : a;
  const VectorXd room = at.cwiseProduct((1 - at.array()).matrix());
  if (room.sum() > 0) at += (sum - at.sum()) / room.sum() * room;
  at = at.cwiseMax(0).cwiseMin(1);
  return std::abs(at.sum() - sum) < kSameSum * sum ? at : parts;
}

/// Some 64 units spread evenly, or n, of equal parts; with those units that determine most if they do not.
VectorXd first_parts(const CorrelatedInformation& information, const InformationCriterion& criterion,
                     double s, std::size_t n) {
  const std::size_t n_units = information.units.size();
  const auto n_rows = static_cast<std::size_t>(information.covariance.rows());
  const std::size_t n_first = std::min(n_units, std::max({n, kTakenUp * n_units / n_rows, kTakenUpUnits}));
  std::vector<bool> is_first(n_units, false);
  for (std::size_t i = 0; i < n_first; ++i) is_first[(2 * i + 1) * n_units / (2 * n_first)] = true;
  const auto equal = [&] {
    const auto count = static_cast<double>(std::count(is_first.begin(), is_first.end(), true));
    VectorXd parts = VectorXd::Zero(static_cast<Index>(n_units));
    for (std::size_t g = 0; g < n_units; ++g)
      if (is_first[g]) parts[static_cast<Index>(g)] = static_cast<double>(n) / count;
    return parts;
  };
  VectorXd parts = equal();
  if (std::isfinite(relaxed_at(information, criterion, s, parts).value)) return parts;
  std::vector<std::size_t> unit_of(static_cast<std::size_t>(information.covariance.rows()));
  for (std::size_t g = 0; g < n_units; ++g)
    for (const Index i : information.units[g]) unit_of[static_cast<std::size_t>(i)] = g;
  for (const MatrixXd& jacobian : information.jacobians) {
    const VectorXd sizes = jacobian.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min());
    const Eigen::ColPivHouseholderQR<MatrixXd> pivoted(
        (jacobian * sizes.cwiseInverse().asDiagonal()).transpose());
    for (Index i = 0; i < std::min(jacobian.rows(), jacobian.cols()); ++i)
      is_first[unit_of[static_cast<std::size_t>(pivoted.colsPermutation().indices()[i])]] = true;
  }
  parts = equal();
  if (std::isfinite(relaxed_at(information, criterion, s, parts).value)) return parts;
  return VectorXd::Constant(static_cast<Index>(n_units),
                            static_cast<double>(n) / static_cast<double>(n_units));
}

}  // namespace

std::optional<ContinuousDesign> continuous_design(const CorrelatedInformation& information,
                                                  const InformationCriterion& criterion, std::size_t n) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(information.covariance, Eigen::EigenvaluesOnly);
  const VectorXd& values = spectrum.eigenvalues();
  const double s = std::max(kWithinSpectrum * values[0], kResolved * values[values.size() - 1]);
  const auto count = static_cast<double>(n);
  VectorXd parts = first_parts(information, criterion, s, n);
  RelaxedAt at = relaxed_at(information, criterion, s, parts);
  if (!std::isfinite(at.value)) return std::nullopt;
  double bound = -std::numeric_limits<double>::infinity();
  ContinuousDesign found;
  double work = 0;
  for (int round = 0;; ++round) {
    // Convex: f(v) >= f(a) + slopes . (v - a), least where v are the n steepest units.
    VectorXd sorted = at.slopes;
    std::sort(sorted.begin(), sorted.end());
    const double gap = at.slopes.dot(parts) - sorted.head(static_cast<Index>(n)).sum();
    bound = std::max(bound, at.value - gap);
    if (round == 0 || at.value < found.value) {
      found.weights = parts / count;
      found.worth = -count * at.slopes;
      found.value = at.value;
    }
    found.bound = bound;
    if (found.value - bound < kGap || round == kMostWeightRounds || work > kMostWork) return found;
    const Sorted units = sorted_units(information, parts, at.slopes, n);
    const double rest = count - static_cast<double>(units.full.size());
    if (!(rest > 0 && rest < static_cast<double>(units.free.size()))) return found;
    std::vector<Index> free(units.free.begin(), units.free.end());
    const VectorXd start = parts(free);
    const double of_free = std::pow(static_cast<double>(n_rows_of(information, units.free)), 3),
                 of_full = std::pow(static_cast<double>(n_rows_of(information, units.full)), 3);
    InteriorOptions options{gap, kGap / 4};
    options.most_factors =
        static_cast<int>(std::clamp<double>((kMostWork - work) / of_free, 5, options.most_factors));
    const InteriorParts interior =
        interior_parts(given_full(information, units), criterion, s, start, options);
    if (interior.factors == 0) return found;
    parts(free) = settled(interior.parts, rest);
    work += of_full + interior.factors * of_free;
    at = relaxed_at(information, criterion, s, parts);
    if (!std::isfinite(at.value)) {
      // What was next to nothing is all there was in a direction that does not matter, as of a design for one unknown.
      parts(free) = interior.parts;
      at = relaxed_at(information, criterion, s, parts);
    }
    if (!std::isfinite(at.value)) return found;
  }
}

}  // namespace shearfront::fit
