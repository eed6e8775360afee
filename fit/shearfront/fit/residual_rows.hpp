// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "shearfront/fit/forward.hpp"
#include "shearfront/fit/noise_covariance.hpp"
#include "shearfront/solution/observation.hpp"

namespace shearfront::fit {

/// A number times something counted elsewhere.
struct Term {
  std::size_t index = 0;
  double coefficient = 0;
};

/// Residuals that are linear in the solution and in the data:
///
///     r_i = weight_i ( sum_j c_ij X(point_j) - sum_k d_ik y_k ),     X = phi or M, y_k the observations.
///
/// weight_i = 1 / sigma_i with sigma_i^2 = sum_k d_ik^2 sigma_k^2 from the noise of the observations, taken
/// as independent unless `noise` says otherwise; 1 in place of sigma_k where it is not known. Running sums are kept as what each row adds to
/// the one before: memory and time are linear in the observations.
struct ResidualRows {
  struct Row {
    std::size_t model_end = 0,
                data_end = 0;  ///< where its terms end; they begin where those of the row before do
    double target = 0, weight = 1;
    /// The sums go on from the row before; model and data are what is added, target is not.
    bool continues = false;
  };
  Observable field = Observable::phi;
  std::vector<Place> points;
  std::vector<Row> rows;
  std::vector<Term> model_terms,
      data_terms;  ///< of all rows: one block each, for there may be a million rows
  /// Size of what the residuals are differences of: they are numbers beside it. 1 where they are in units of sigma.
  double unit = 1;
  /// Of correlated noise in units of sigma_i: the residuals are whitened by it. Null: independent. Rows are then single.
  std::shared_ptr<const NoiseCovariance> noise;

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(rows.size()); }
  /// c_ij of row i, index into points.
  [[nodiscard]] std::span<const Term> model(std::size_t i) const {
    return terms(model_terms, i > 0 ? rows[i - 1].model_end : 0, rows[i].model_end);
  }
  /// d_ik of row i, index into the observations.
  [[nodiscard]] std::span<const Term> data(std::size_t i) const {
    return terms(data_terms, i > 0 ? rows[i - 1].data_end : 0, rows[i].data_end);
  }
  /// weight_i (model - target) for values at the points, whitened.
  [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& values) const;
  /// The same combination of derivatives at the points (row = point).
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::MatrixXd& derivatives) const;
  /// sum_i s_i dr_i/dX at each point, s one number per row: the transpose of jacobian().
  [[nodiscard]] Eigen::VectorXd slopes(const Eigen::VectorXd& of_rows) const;
  /// What was whitened, back in units of sigma_i.
  [[nodiscard]] Eigen::MatrixXd coloured(const Eigen::MatrixXd& whitened) const {
    return noise ? noise->coloured(whitened) : whitened;
  }
  /// Whether every row is one observation, so that residuals are as independent as these.
  [[nodiscard]] bool are_single() const;
  /// Only the rows marked; the points stay. Precondition: no row continues another.
  [[nodiscard]] ResidualRows selected(const std::vector<bool>& keep) const;

 private:
  [[nodiscard]] static std::span<const Term> terms(const std::vector<Term>& all, std::size_t begin,
                                                   std::size_t end) {
    return std::span(all).subspan(begin, end - begin);
  }
};

/// Puts rows together; every place is asked of the solver once.
class RowBuilder {
 public:
  RowBuilder(const Observations& observations, Observable field) : observations_(&observations) {
    rows_.field = field;
    rows_.rows.reserve(observations.rows.size());
    rows_.points.reserve(observations.rows.size());
    for (const Observation& o : observations.rows)
      slack_ = std::max(slack_, kSamePlace * (std::abs(o.z) + o.width / 2));
  }

  /// A coefficient of X(t, z) in the row being built.
  void model(double t, double z, double coefficient) { model_.push_back({place(t, z), coefficient}); }
  /// A coefficient of observation k; the same k again right afterwards adds up.
  void data(std::size_t k, double coefficient);
  void finish_row();
  /// Observation k against X at its place.
  void row_of(std::size_t k) {
    model(observations_->rows[k].t, observations_->rows[k].z, 1);
    data(k, 1);
    finish_row();
  }
  /// Finishes the row; the next one adds to its sums. Terms of one observation must follow each other.
  void finish_row_of_sum();
  void end_sum();
  [[nodiscard]] ResidualRows take() { return std::move(rows_); }

 private:
  /// Edges of neighbouring bins, z + width / 2 and z' - width' / 2, agree up to rounding of decimal numbers, relative
  /// to the largest.
  static constexpr double kSamePlace = 1e-13;
  [[nodiscard]] std::size_t place(double t, double z);

  const Observations* observations_;
  double slack_ = 0;
  ResidualRows rows_;
  std::vector<Term> model_, data_;  ///< of the row being built
  bool continues_ = false;
  double target_ = 0, variance_ = 0;  ///< of the sum so far, without the last observation in the variance
  Term last_;                         ///< that observation
  std::map<Place, std::size_t> places_;
};

/// The observations of one time, by ascending height.
struct MeasuredProfile {
  double t = 0;
  std::vector<std::size_t> rows;
};

/// All observations as profiles, by ascending time.
[[nodiscard]] std::vector<MeasuredProfile> measured_profiles(const Observations& observations);

}  // namespace shearfront::fit
