// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/noise_covariance.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A dense covariance of so many takes a second or two, and 30 MB.
constexpr std::size_t kMostDense = 2000;
/// Heights of different times that are one height up to rounding, relative to the largest.
constexpr double kOneHeight = 1e-12;
/// Of the correlated part, added to its diagonal: places closer than rounding tells leave it singular.
constexpr double kJitter = 1e-12;

MatrixXd correlations_of(const std::vector<double>& places, double length) {
  const auto n = static_cast<Index>(places.size());
  MatrixXd all(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      all(i, j) = std::exp(
          -std::abs(places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)]) / length);
  return all;
}

Index index_of_place(const std::vector<double>& places, double x, double slack) {
  return std::lower_bound(places.begin(), places.end(), x - slack) - places.begin();
}

}  // namespace

NoisePlaces::NoisePlaces(const std::vector<Observation>& observations, bool in_unit_of_data) {
  double highest = 0;
  for (const Observation& o : observations) {
    times_.push_back(o.t);
    heights_.push_back(o.z);
    highest = std::max(highest, std::abs(o.z));
  }
  const double slack = kOneHeight * highest;
  std::sort(times_.begin(), times_.end());
  std::sort(heights_.begin(), heights_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  heights_.erase(
      std::unique(heights_.begin(), heights_.end(), [&](double a, double b) { return b - a <= slack; }),
      heights_.end());
  std::vector<std::pair<Index, Index>> cells;
  for (const Observation& o : observations)
    cells.emplace_back(index_of_place(times_, o.t, 0), index_of_place(heights_, o.z, slack));
  order_.resize(observations.size());
  std::iota(order_.begin(), order_.end(), Index{0});
  const auto cell = [&](Index k) { return cells[static_cast<std::size_t>(k)]; };
  std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) { return cell(a) < cell(b); });
  for (const Index k : order_) {
    time_.push_back(cell(k).first);
    height_.push_back(cell(k).second);
  }
  const bool is_twice = std::adjacent_find(order_.begin(), order_.end(), [&](Index a, Index b) {
                          return cell(a) == cell(b);
                        }) != order_.end();
  is_grid_ = !is_twice && order_.size() == times_.size() * heights_.size();
  if (!in_unit_of_data || observations.empty() || !(observations.front().sigma > 0)) return;
  weight_.resize(size());
  for (Index i = 0; i < size(); ++i)
    weight_[i] = 1 / observations[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])].sigma;
  if (weight_.maxCoeff() == weight_.minCoeff()) {
    common_ = weight_[0];
    weight_.resize(0);
  } else {
    is_grid_ = false;
  }
}

std::string NoisePlaces::refusal() const {
  const std::size_t largest = is_grid_ ? std::max(times_.size(), heights_.size()) : order_.size();
  if (largest <= kMostDense) return "";
  return is_grid_ ? fmt::format("needs at most {} times and as many heights (here {})", kMostDense, largest)
                  : fmt::format("needs the same heights at all times, or at most {} observations (here {})",
                                kMostDense, largest);
}

NoiseCovariance::NoiseCovariance(std::shared_ptr<const NoisePlaces> places, const NoiseShape& shape)
    : places_(std::move(places)) {
  const double common = shape.correlated * places_->common_ * places_->common_;
  MatrixXd in_time = correlations_of(places_->times_, shape.length_t),
           in_height = correlations_of(places_->heights_, shape.length_z);
  if (places_->is_grid_) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> t(in_time), z(in_height);
    of_times_ = t.eigenvectors();
    of_heights_ = z.eigenvectors();
    values_ = (common * z.eigenvalues().cwiseMax(0) * t.eigenvalues().cwiseMax(0).transpose()).array() +
              (shape.independent + kJitter * common);
    log_determinant_ = values_.array().log().sum();
    gain_ = 1 / std::sqrt(values_.minCoeff());
    return;
  }
  const Index n = places_->size();
  MatrixXd all(n, n);
  const auto of = [](const std::vector<Index>& in, Index i) { return in[static_cast<std::size_t>(i)]; };
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i)
      all(i, j) = common * in_time(of(places_->time_, i), of(places_->time_, j)) *
                  in_height(of(places_->height_, i), of(places_->height_, j));
    if (places_->weight_.size() > 0)
      all.col(j).tail(n - j) =
          places_->weight_[j] * places_->weight_.tail(n - j).cwiseProduct(all.col(j).tail(n - j));
    all(j, j) += shape.independent + kJitter * all(j, j);
  }
  factor_ = Eigen::LLT<MatrixXd>(all).matrixL();
  log_determinant_ = 2 * factor_.diagonal().array().log().sum();
  gain_ = 1 / factor_.diagonal().minCoeff();
}

// Of all columns: Eigen::all is not in Eigen 5, and what is there instead is deprecated in 3.4.
MatrixXd NoiseCovariance::sorted(const MatrixXd& x) const {
  return x(places_->order_, Eigen::seqN(0, x.cols()));
}

MatrixXd NoiseCovariance::unsorted(const MatrixXd& x) const {
  MatrixXd all(x.rows(), x.cols());
  all(places_->order_, Eigen::seqN(0, x.cols())) = x;
  return all;
}

MatrixXd NoiseCovariance::on_grid(const MatrixXd& x, double power) const {
  MatrixXd all = sorted(x);
  const MatrixXd factors = values_.array().pow(power);
  for (auto column : all.colwise()) {
    Eigen::Map<MatrixXd> field(column.data(), of_heights_.rows(), of_times_.rows());
    const MatrixXd parts = (of_heights_.transpose() * field * of_times_).cwiseProduct(factors);
    field = of_heights_ * parts * of_times_.transpose();
  }
  return unsorted(all);
}

MatrixXd NoiseCovariance::whitened(const MatrixXd& x) const {
  if (places_->is_grid_) return on_grid(x, -0.5);
  return unsorted(factor_.triangularView<Eigen::Lower>().solve(sorted(x)));
}

MatrixXd NoiseCovariance::whitened_transposed(const MatrixXd& x) const {
  if (places_->is_grid_) return on_grid(x, -0.5);  // symmetric
  return unsorted(factor_.triangularView<Eigen::Lower>().transpose().solve(sorted(x)));
}

MatrixXd NoiseCovariance::coloured(const MatrixXd& x) const {
  if (places_->is_grid_) return on_grid(x, 0.5);
  return unsorted(factor_.triangularView<Eigen::Lower>() * sorted(x));
}

}  // namespace shearfront::fit
