// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/interior_weights.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/fit/design/symmetric_inverse.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the way to the nearest bound that a step may go.
constexpr double kWithinBounds = 0.995;
/// Of a start at its bounds, what becomes equal parts.
constexpr double kPulledInside = 0.1;
/// Of the decrease that the slope promises, what a step must bring (Armijo).
constexpr double kPromised = 1e-4;
constexpr double kShortest = 1e-9;
/// Of the criterion.
constexpr double kMeritRounding = 1e-14;
/// Residuals of the conditions of optimality, in units of the barrier, at which the barrier is lowered.
constexpr double kCentred = 10;
/// Step of the differences of slopes, relative to the information: half the digits of a third derivative.
constexpr double kTangentStep = 1e-4;

/// d^2 criterion = e^T curvature e for dM = R E R^T, M = R R^T; e has the entries of E on and below the diagonal, those below
/// times sqrt 2. By differences of the tangent, which every criterion has.
MatrixXd curvature_of(const InformationCriterion& criterion, const MatrixXd& root) {
  const Index p = root.rows();
  std::vector<std::pair<Index, Index>> places;
  for (Index j = 0; j < p; ++j)
    for (Index i = j; i < p; ++i) places.emplace_back(i, j);
  const auto n = static_cast<Index>(places.size());
  const auto entries_of = [&](const MatrixXd& of) {
    VectorXd entries(n);
    for (Index k = 0; k < n; ++k) {
      const auto [i, j] = places[static_cast<std::size_t>(k)];
      entries[k] = i == j ? of(i, i) : (of(i, j) + of(j, i)) / std::sqrt(2.0);
    }
    return entries;
  };
  MatrixXd curvature = MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k) {
    const auto [i, j] = places[static_cast<std::size_t>(k)];
    MatrixXd along = MatrixXd::Zero(p, p);
    along(i, j) = along(j, i) = kTangentStep * (i == j ? 1 : std::sqrt(0.5));
    const MatrixXd one = MatrixXd::Identity(p, p);
    const auto above = criterion.tangent(root * (one + along) * root.transpose()),
               below = criterion.tangent(root * (one - along) * root.transpose());
    if (!above || !below) return MatrixXd::Zero(n, n);
    curvature.col(k) =
        entries_of(root.transpose() * (above->slope - below->slope) * root) / (2 * kTangentStep);
  }
  return (curvature + curvature.transpose()) / 2;
}

/// Of rows of u: those of (R^-1 u)(R^-1 u)^T, as curvature_of() has them.
MatrixXd squares_of(const MatrixXd& u, const MatrixXd& root) {
  const MatrixXd y = root.triangularView<Eigen::Lower>().solve(u.transpose()).transpose();
  const Index p = y.cols();
  MatrixXd squares(y.rows(), p * (p + 1) / 2);
  Index k = 0;
  for (Index j = 0; j < p; ++j)
    for (Index i = j; i < p; ++i)
      squares.col(k++) = (i == j ? 1 : std::sqrt(2.0)) * y.col(i).cwiseProduct(y.col(j));
  return squares;
}

VectorXd parts_of_rows(const CorrelatedInformation& information, const VectorXd& parts) {
  VectorXd of(information.covariance.rows());
  for (std::size_t g = 0; g < information.units.size(); ++g)
    for (const Index i : information.units[g]) of[i] = parts[static_cast<Index>(g)];
  return of;
}

/// Sums over the rows of each unit.
MatrixXd by_unit(const CorrelatedInformation& information, const MatrixXd& rows) {
  MatrixXd sums = MatrixXd::Zero(static_cast<Index>(information.units.size()), rows.cols());
  for (std::size_t g = 0; g < information.units.size(); ++g)
    for (const Index i : information.units[g]) sums.row(static_cast<Index>(g)) += rows.row(i);
  return sums;
}

/// The relaxed information at parts > 0: B = s 1 + A^1/2 K A^1/2, J and M of each draw.
struct Informed {
  double value = std::numeric_limits<double>::infinity();
  VectorXd d;  ///< A^1/2
  Eigen::LLT<MatrixXd> factor;
  std::vector<MatrixXd> u;  ///< [draw] (s 1 + K A)^-1 J = A^-1/2 B^-1 A^1/2 J
  std::vector<MatrixXd> m;  ///< [draw]
};

