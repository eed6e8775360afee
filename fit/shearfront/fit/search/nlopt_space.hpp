// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

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

  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  [[nodiscard]] Eigen::VectorXd u(const Eigen::VectorXd& v) const;  ///< outside the box if v lacks the shape
  [[nodiscard]] Eigen::VectorXd v(const Eigen::VectorXd& u) const;  ///< inside lower()..upper()
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::VectorXd& u) const;  ///< du/dv
  /// First steps: a tenth of the value, for heights a tenth of their range.
  [[nodiscard]] Eigen::VectorXd steps(const Eigen::VectorXd& u) const;
  /// Coordinates u_k that a constraint must keep >= 0; empty where the box does it.
  [[nodiscard]] const std::vector<Eigen::Index>& constrained() const { return constrained_; }

 private:
  enum class Kind { coordinates, logarithmic_steps, values };

  const Coordinates* coordinates_;
  Kind kind_ = Kind::coordinates;
  std::vector<Eigen::Index> steps_, constrained_;
  double unit_ = 1;  ///< c
  Eigen::VectorXd lower_, upper_;
};

}  // namespace shearfront::fit
