// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/correlated_information.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/fit/design/symmetric_inverse.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Rows = std::vector<Index>;

constexpr int kMostCorrelatedPasses = 30;
/// An exchange that gains less is none: rounding would go round in circles.
constexpr double kLeastCorrelatedGain = 1e-9;

/// Starts of exchange beside the largest weights, as long as they are cheap: c m (m + draws p^2) for each of them.
constexpr int kMostSamples = 12;
constexpr double kMostSampledWork = 5e8;

MatrixXd rows_of(const MatrixXd& of, const Rows& rows) { return of(rows, Eigen::seqN(Index{0}, of.cols())); }
MatrixXd columns_of(const MatrixXd& of, const Rows& columns) {
  return of(Eigen::seqN(Index{0}, of.rows()), columns);
}

struct Exchanged {
  std::vector<std::size_t> units;
  double value = 0;
};

Rows rows_of_units(const CorrelatedInformation& information, const std::vector<std::size_t>& units) {
  Rows rows;
  for (const std::size_t g : units)
    rows.insert(rows.end(), information.units[g].begin(), information.units[g].end());
  return rows;
}

/// A set of units, and what it leaves of the candidates: J and, for each unit, the block of C that it does not foretell.
struct Foretold {
  std::vector<std::size_t> units;
  std::vector<bool> has;            ///< [unit]
  Rows rows;                        ///< of the set
  MatrixXd inverse;                 ///< P, of their covariance
  MatrixXd weights;                 ///< covariance of all candidates with them, times P
  std::vector<MatrixXd> jacobians;  ///< [draw] of all candidates
  std::vector<MatrixXd> blocks;     ///< [unit]
  std::vector<MatrixXd> sums;       ///< [draw] the information of the set
};

Foretold foretold(const CorrelatedInformation& information, std::vector<std::size_t> units) {
  Foretold of;
  of.rows = rows_of_units(information, units);
  of.has.assign(information.units.size(), false);
  for (const std::size_t g : units) of.has[g] = true;
  of.units = std::move(units);
  const MatrixXd with_set = columns_of(information.covariance, of.rows);
  of.inverse = symmetric_inverse(Eigen::LLT<MatrixXd>(rows_of(with_set, of.rows)));
  // What is in the set foretells itself.
  const auto n = static_cast<Index>(of.rows.size());
  Rows others;
  for (std::size_t g = 0; g < information.units.size(); ++g)
    if (!of.has[g]) others.insert(others.end(), information.units[g].begin(), information.units[g].end());
  of.weights.resize(with_set.rows(), n);
  const MatrixXd of_others = rows_of(with_set, others) * of.inverse;
  of.weights(others, Eigen::seqN(Index{0}, n)) = of_others;
  of.weights(of.rows, Eigen::seqN(Index{0}, n)) = MatrixXd::Identity(n, n);
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    const MatrixXd& all = information.jacobians[k];
    const MatrixXd set = rows_of(all, of.rows);
    of.jacobians.emplace_back(all - of.weights * set);
    of.sums.emplace_back(information.before[k] + set.transpose() * of.inverse * set);
  }
  for (std::size_t g = 0; g < information.units.size(); ++g) {
    const Rows& unit = information.units[g];
    auto& block = of.blocks.emplace_back(
        MatrixXd::Zero(static_cast<Index>(unit.size()), static_cast<Index>(unit.size())));
    if (!of.has[g])
      block = MatrixXd(information.covariance(unit, unit)) -
              rows_of(of.weights, unit) * rows_of(with_set, unit).transpose();
  }
  return of;
}

/// The set without one of its units, whose rows I of it begin at `first`. With Q = P_{:,I} (P_II)^(-1/2) and W = C_{:,S} Q, it leaves
/// J + W Q^T J_S and C_gg + W_g W_g^T, and its information is M(S) - (Q^T J_S)^T (Q^T J_S).
struct TakenOut {
  Index first = 0, size = 0;
  MatrixXd q, w;
  std::vector<MatrixXd> moved;    ///< [draw] Q^T J_S
  std::vector<MatrixXd> without;  ///< [draw] information
};

TakenOut taken_out(const CorrelatedInformation& information, const Foretold& of, Index first, Index size) {
  const Eigen::LLT<MatrixXd> root(of.inverse.block(first, first, size, size));
  const auto turned = [&](const MatrixXd& columns) -> MatrixXd {
    return root.matrixL().solve(columns.transpose()).transpose();
  };
  TakenOut out{
      first, size, turned(of.inverse.middleCols(first, size)), turned(of.weights.middleCols(first, size)),
      {},    {}};
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    out.moved.emplace_back(out.q.transpose() * rows_of(information.jacobians[k], of.rows));
    out.without.emplace_back(of.sums[k] - out.moved[k].transpose() * out.moved[k]);
  }
  return out;
}

