// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

using namespace shearfront::support;
using MatrixXl = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The same by the normal equations in long double: (J^T J)^-1 J^T B B^T J (J^T J)^-1.
template <class Misfit>
MatrixXd by_normal_equations(const FitSpec& spec, const Parts<Misfit>& parts, double variance) {
  const ResidualRows& rows = parts.objective.rows();
  MatrixXl b = MatrixXl::Zero(rows.size(), static_cast<Index>(spec.observations.rows.size()));
  for (Index i = 0; i < rows.size(); ++i) {
    const auto& row = rows.rows[static_cast<std::size_t>(i)];
    // What a row continues, with its own weight.
    if (row.continues)
      b.row(i) = b.row(i - 1) * (row.weight / rows.rows[static_cast<std::size_t>(i - 1)].weight);
    for (const Term& term : rows.data(static_cast<std::size_t>(i))) {
      const double sigma = spec.observations.rows[term.index].sigma;
      b(i, static_cast<Index>(term.index)) += row.weight * term.coefficient * (sigma > 0 ? sigma : 1);
    }
  }
  const MatrixXl j = parts.at.jacobian.template cast<long double>();
  const MatrixXl solve = (j.transpose() * j).inverse() * j.transpose() * b;
  return (variance * solve * solve.transpose()).template cast<double>();
}

double relative_difference(const MatrixXd& a, const MatrixXd& b) { return (a - b).norm() / b.norm(); }

FitSpec two_layers(Quantity quantity, bool with_sigma) {
  ObservationPlan plan{{0.5, 1, 2, 3}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, quantity, 0};
  if (quantity == Quantity::bin) plan.width = 0.1;
  const auto scene = small_above_large({0.29}, {3.15, 0.5});
  return fit_of(scene, observed(scene, plan, 0.02, 3, with_sigma), {"shear_rate.values"});
}

TEST(FitCovariance, OfALinearRegression) {
  // s and z0 of a fan: beta = 1 / (2 s) and gamma = beta z0 are coefficients of z / t and -1 / t.
  const double sigma = 0.01;
  const FitSpec spec = fan_fit(sigma, 1, true);
  const Estimate estimate = fit(spec);
  ASSERT_TRUE(estimate.usable());
  MatrixXd design(static_cast<Index>(spec.observations.rows.size()), 2);
  VectorXd y(design.rows());
  for (Index i = 0; i < y.size(); ++i) {
    const Observation& o = spec.observations.rows[static_cast<std::size_t>(i)];
    design.row(i) << o.z / o.t, -1 / o.t;
    y[i] = o.value - 0.5;
  }
  const MatrixXd inverse = (design.transpose() * design).inverse();
  const VectorXd x = inverse * design.transpose() * y;
  const double beta = x[0], z0 = x[1] / x[0];
  EXPECT_NEAR(estimate.parameters[0].estimate, 1 / (2 * beta), 1e-8);
  EXPECT_NEAR(estimate.parameters[1].estimate, z0, 1e-8);
  const double s_error = sigma * std::sqrt(inverse(0, 0)) / (2 * beta * beta);
  const VectorXd z0_gradient{{-x[1] / (beta * beta), 1 / beta}};
  const double z0_error = sigma * std::sqrt(z0_gradient.dot(inverse * z0_gradient));
  ASSERT_TRUE(estimate.parameters[0].std_error && estimate.parameters[1].std_error);
  EXPECT_NEAR(*estimate.parameters[0].std_error, s_error, 1e-6 * s_error);
  EXPECT_NEAR(*estimate.parameters[1].std_error, z0_error, 1e-6 * z0_error);
  EXPECT_NEAR(std::log(estimate.parameters[0].ci95->high / estimate.parameters[0].estimate),
              1.959963984540054 * s_error / estimate.parameters[0].estimate, 1e-6);
}

TEST(FitCovariance, SigmaIsEstimatedWithoutBias) {
  const FitSpec spec = fan_fit(0.01, 2, false);
  const Estimate estimate = fit(spec);
  EXPECT_DOUBLE_EQ(estimate.freedom, 12);
  EXPECT_NEAR(estimate.sigma, estimate.residual_norm / std::sqrt(12.0), 1e-12);
  EXPECT_FALSE(estimate.sigma_is_given);
}

