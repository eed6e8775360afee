// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/covariance.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/noise.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Null directions are known this well, relative to their entries.
constexpr double kCancelled = 1e-4;

/// A numeric column with a larger relative error than this is noise of the forward model.
constexpr double kNoise = 0.5;

/// Singular values of the free columns of a Jacobian, scaled to norm one.
struct Decomposition {
  std::vector<Index> free;  ///< coordinate of each column
  VectorXd norm;            ///< of each column; 0: unseen
  MatrixXd pseudo_inverse;  ///< of the free columns, not scaled: column x row
  MatrixXd null;            ///< basis over the columns, not scaled: a step along it leaves the residuals
};

/// A basis of the same space in which every vector has an entry 1 where all others have 0: directions that
/// involve few coordinates, each vector on its own. Complete pivoting.
MatrixXd sparse_basis(MatrixXd basis) {
  std::vector<bool> done(static_cast<std::size_t>(basis.cols()), false);
  for (Index step = 0; step < basis.cols(); ++step) {
    Index row = 0, column = -1;
    for (Index c = 0; c < basis.cols(); ++c)
      for (Index r = 0; r < basis.rows(); ++r)
        if (!done[static_cast<std::size_t>(c)] &&
            (column < 0 || std::abs(basis(r, c)) > std::abs(basis(row, column))))
          row = r, column = c;
    done[static_cast<std::size_t>(column)] = true;
    basis.col(column) /= basis(row, column);
    for (Index c = 0; c < basis.cols(); ++c)
      if (c != column) basis.col(c) -= basis(row, c) * VectorXd(basis.col(column));
  }
  for (double& entry : basis.reshaped())
    if (std::abs(entry) < kNullEntry) entry = 0;
  return basis;
}

Decomposition decompose(const Objective::Evaluation& at, const std::vector<bool>& held) {
  Decomposition parts;
  for (Index j = 0; j < at.jacobian.cols(); ++j)
    if (!held[static_cast<std::size_t>(j)]) parts.free.push_back(j);
  const auto n = static_cast<Index>(parts.free.size());
  const Index n_rows = at.jacobian.rows();
  parts.norm.resize(n);
  // At least as many rows as columns, so that V is complete.
  MatrixXd scaled = MatrixXd::Zero(std::max(n_rows, n), n);
  for (Index c = 0; c < n; ++c)
    parts.norm[c] = at.jacobian.col(parts.free[static_cast<std::size_t>(c)]).norm();
  const double largest = n > 0 ? parts.norm.maxCoeff() : 0;
  double error2 = 0;
  for (Index c = 0; c < n; ++c) {
    const Index j = parts.free[static_cast<std::size_t>(c)];
    const double error = at.column_error.size() > 0 ? at.column_error[j] : 0;
    if (!(parts.norm[c] > std::max(kUnseen * largest, kSeen * at.rounding)) || error > kNoise)
      parts.norm[c] = 0;
    if (!(parts.norm[c] > 0)) continue;
    scaled.col(c).head(n_rows) = at.jacobian.col(j) / parts.norm[c];
    error2 += error * error;
  }
  parts.pseudo_inverse = MatrixXd::Zero(n, n_rows);
  if (n == 0) return parts;
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const VectorXd& singular = svd.singularValues();
  const double smallest = std::max(kRankTolerance, std::sqrt(error2)) * singular[0];
  const VectorXd unscale = (parts.norm.array() > 0).select(parts.norm.cwiseInverse(), 1.0);
  const Index rank = (singular.array() > smallest).count();
  for (Index c = 0; c < rank; ++c)
    parts.pseudo_inverse += unscale.cwiseProduct(svd.matrixV().col(c)) / singular[c] *
                            svd.matrixU().col(c).head(n_rows).transpose();
  parts.null = unscale.asDiagonal() * sparse_basis(svd.matrixV().rightCols(n - rank));
  return parts;
}

/// K B: how the noise of each observation, in units of sigma_k, moves the coordinates (column x observation).
MatrixXd noise_to_coordinates(const ResidualRows& rows, const Observations& observations,
                              const MatrixXd& pseudo_inverse) {
  if (rows.noise) return pseudo_inverse;  // whitened: as many independent numbers as residuals
  MatrixXd moved = MatrixXd::Zero(pseudo_inverse.rows(), static_cast<Index>(observations.rows.size()));
  VectorXd sum = VectorXd::Zero(pseudo_inverse.rows());  // of the rows that go on from row i, and itself
  for (Index i = rows.size(); i-- > 0;) {
    const ResidualRows::Row& row = rows.rows[static_cast<std::size_t>(i)];
    sum += row.weight * pseudo_inverse.col(i);
    for (const Term& term : rows.data(static_cast<std::size_t>(i)))
      moved.col(static_cast<Index>(term.index)) += term.coefficient * sum;
    if (!row.continues) sum.setZero();
  }
  for (Index k = 0; k < moved.cols(); ++k) {
    const double sigma = observations.rows[static_cast<std::size_t>(k)].sigma;
    if (sigma > 0) moved.col(k) *= sigma;
  }
  return moved;
}