/// What each unit would bring in its place, [draw]: rows whose squares are its information, and nothing of those of the set.
std::vector<MatrixXd> brought(const CorrelatedInformation& information, const Foretold& of,
                              const TakenOut& out) {
  std::vector<MatrixXd> all;
  for (std::size_t k = 0; k < out.moved.size(); ++k) all.emplace_back(of.jacobians[k] + out.w * out.moved[k]);
  for (std::size_t g = 0; g < information.units.size(); ++g) {
    const Rows& rows = information.units[g];
    if (of.has[g]) {
      for (MatrixXd& one : all)
        for (const Index i : rows) one.row(i).setZero();
    } else if (rows.size() == 1) {
      const double scale = 1 / std::sqrt(of.blocks[g](0, 0) + out.w.row(rows[0]).squaredNorm());
      for (MatrixXd& one : all) one.row(rows[0]) *= scale;
    } else {
      const MatrixXd w = rows_of(out.w, rows);
      const Eigen::LLT<MatrixXd> left(of.blocks[g] + w * w.transpose());
      for (MatrixXd& one : all) {
        const MatrixXd whitened = left.matrixL().solve(rows_of(one, rows));
        one(rows, Eigen::seqN(Index{0}, one.cols())) = whitened;
      }
    }
  }
  return all;
}

struct Replacement {
  std::size_t unit = 0;
  double value = std::numeric_limits<double>::infinity();
};

/// The unit with which the mean criterion is least in place of the one taken out, if that is less than `limit`. The tangents at the
/// set as it is bound what each can bring, and those who cannot be best are not tried.
Replacement best_replacement(const CorrelatedInformation& information, const InformationCriterion& criterion,
                             const Foretold& of,
                             const std::vector<std::optional<InformationCriterion::Tangent>>& tangents,
                             const TakenOut& out, double limit) {
  const std::vector<MatrixXd> all = brought(information, of, out);
  const auto n_draws = static_cast<double>(all.size());
  const std::size_t n_units = information.units.size();
  std::vector<double> bounds(n_units, 0.0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!tangents[k]) {
      bounds.assign(n_units, -std::numeric_limits<double>::infinity());
      break;
    }
    const MatrixXd& slope = tangents[k]->slope;
    const double base = tangents[k]->value + slope.cwiseProduct(out.without[k] - of.sums[k]).sum();
    const VectorXd by_row = (all[k] * slope).cwiseProduct(all[k]).rowwise().sum();
    for (std::size_t g = 0; g < n_units; ++g) {
      bounds[g] += base / n_draws;
      for (const Index i : information.units[g]) bounds[g] += by_row[i] / n_draws;
    }
  }
  std::vector<std::size_t> tried;
  for (std::size_t g = 0; g < n_units; ++g)
    if (!of.has[g] && bounds[g] < limit) tried.push_back(g);
  std::sort(tried.begin(), tried.end(), [&](std::size_t a, std::size_t b) {
    return bounds[a] < bounds[b] || (bounds[a] == bounds[b] && a < b);
  });
  Replacement best{0, limit};
  for (const std::size_t g : tried) {
    if (!(bounds[g] < best.value)) break;
    double sum = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const MatrixXd rows = rows_of(all[k], information.units[g]);
      sum += criterion.value(out.without[k] + rows.transpose() * rows) / n_draws;
    }
    if (sum < best.value) best = {g, sum};
  }
  return best;
}

/// Another unit of as many rows in place of the one taken out, by two updates of that many ranks.
void put_in_place(const CorrelatedInformation& information, Foretold& of, const TakenOut& out,
                  std::size_t position, std::size_t unit) {
  const Rows& rows = information.units[unit];
  of.has[of.units[position]] = false;
  of.has[unit] = true;
  of.units[position] = unit;
  of.inverse.noalias() -= out.q * out.q.transpose();
  of.weights.noalias() -= out.w * out.q.transpose();
  // What is taken out is 0 now but for rounding.
  of.inverse.middleRows(out.first, out.size).setZero();
  of.inverse.middleCols(out.first, out.size).setZero();
  of.weights.middleCols(out.first, out.size).setZero();
  const MatrixXd own = rows_of(out.w, rows);
  const Eigen::LLT<MatrixXd> left(of.blocks[unit] + own * own.transpose());
  const auto turned = [&](const MatrixXd& columns) -> MatrixXd {
    return left.matrixL().solve(columns.transpose()).transpose();
  };
  MatrixXd b = rows_of(of.weights, rows).transpose();
  b.middleRows(out.first, out.size) = -MatrixXd::Identity(out.size, out.size);
  b = turned(b);
  const MatrixXd with_unit = columns_of(information.covariance, rows);
  const MatrixXd unforetold = turned(with_unit - of.weights * rows_of(with_unit, of.rows));
  for (std::size_t k = 0; k < of.sums.size(); ++k) {
    MatrixXd& all = of.jacobians[k];
    all += out.w * out.moved[k];
    const MatrixXd whitened = left.matrixL().solve(rows_of(all, rows));
    all -= unforetold * whitened;
    of.sums[k] = out.without[k] + whitened.transpose() * whitened;
  }
  for (std::size_t g = 0; g < of.blocks.size(); ++g) {
    const MatrixXd w = rows_of(out.w, information.units[g]), u = rows_of(unforetold, information.units[g]);
    of.blocks[g] += w * w.transpose() - u * u.transpose();
  }
  of.inverse.noalias() += b * b.transpose();
  of.weights.noalias() -= unforetold * b.transpose();
  std::copy(rows.begin(), rows.end(), of.rows.begin() + out.first);
}