Informed informed_at(const CorrelatedInformation& information, const InformationCriterion& criterion,
                     double s, const VectorXd& parts) {
  Informed at;
  at.d = parts_of_rows(information, parts).cwiseSqrt();
  MatrixXd b = at.d.asDiagonal() * information.covariance * at.d.asDiagonal();
  b.diagonal().array() += s * (1 - at.d.array().square());
  at.factor.compute(b);
  if (at.factor.info() != Eigen::Success) return at;
  double sum = 0;
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    const MatrixXd j = at.d.asDiagonal() * information.jacobians[k];
    const MatrixXd v = at.factor.solve(j);
    at.m.emplace_back(information.before[k] + j.transpose() * v);
    at.u.emplace_back(at.d.cwiseInverse().asDiagonal() * v);
    sum += criterion.value(at.m.back());
  }
  at.value = sum / static_cast<double>(information.before.size());
  return at;
}

/// Sums over the rows of units g and columns of units h of G_ij X_ij, X = sum over draws of u S u^T. One of the two ways is cheaper.
MatrixXd crossed_sums(const CorrelatedInformation& information, const Informed& at, double s,
                      const std::vector<MatrixXd>& sloped) {
  const Index n_rows = at.d.size(), n_units = static_cast<Index>(information.units.size());
  const auto inverse_d = at.d.cwiseInverse().asDiagonal();
  const Index n_columns = at.u.front().cols();
  if (n_units * n_columns * static_cast<Index>(at.u.size()) >= n_rows) {
    MatrixXd products = MatrixXd::Zero(n_rows, n_rows);
    for (std::size_t k = 0; k < at.u.size(); ++k) products.noalias() += sloped[k] * at.u[k].transpose();
    MatrixXd g = -s * symmetric_inverse(at.factor);
    g.diagonal().array() += 1;
    const MatrixXd of_rows = (inverse_d * g * inverse_d).cwiseProduct(products);
    return by_unit(information, by_unit(information, of_rows).transpose());
  }
  MatrixXd sums = MatrixXd::Zero(n_units, n_units);
  for (std::size_t k = 0; k < at.u.size(); ++k)
    for (Index c = 0; c < n_columns; ++c) {
      MatrixXd columns = MatrixXd::Zero(n_rows, n_units);
      for (std::size_t g = 0; g < information.units.size(); ++g)
        for (const Index i : information.units[g])
          columns(i, static_cast<Index>(g)) = at.u[k](i, c) / at.d[i];
      columns -= s * at.factor.solve(columns);
      sums += by_unit(information, sloped[k].col(c).cwiseQuotient(at.d).asDiagonal() * columns);
    }
  return (sums + sums.transpose()) / 2;
}

struct Curved {
  VectorXd slopes;
  MatrixXd curvature;
};
/// Slopes and second derivatives. dM is s u_i u_i^T dA_ii, and du_i = - G_ij u_j dA_jj with
/// G = (s 1 + K A)^-1 K = A^-1/2 (1 - s B^-1) A^-1/2.
std::optional<Curved> curved_at(const CorrelatedInformation& information,
                                const InformationCriterion& criterion, double s, const Informed& at) {
  const auto n_draws = static_cast<double>(at.m.size());
  const auto n_units = static_cast<Index>(information.units.size());
  Curved curved{VectorXd::Zero(n_units), MatrixXd::Zero(n_units, n_units)};
  std::vector<MatrixXd> sloped;
  for (std::size_t k = 0; k < at.m.size(); ++k) {
    const auto tangent = criterion.tangent(at.m[k]);
    const Eigen::LLT<MatrixXd> of_m(at.m[k]);
    if (!tangent || of_m.info() != Eigen::Success) return std::nullopt;
    sloped.emplace_back(at.u[k] * tangent->slope);
    curved.slopes += s / n_draws * by_unit(information, sloped[k].cwiseProduct(at.u[k]).rowwise().sum());
    const MatrixXd root = of_m.matrixL();
    const MatrixXd squares = by_unit(information, squares_of(at.u[k], root));
    curved.curvature += s * s / n_draws * squares * curvature_of(criterion, root) * squares.transpose();
  }
  curved.curvature -= 2 * s / n_draws * crossed_sums(information, at, s, sloped);
  return curved;
}

/// The longest step along `change` that leaves `x` > 0.
double longest(const VectorXd& x, const VectorXd& change) {
  double step = 1;
  for (Index i = 0; i < x.size(); ++i)
    if (change[i] < 0) step = std::min(step, -kWithinBounds * x[i] / change[i]);
  return step;
}

VectorXd longest_of(const VectorXd& x, const VectorXd& change) { return longest(x, change) * change; }

}  // namespace