/// A loss at the minimum: mean psi' (how much flatter it makes the misfit) and the variance of one residual
/// as it enters the estimate; psi(r) = r rho'(r^2).
struct LossEffect {
  double slope = 1, variance = 1;
};

LossEffect effect_of(const Loss& loss, const Objective::Evaluation& at, double noise, double fitted) {
  if (!loss.is_robust) return {1, noise * noise};
  // Rows that no coordinate moves have no part in the estimate.
  const std::vector<bool> depends = dependent_rows(at.jacobian);
  double psi2 = 0, slope = 0, n = 0;
  for (Index i = 0; i < at.residuals.size(); ++i) {
    if (!depends[static_cast<std::size_t>(i)]) continue;
    const double r2 = at.residuals[i] * at.residuals[i];
    const LossValue rho = loss(r2);
    psi2 += r2 * rho.first * rho.first;
    slope += rho.first + 2 * r2 * rho.second;
    n += 1;
  }
  const double freedom = n - fitted;
  if (!(slope > 0) || !(freedom > 0)) return {kUnknown, kUnknown};
  slope /= n;
  return {slope, psi2 / freedom / (slope * slope)};
}

}  // namespace

Covariance covariance(const ResidualRows& rows, const Observations& observations,
                      const Objective::Evaluation& at, const Loss& loss, double noise,
                      const std::vector<bool>& held) {
  const Index n = at.jacobian.cols();
  const Decomposition parts = decompose(at, held);
  const auto n_free = static_cast<Index>(parts.free.size());
  const MatrixXd moved = noise_to_coordinates(rows, observations, parts.pseudo_inverse);
  // How much of the noise the fit takes out of the residuals: the rank of J if they are independent.
  const MatrixXd jacobian = at.jacobian(Eigen::seqN(0, at.jacobian.rows()), parts.free);
  const double fitted = (jacobian.transpose() * jacobian * moved).cwiseProduct(moved).sum();
  const LossEffect effect = effect_of(loss, at, noise, fitted);
  const MatrixXd cov = effect.variance * moved * moved.transpose();
  const VectorXd curvature = parts.pseudo_inverse.rowwise().squaredNorm() / effect.slope;

  Covariance result;
  result.held = held;
  result.matrix = MatrixXd::Zero(n, n);
  result.null_directions = MatrixXd::Zero(n, parts.null.cols());
  result.determined.assign(static_cast<std::size_t>(n), false);
  result.misfit_scale = VectorXd::Constant(n, kUnknown);
  result.matrix(parts.free, parts.free) = cov;
  if (parts.null.cols() > 0)
    result.null_directions(parts.free, Eigen::seqN(0, parts.null.cols())) = parts.null;
  for (Index a = 0; a < n_free; ++a) {
    const Index j = parts.free[static_cast<std::size_t>(a)];
    const bool determined = (parts.null.row(a).array() == 0).all();
    result.determined[static_cast<std::size_t>(j)] = determined;
    if (determined) result.misfit_scale[j] = cov(a, a) / curvature[a];
  }
  for (auto direction : result.null_directions.colwise()) direction /= direction.lpNorm<Eigen::Infinity>();
  return result;
}

MatrixXd parameter_covariance(const Covariance& covariance, const MatrixXd& derivative) {
  MatrixXd cov = derivative * covariance.matrix * derivative.transpose();
  for (Index a = 0; a < derivative.rows(); ++a) {
    const VectorXd gradient = derivative.row(a);
    bool is_free = false, is_determined = true;
    for (Index j = 0; j < gradient.size(); ++j)
      is_free = is_free || (gradient[j] != 0 && !covariance.held[static_cast<std::size_t>(j)]);
    for (const auto direction : covariance.null_directions.colwise()) {
      const VectorXd changes = gradient.cwiseProduct(direction);
      is_determined = is_determined && !(std::abs(changes.sum()) > kCancelled * changes.cwiseAbs().sum());
    }
    if (is_free && is_determined) continue;
    cov.row(a).setConstant(kUnknown);
    cov.col(a).setConstant(kUnknown);
  }
  return cov;
}

}  // namespace shearfront::fit