/// Exchange from these units until none is better.
Exchanged exchanged_from(const CorrelatedInformation& information, const InformationCriterion& criterion,
                         std::vector<std::size_t> units) {
  const auto mean_of = [&](const std::vector<MatrixXd>& sums) {
    double sum = 0;
    for (const MatrixXd& one : sums) sum += criterion.value(one) / static_cast<double>(sums.size());
    return sum;
  };
  double value = 0;
  std::vector<std::optional<InformationCriterion::Tangent>> tangents;
  Foretold of;
  const auto note = [&] {
    value = mean_of(of.sums);
    tangents.clear();
    for (const MatrixXd& one : of.sums) tangents.push_back(criterion.tangent(one));
  };
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < kMostCorrelatedPasses; ++pass) {
    has_changed = false;
    // From the start, so that rounding of updates does not add up.
    of = foretold(information, std::move(units));
    note();
    Index first = 0;
    for (std::size_t i = 0; i < of.units.size(); ++i) {
      const auto size = static_cast<Index>(information.units[of.units[i]].size());
      const TakenOut out = taken_out(information, of, first, size);
      const Replacement best =
          best_replacement(information, criterion, of, tangents, out, value - kLeastCorrelatedGain);
      first += size;
      if (!(best.value < value - kLeastCorrelatedGain)) continue;
      has_changed = true;
      const auto new_size = static_cast<Index>(information.units[best.unit].size());
      if (new_size == size) {
        put_in_place(information, of, out, i, best.unit);
      } else {
        std::vector<std::size_t> others = of.units;
        others[i] = best.unit;
        of = foretold(information, std::move(others));
        first += new_size - size;
      }
      note();
    }
    units = of.units;
  }
  std::sort(units.begin(), units.end());
  return {std::move(units), value};
}

/// Systematic sampling: units at equal distances along the sum of the weights, each in proportion to its own (Madow 1949, Ann. Math.
/// Stat. 20, 333-354). No weight is above 1/n, so none is there twice.
std::vector<std::size_t> sampled(const VectorXd& weights, std::size_t n, double offset) {
  std::vector<std::size_t> units;
  double sum = 0;
  const auto count = static_cast<double>(n);
  for (Index g = 0; g < weights.size() && units.size() < n; ++g) {
    sum += count * weights[g];
    if (sum > static_cast<double>(units.size()) + offset) units.push_back(static_cast<std::size_t>(g));
  }
  return units;
}

}  // namespace

MatrixXd information_of(const CorrelatedInformation& information, std::size_t draw,
                        const std::vector<std::size_t>& units) {
  const Rows rows = rows_of_units(information, units);
  const MatrixXd jacobian = rows_of(information.jacobians[draw], rows);
  const Eigen::LLT<MatrixXd> factor(information.covariance(rows, rows));
  const MatrixXd whitened = factor.matrixL().solve(jacobian);
  return information.before[draw] + whitened.transpose() * whitened;
}

std::vector<std::size_t> exchanged_design(const CorrelatedInformation& information,
                                          const InformationCriterion& criterion, std::size_t n,
                                          const ContinuousDesign& start) {
  Exchanged best = exchanged_from(information, criterion, weightiest(start, n));
  double n_rows = 0;
  for (const std::size_t g : best.units) n_rows += static_cast<double>(information.units[g].size());
  const auto p = static_cast<double>(information.before.front().rows());
  const double work = static_cast<double>(information.covariance.rows()) * n_rows *
                      (n_rows + p * p * static_cast<double>(information.before.size()));
  const int n_samples = static_cast<int>(std::min<double>(kMostSamples, kMostSampledWork / work));
  for (int k = 0; k < n_samples; ++k) {
    std::vector<std::size_t> units = sampled(start.weights, n, (k + 0.5) / n_samples);
    if (units.size() < n) continue;
    Exchanged other = exchanged_from(information, criterion, std::move(units));
    if (other.value < best.value - kLeastCorrelatedGain) best = std::move(other);
  }
  return best.units;
}

}  // namespace shearfront::fit