RelaxedAt relaxed_at(const CorrelatedInformation& information, const InformationCriterion& criterion,
                     double s, const VectorXd& parts) {
  const VectorXd of_rows = parts_of_rows(information, parts);
  std::vector<Index> rows;
  for (Index i = 0; i < of_rows.size(); ++i)
    if (of_rows[i] > 0) rows.push_back(i);
  const VectorXd a = of_rows(rows), d = a.cwiseSqrt();
  MatrixXd b = d.asDiagonal() * information.covariance(rows, rows) * d.asDiagonal();
  b.diagonal().array() += s * (1 - a.array());
  const Eigen::LLT<MatrixXd> factor(b);
  const MatrixXd with_rows = information.covariance(Eigen::seqN(Index{0}, of_rows.size()), rows);
  const auto n_draws = static_cast<double>(information.before.size());
  constexpr double kNone = std::numeric_limits<double>::infinity();
  RelaxedAt at{0, VectorXd::Zero(parts.size())};
  for (std::size_t k = 0; k < information.before.size(); ++k) {
    const MatrixXd& all = information.jacobians[k];
    const auto columns = Eigen::seqN(Index{0}, all.cols());
    const MatrixXd j = d.asDiagonal() * all(rows, columns);
    const MatrixXd v = factor.solve(j);
    const auto tangent = criterion.tangent(information.before[k] + j.transpose() * v);
    if (factor.info() != Eigen::Success || !tangent) return {kNone, {}};
    at.value += tangent->value / n_draws;
    // u = (J - K A^1/2 v) / s; where a > 0 that is A^-1/2 v, and nothing cancels.
    const MatrixXd spread = d.asDiagonal() * v;
    MatrixXd u = (all - with_rows * spread) / s;
    u(rows, columns) = d.cwiseInverse().asDiagonal() * v;
    at.slopes += s / n_draws * by_unit(information, (u * tangent->slope).cwiseProduct(u).rowwise().sum());
  }
  return at;
}

InteriorParts interior_parts(const CorrelatedInformation& information, const InformationCriterion& criterion,
                             double s, const VectorXd& start, const InteriorOptions& options) {
  const Index n = start.size();
  const double last = options.tolerance / (2 * static_cast<double>(n));
  double barrier = std::clamp(options.first_gap / (2 * static_cast<double>(n)), last, 1.0);
  VectorXd a = (1 - kPulledInside) * start + VectorXd::Constant(n, kPulledInside * start.mean());
  VectorXd low = barrier * a.cwiseInverse(),
           high = barrier * (1 - a.array()).inverse().matrix();  // multipliers of a > 0 and a < 1
  const auto merit = [&](double value, const VectorXd& at) {
    return value - barrier * (at.array().log().sum() + (1 - at.array()).log().sum());
  };
  Informed at = informed_at(information, criterion, s, a);
  if (!std::isfinite(at.value)) return {start, 0};
  int factors = 1;
  while (factors < options.most_factors) {
    const auto curved = curved_at(information, criterion, s, at);
    if (!curved) break;
    const VectorXd room = 1 - a.array();
    const auto is_centred = [&] {
      VectorXd rest = curved->slopes - low + high;
      rest.array() -= rest.mean();
      return std::max({rest.cwiseAbs().maxCoeff(), (a.cwiseProduct(low).array() - barrier).abs().maxCoeff(),
                       (room.cwiseProduct(high).array() - barrier).abs().maxCoeff()}) < kCentred * barrier;
    };
    while (barrier > last && is_centred()) barrier = std::max(last, barrier / kCentred);
    if (is_centred()) break;
    MatrixXd matrix = curved->curvature;
    matrix.diagonal() += low.cwiseQuotient(a) + high.cwiseQuotient(room);
    const VectorXd slope = curved->slopes - barrier * a.cwiseInverse() + barrier * room.cwiseInverse();
    const Eigen::LDLT<MatrixXd> factor(matrix);
    const VectorXd ones = factor.solve(VectorXd::Ones(n)), along = factor.solve(slope);
    const VectorXd change = along.sum() / ones.sum() * ones - along;
    const double promised = slope.dot(change);
    if (!(promised < 0)) break;
    double length = std::min(longest(a, change), longest(room, -change));
    const double here = merit(at.value, a), rounding = kMeritRounding * (1 + std::abs(here));
    bool is_less = false;
    VectorXd next;
    while (!is_less && length > kShortest && factors < options.most_factors) {
      next = a + length * change;
      // The sum does not drift by rounding.
      next.array() += (start.sum() - next.sum()) / static_cast<double>(n);
      at = informed_at(information, criterion, s, next);
      ++factors;
      is_less = merit(at.value, next) <= here + kPromised * length * promised + rounding;
      if (!is_less) length /= 2;
    }
    if (!is_less) break;
    low += longest_of(low, barrier * a.cwiseInverse() - low - low.cwiseProduct(change).cwiseQuotient(a));
    high += longest_of(high,
                       barrier * room.cwiseInverse() - high + high.cwiseProduct(change).cwiseQuotient(room));
    a = next;
  }
  return {a, factors};
}

}  // namespace shearfront::fit