TEST(FitCovariance, AgreesWithNormalEquations) {
  const std::vector<bool> free(2, false);
  for (const bool with_sigma : {true, false}) {
    const FitSpec bins = two_layers(Quantity::bin, with_sigma);
    const Parts<BinMisfit> direct(bins);
    EXPECT_LT(relative_difference(covariance(direct.objective.rows(), bins.observations, direct.at,
                                             direct.objective.loss(), 1, free)
                                      .matrix,
                                  by_normal_equations(bins, direct, 1)),
              1e-10);
    // Running sums of bins: correlated rows.
    const Parts<CumulativeMisfit> sums(bins);
    EXPECT_LT(relative_difference(covariance(sums.objective.rows(), bins.observations, sums.at,
                                             sums.objective.loss(), 0.3, free)
                                      .matrix,
                                  by_normal_equations(bins, sums, 0.09)),
              1e-10);
    // Differences of running integrals.
    const FitSpec integrals = two_layers(Quantity::cumulative, with_sigma);
    const Parts<BinMisfit> means(integrals);
    EXPECT_LT(relative_difference(covariance(means.objective.rows(), integrals.observations, means.at,
                                             means.objective.loss(), 1, free)
                                      .matrix,
                                  by_normal_equations(integrals, means, 1)),
              1e-10);
  }
}

TEST(FitCovariance, LeastSquaresScaleOfTheMisfitIsTheNoise) {
  const FitSpec spec = two_layers(Quantity::bin, false);
  const Parts<BinMisfit> parts(spec);
  const Covariance errors = covariance(parts.objective.rows(), spec.observations, parts.at,
                                       parts.objective.loss(), 0.25, {false, false});
  EXPECT_NEAR(errors.misfit_scale[0], 0.0625, 1e-12);
  EXPECT_NEAR(errors.misfit_scale[1], 0.0625, 1e-12);
}

TEST(FitCovariance, HuberFactor) {
  const FitSpec spec = two_layers(Quantity::bin, true);
  const Parts<BinMisfit> parts(spec, "huber", 0.7);
  double inside = 0, psi2 = 0, n = 0;
  for (Index i = 0; i < parts.at.residuals.size(); ++i) {
    if (parts.at.jacobian.row(i).norm() < 1e-9) continue;  // a bed at rest
    const double r = std::abs(parts.at.residuals[i]);
    inside += r <= 0.7 ? 1 : 0;
    psi2 += std::pow(std::min(r, 0.7), 2);
    n += 1;
  }
  const double variance = psi2 / (n - 2) / std::pow(inside / n, 2);
  const Covariance errors = covariance(parts.objective.rows(), spec.observations, parts.at,
                                       parts.objective.loss(), 99, {false, false});
  EXPECT_LT(relative_difference(errors.matrix, by_normal_equations(spec, parts, variance)), 1e-10);
}

TEST(FitCovariance, HeldCoordinatesAreKnown) {
  const FitSpec spec = two_layers(Quantity::bin, true);
  const Parts<BinMisfit> parts(spec);
  const Covariance errors = covariance(parts.objective.rows(), spec.observations, parts.at,
                                       parts.objective.loss(), 1, {true, false});
  EXPECT_EQ(errors.matrix(0, 0), 0);
  EXPECT_NEAR(errors.matrix(1, 1) * parts.at.jacobian.col(1).squaredNorm(), 1, 1e-12);
  const MatrixXd cov = parameter_covariance(errors, parts.coordinates.derivative(parts.u));
  EXPECT_TRUE(std::isnan(cov(0, 0)));
  EXPECT_NEAR(cov(1, 1), errors.matrix(1, 1) * 0.25, 1e-15);
}

TEST(FitCovariance, AnUnseenLayerLeavesTheOthersAlone) {
  // Before the first wave reaches z = 0.8.
  const auto scene = small_above_large({0.3, 0.8}, {1, 2, 1.5});
  const auto data =
      observed(scene, {{0.1, 0.14}, {0.35, 0.45, 0.5, 0.55, 0.65}, Quantity::point, 0}, 0.01, 1, true);
  const FitSpec all = fit_of(scene, data, {"shear_rate.values"});
  const FitSpec one = fit_of(scene, data, {"shear_rate.values[1]"});
  const Parts<PointMisfit> seen(all), alone(one);
  const std::vector<bool> free(3, false);
  const Covariance errors = covariance(seen.objective.rows(), data, seen.at, seen.objective.loss(), 1, free);
  EXPECT_EQ(errors.determined, (std::vector<bool>{false, true, false}));
  ASSERT_EQ(errors.null_directions.cols(), 2);
  EXPECT_EQ(errors.null_directions.row(1).norm(), 0);
  EXPECT_NEAR(
      errors.matrix(1, 1),
      covariance(alone.objective.rows(), data, alone.at, alone.objective.loss(), 1, {false}).matrix(0, 0),
      1e-15);
}

