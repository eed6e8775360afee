// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <vector>

#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/search/nlopt_algorithm.hpp"

namespace shearfront::fit {

/// The variables v an algorithm of NLopt moves, made of the coordinates u.
///
///   no shape                      v = u
///   shape, local, no constraints  v = u: the box is the shape
///   shape, local or global,
///   with constraints              v = log p of positive entries, others p; the shape is u_k(v) >= 0
///   shape, global                 v = u but for the steps  v_k = log(1 + u_k / c), c = a thousandth of the
///                                 start: as a set to be searched evenly, steps need a logarithmic scale
class NloptSpace {
 public:
  NloptSpace(const Coordinates& coordinates, const Eigen::VectorXd& start_u, const NloptAlgorithm& algorithm);

  [[nodiscard]] bool is_preconditioned() const { return map_.size() > 0; }
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  [[nodiscard]] Eigen::VectorXd u(const Eigen::VectorXd& v) const;  ///< outside the box if v lacks the shape
  [[nodiscard]] Eigen::VectorXd v(
      const Eigen::VectorXd& u) const;  ///< inside lower()..upper(); not preconditioned
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::VectorXd& u) const;  ///< du/dv
  /// Derivatives with respect to u (a row for each number that has them) turned into those with respect to v.
  [[nodiscard]] Eigen::MatrixXd turned(const Eigen::VectorXd& u, const Eigen::MatrixXd& d) const;
  /// First steps: a tenth of the value, for heights a tenth of their range.
  [[nodiscard]] Eigen::VectorXd steps(const Eigen::VectorXd& u) const;
  /// What must be <= 0 besides the box: -u_k of the steps, and the box itself once preconditioned.
  [[nodiscard]] Eigen::VectorXd excess(const Eigen::VectorXd& v) const;
  [[nodiscard]] Eigen::MatrixXd excess_derivative(const Eigen::VectorXd& v) const;  ///< not preconditioned

  /// Replaces v by w with v = v(u) + W w, W W^T ~ the inverse of J^T J: the misfit is then about as steep in
  /// every direction. A step of w is one of v in the flattest direction, and no less than 1 / kMostUneven of
  /// it in the steepest. w has no bounds: they become constraints.
  void precondition(const Eigen::VectorXd& u, const Eigen::MatrixXd& jacobian);

 private:
  enum class Kind { coordinates, logarithmic_steps, values };

  const Coordinates* coordinates_;
  Kind kind_ = Kind::coordinates;
  std::vector<Eigen::Index> steps_, constrained_;
  double unit_ = 1;  ///< c
  Eigen::VectorXd centre_;
  Eigen::MatrixXd map_;  ///< W; empty: not preconditioned
  Eigen::VectorXd lower_, upper_;
};

}  // namespace shearfront::fit
