// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/covariance.hpp"

#include <ceres/ceres.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A residual vector with a constant Jacobian, for ceres::Covariance.
class LinearCost final : public ceres::CostFunction {
 public:
  explicit LinearCost(const MatrixXd& jacobian) : jacobian_(jacobian) {
    set_num_residuals(static_cast<int>(jacobian.rows()));
    mutable_parameter_block_sizes()->assign(1, static_cast<std::int32_t>(jacobian.cols()));
  }
  bool Evaluate(double const* const* /*u*/, double* residuals, double** jacobians) const override {
    std::fill(residuals, residuals + jacobian_.rows(), 0.0);
    if (jacobians && jacobians[0])
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], jacobian_.rows(), jacobian_.cols()) = jacobian_;
    return true;
  }

 private:
  const MatrixXd& jacobian_;
};

/// (J^T J)^-1 for a Jacobian of full rank, by the singular values of Ceres.
MatrixXd inverse_normal_matrix(const MatrixXd& jacobian) {
  const Index n = jacobian.cols();
  VectorXd u = VectorXd::Zero(n);
  ceres::Problem::Options options;
  LinearCost cost(jacobian);
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem linear(options);
  linear.AddResidualBlock(&cost, nullptr, u.data());
  ceres::Covariance::Options how;
  how.algorithm_type = ceres::DENSE_SVD;
  how.min_reciprocal_condition_number = 1e-18;
  ceres::Covariance covariance(how);
  MatrixXd inverse = MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  const std::vector<std::pair<const double*, const double*>> blocks{{u.data(), u.data()}};
  if (!covariance.Compute(blocks, &linear)) return inverse;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(n, n);
  if (covariance.GetCovarianceBlock(u.data(), u.data(), block.data())) inverse = block;
  return inverse;
}

/// sum over rows of J^T W D S D^T W J, with r = W (C X - D y).
MatrixXd noise_in_gradient(const ResidualRows& rows, const Observations& observations,
                           const MatrixXd& jacobian) {
  MatrixXd by_observation = MatrixXd::Zero(static_cast<Index>(observations.rows.size()), jacobian.cols());
  for (Index i = 0; i < rows.size(); ++i) {
    const ResidualRows::Row& row = rows.rows[static_cast<std::size_t>(i)];
    for (const Term& term : row.data)
      by_observation.row(static_cast<Index>(term.index)) += row.weight * term.coefficient * jacobian.row(i);
  }
  for (Index k = 0; k < by_observation.rows(); ++k) {
    const double sigma = observations.rows[static_cast<std::size_t>(k)].sigma;
    if (sigma > 0) by_observation.row(k) *= sigma;
  }
  return by_observation.transpose() * by_observation;
}

/// Variance of one residual as it enters the estimate: noise^2 for least squares, mean psi^2 / (mean psi')^2
/// for a robust loss, psi(r) = r rho'(r^2).
double effective_variance(const VectorXd& residuals, const Loss& loss, double noise, Index n_coordinates) {
  if (!loss.is_robust) return noise * noise;
  double psi2 = 0, slope = 0;
  for (const double r : residuals) {
    const LossValue rho = loss(r * r);
    psi2 += r * r * rho.first * rho.first;
    slope += rho.first + 2 * r * r * rho.second;
  }
  const auto n = static_cast<double>(residuals.size());
  const double freedom = n / std::max(1.0, n - static_cast<double>(n_coordinates));
  return freedom * (psi2 / n) / std::pow(slope / n, 2);
}

}  // namespace

Covariance covariance(const ResidualRows& rows, const Observations& observations,
                      const Objective::Evaluation& at, const Loss& loss, double noise,
                      const std::vector<bool>& held) {
  const Index n = at.jacobian.cols();
  Covariance result;
  result.matrix = MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  result.determined.assign(static_cast<std::size_t>(n), false);
  result.null_directions.resize(n, 0);
  std::vector<Index> free, seen;
  for (Index j = 0; j < n; ++j)
    if (!held[static_cast<std::size_t>(j)]) free.push_back(j);
  MatrixXd scaled(at.jacobian.rows(), static_cast<Index>(free.size()));
  VectorXd norm(scaled.cols());
  for (Index c = 0; c < scaled.cols(); ++c) {
    norm[c] = at.jacobian.col(free[static_cast<std::size_t>(c)]).norm();
    scaled.col(c) = norm[c] > 0 ? VectorXd(at.jacobian.col(free[static_cast<std::size_t>(c)]) / norm[c])
                                : VectorXd(VectorXd::Zero(scaled.rows()));
  }
  if (scaled.cols() == 0 || scaled.rows() == 0) return result;
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeFullV);
  const VectorXd& singular = svd.singularValues();
  std::vector<bool> touched(free.size(), false);
  for (Index c = 0; c < scaled.cols(); ++c) {
    const double value = c < singular.size() ? singular[c] : 0;
    if (value > kRankTolerance * singular[0]) continue;
    const VectorXd direction = svd.matrixV().col(c);
    VectorXd whole = VectorXd::Zero(n);
    for (Index k = 0; k < scaled.cols(); ++k) {
      touched[static_cast<std::size_t>(k)] =
          touched[static_cast<std::size_t>(k)] || std::abs(direction[k]) > 1e-4;
      whole[free[static_cast<std::size_t>(k)]] = norm[k] > 0 ? direction[k] / norm[k] : direction[k];
    }
    result.null_directions.conservativeResize(n, result.null_directions.cols() + 1);
    result.null_directions.rightCols(1) = whole.normalized();
  }
  std::vector<Index> columns;
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (touched[k]) continue;
    result.determined[static_cast<std::size_t>(free[k])] = true;
    columns.push_back(free[k]);
  }
  if (columns.empty()) return result;
  // What cannot be determined stays fixed at its estimate; the others do not depend on it (to first order).
  MatrixXd jacobian(at.jacobian.rows(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    jacobian.col(static_cast<Index>(k)) = at.jacobian.col(columns[k]);
  const VectorXd scale = jacobian.colwise().norm().cwiseInverse();
  const MatrixXd inverse =
      scale.asDiagonal() * inverse_normal_matrix(jacobian * scale.asDiagonal()) * scale.asDiagonal();
  const MatrixXd cov = effective_variance(at.residuals, loss, noise, jacobian.cols()) * inverse *
                       noise_in_gradient(rows, observations, jacobian) * inverse;
  for (std::size_t a = 0; a < columns.size(); ++a)
    for (std::size_t b = 0; b < columns.size(); ++b)
      result.matrix(columns[a], columns[b]) = cov(static_cast<Index>(a), static_cast<Index>(b));
  return result;
}

}  // namespace shearfront::fit
