// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "shearfront/solution/observation.hpp"

namespace shearfront::fit {

/// Where numbers with correlated noise were measured, sorted for fast covariances.
///
/// A grid: every time has every height once (heights that differ by rounding are one). Otherwise covariances are dense
/// matrices. Guaranteed: independent of the order of the observations and of units.
class NoisePlaces {
 public:
  /// `in_unit_of_data`: the correlated part has one size in the unit of the data, not in that of each sigma.
  NoisePlaces(const std::vector<Observation>& observations, bool in_unit_of_data);

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(order_.size()); }
  [[nodiscard]] bool is_grid() const { return is_grid_; }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& heights() const { return heights_; }
  /// Why noise cannot be correlated over them: too many; empty if it can.
  [[nodiscard]] std::string refusal() const;

 private:
  friend class NoiseCovariance;
  std::vector<double> times_, heights_;      ///< ascending, each once
  std::vector<Eigen::Index> order_;          ///< observations by ascending time, then height
  std::vector<Eigen::Index> time_, height_;  ///< of each in that order
  Eigen::VectorXd weight_;                   ///< 1 / sigma_i in that order; empty: all are common_
  double common_ = 1;
  bool is_grid_ = false;
};

/// Numbers of a covariance.
struct NoiseShape {
  double length_z = std::numeric_limits<double>::infinity(),
         length_t = std::numeric_limits<double>::infinity();  ///< > 0; infinite: it does not change that way
  double independent = 0, correlated = 1;                     ///< >= 0, not both 0
};

/// Covariance of noise in units of sigma_i,
///
///     C_ij = independent delta_ij + correlated w_i w_j exp(-|z_i - z_j| / length_z - |t_i - t_j| / length_t),
///
/// w_i = 1, or 1 / sigma_i where the correlated part is in the unit of the data; and matrices W with W C W^T = 1.
///
/// On a grid with equal w the correlation is a product over times and heights, C = U diag U^T with U = U_t (x) U_z, and
/// W = C^(-1/2): a whitened number belongs to the place of its observation. Otherwise C = L L^T in the order of time and height,
/// W = L^-1: a whitened number is what the ones before do not foretell. Cost: n_t^3 + n_z^3, then n (n_t + n_z) per column; dense
/// n^3 / 3, then n^2.
class NoiseCovariance {
 public:
  NoiseCovariance(std::shared_ptr<const NoisePlaces> places, const NoiseShape& shape);

  [[nodiscard]] Eigen::MatrixXd whitened(const Eigen::MatrixXd& x) const;  ///< W x; a row per observation
  [[nodiscard]] Eigen::MatrixXd whitened_transposed(const Eigen::MatrixXd& x) const;  ///< W^T x
  [[nodiscard]] Eigen::MatrixXd coloured(const Eigen::MatrixXd& x) const;             ///< W^-1 x
  [[nodiscard]] double log_determinant() const { return log_determinant_; }           ///< of C
  /// About the most that whitening enlarges a number by.
  [[nodiscard]] double gain() const { return gain_; }
  [[nodiscard]] const NoisePlaces& places() const { return *places_; }

 private:
  [[nodiscard]] Eigen::MatrixXd on_grid(const Eigen::MatrixXd& x, double power) const;
  [[nodiscard]] Eigen::MatrixXd sorted(const Eigen::MatrixXd& x) const;
  [[nodiscard]] Eigen::MatrixXd unsorted(const Eigen::MatrixXd& x) const;

  std::shared_ptr<const NoisePlaces> places_;
  Eigen::MatrixXd of_times_, of_heights_;  ///< eigenvectors, of a grid
  Eigen::MatrixXd values_;                 ///< eigenvalues: height x time
  Eigen::MatrixXd factor_;                 ///< L, where it is dense
  double log_determinant_ = 0, gain_ = 1;
};

}  // namespace shearfront::fit