TEST(FitCovariance, ConfoundedDirection) {
  FitSpec spec = two_layers(Quantity::bin, true);
  spec.unknown.parameters = {"shear_rate.scale", "shear_rate.values", "initial.breaks"};
  const Parts<BinMisfit> parts(spec);
  const Covariance errors = covariance(parts.objective.rows(), spec.observations, parts.at,
                                       parts.objective.loss(), 1, std::vector<bool>(4, false));
  EXPECT_EQ(errors.determined, (std::vector<bool>{false, false, false, true}));
  ASSERT_EQ(errors.null_directions.cols(), 1);
  VectorXd direction = errors.null_directions.col(0);
  direction /= direction[0];
  EXPECT_LT((direction - VectorXd{{1, -1, -1, 0}}).norm(), 1e-6);
  // The height of the initial jump is as well determined as with the scale known; so is the ratio of the
  // values.
  FitSpec known = spec;
  known.unknown.parameters = {"shear_rate.values", "initial.breaks"};
  const Parts<BinMisfit> fewer(known);
  const MatrixXd better = covariance(fewer.objective.rows(), known.observations, fewer.at,
                                     fewer.objective.loss(), 1, std::vector<bool>(3, false))
                              .matrix;
  EXPECT_NEAR(errors.matrix(3, 3) / better(2, 2), 1, 1e-6);
  const Eigen::RowVector4d ratio{{0, 1, -1, 0}};
  const Eigen::RowVector3d same{{1, -1, 0}};
  EXPECT_NEAR(parameter_covariance(errors, ratio)(0, 0) / (same * better * same.transpose()).value(), 1,
              1e-6);
}

TEST(FitCovariance, OfCombinationsUnderAShape) {
  // dp/du of a decreasing shape: v_2 = exp(u_2), v_1 = v_2 + u_1, v_0 = v_1 + u_0; the same numbers as
  // without.
  const auto scene = small_above_large({0.3, 0.7}, {3, 2, 1});
  ObservationPlan plan{{0.5, 1, 2, 3}, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, Quantity::bin, 0.1};
  FitSpec spec = fit_of(scene, observed(scene, plan, 0.02, 3, true), {"shear_rate.values"});
  const auto of_values = [&](Shape shape) {
    spec.unknown.shape = shape;
    const Parts<BinMisfit> parts(spec);
    const Covariance errors = covariance(parts.objective.rows(), spec.observations, parts.at,
                                         parts.objective.loss(), 1, std::vector<bool>(3, false));
    return parameter_covariance(errors, parts.coordinates.derivative(parts.u));
  };
  const MatrixXd plain = of_values(Shape::none);
  EXPECT_LT(relative_difference(of_values(Shape::decreasing), plain), 1e-9);
  EXPECT_LT(relative_difference(of_values(Shape::convex), plain), 1e-9);
}

TEST(FitCovariance, AShapeDoesNotSpreadIgnorance) {
  // Nothing moves below z = 0.3 yet: v_0 is unseen, v_1 and v_2 have the error bars they have without a
  // shape.
  const auto scene = small_above_large({0.3, 0.55}, {3, 2, 1});
  FitSpec spec = fit_of(
      scene,
      observed(scene, {{0.05, 0.08}, {0.4, 0.45, 0.5, 0.52, 0.56, 0.58}, Quantity::point, 0}, 0.01, 1, true),
      {"shear_rate.values"});
  spec.misfit.two_stage = false;
  spec.misfit.loss = "squared";
  const Estimate plain = fit(spec);
  spec.unknown.shape = Shape::decreasing;
  const Estimate shaped = fit(spec);
  EXPECT_FALSE(plain.parameters[0].std_error);
  EXPECT_FALSE(shaped.parameters[0].std_error);
  for (const std::size_t i : {1U, 2U}) {
    ASSERT_TRUE(plain.parameters[i].std_error && shaped.parameters[i].std_error);
    EXPECT_NEAR(*shaped.parameters[i].std_error / *plain.parameters[i].std_error, 1, 1e-3);
  }
}

TEST(FitCovariance, NumericJacobiansKnowTheirError) {
  FitSpec spec = two_layers(Quantity::bin, true);
  spec.unknown.parameters = {"shear_rate.scale", "shear_rate.values"};
  spec.forward.method = Method("godunov");
  const Parts<BinMisfit> parts(spec);
  ASSERT_EQ(parts.at.column_error.size(), 3);
  EXPECT_GT(parts.at.column_error.maxCoeff(), 0);
  EXPECT_LT(parts.at.column_error.maxCoeff(), 0.1);
  const Covariance errors = covariance(parts.objective.rows(), spec.observations, parts.at,
                                       parts.objective.loss(), 1, std::vector<bool>(3, false));
  EXPECT_EQ(errors.determined, std::vector<bool>(3, false));
}

}  // namespace
}  // namespace shearfront::fit
