// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <vector>

#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// The coordinates u a search moves in, as many as parameters p.
///
///   positive entries        u = log p (a factor 10 is the same step everywhere)
///   heights, concentrations u = p
///   shape decreasing        for the values v_0..v_n of a(z):  u_n = log v_n,  u_k = v_k - v_{k+1} >= 0
///   shape convex            u_n = log v_n,  u_{n-1} = v_{n-1} - v_n >= 0,
///                           u_k = (v_k - v_{k+1}) - (v_{k+1} - v_{k+2}) >= 0
///
/// so every point of the box lower() <= u <= upper() has the shape, and its faces are the limits of the
/// shape. Bounds of the parameters become bounds of the coordinates where one follows from the other (no
/// shape; v_n); the others are left to Parameters::within_bounds. u -> p is smooth and one-to-one.
class Coordinates {
 public:
  explicit Coordinates(const Parameters& parameters);

  [[nodiscard]] Eigen::Index size() const { return lower_.size(); }
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  [[nodiscard]] Eigen::VectorXd values(const Eigen::VectorXd& u) const;       ///< p(u)
  [[nodiscard]] Eigen::VectorXd coordinates(const Eigen::VectorXd& p) const;  ///< u(p), inside the box
  /// The parameters that lose their freedom when u_j is at a bound: j itself; with a shape the values made
  /// equal (u_j = v_j - v_{j+1} = 0) or put on a straight line.
  [[nodiscard]] std::vector<Eigen::Index> bound_together(Eigen::Index j) const;
  /// dp/du: column j belongs to u_j.
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::VectorXd& u) const;

 private:
  std::vector<bool> is_logarithmic_;
  std::vector<Eigen::Index> shaped_;  ///< positions of v_0..v_n if there is a shape
  Shape shape_;
  Eigen::VectorXd lower_, upper_;
};

}  // namespace shearfront::fit
