// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// The coordinates u a search moves in, as many as parameters p. They have no unit and are of order one, so that
/// steps and tolerances are numbers: with unit and origin of Parameter,
///
///   positive entries   u = 1 + log(p / unit) (a factor 10 is the same step everywhere; 1 at the start, so that a
///                      relative change of u is one of p)
///   others             u = (p - origin) / unit
///   shape decreasing   for the values v_0..v_n of a(z):  u_n = 1 + log(v_n / unit),  w u_k = v_k - v_{k+1} >= 0,
///                      w the unit of v_0
///   shape convex       u_n as before,  w u_{n-1} = v_{n-1} - v_n >= 0,
///                      w u_k = (v_k - v_{k+1}) - (v_{k+1} - v_{k+2}) >= 0
///
/// so every point of the box lower() <= u <= upper() has the shape, and its faces are the limits of the
/// shape. Bounds of the parameters become bounds of the coordinates where one follows from the other (no
/// shape; v_n; a step is no larger than upper(v_k) - lower(v_n)); the others are left to
/// Parameters::within_bounds. u -> p is smooth and one-to-one, also outside the box, where p lacks the shape.
class Coordinates {
 public:
  explicit Coordinates(const Parameters& parameters);

  [[nodiscard]] Eigen::Index size() const { return lower_.size(); }
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  [[nodiscard]] Eigen::VectorXd values(const Eigen::VectorXd& u) const;       ///< p(u); bounds exactly
  [[nodiscard]] Eigen::VectorXd coordinates(const Eigen::VectorXd& p) const;  ///< u(p), inside the box
  /// Which coordinates are at a bound: exactly, or within the step a search could still make.
  [[nodiscard]] std::vector<bool> at_bound(const Eigen::VectorXd& u) const;
  /// The parameters that lose their freedom when u_j is at a bound: j itself; with a shape the values made
  /// equal (u_j = v_j - v_{j+1} = 0) or put on a straight line.
  [[nodiscard]] std::vector<Eigen::Index> bound_together(Eigen::Index j) const;
  [[nodiscard]] Eigen::VectorXd unbounded(const Eigen::VectorXd& p) const;  ///< u(p), wherever it is
  /// Derivatives with respect to p (one row per number that has them) turned into those with respect to u, d dp/du.
  [[nodiscard]] Eigen::MatrixXd turned(const Eigen::VectorXd& u, Eigen::MatrixXd d) const;
  /// dp/du: column j belongs to u_j.
  [[nodiscard]] Eigen::MatrixXd derivative(const Eigen::VectorXd& u) const;

  [[nodiscard]] const std::string& name(Eigen::Index j) const { return names_[static_cast<std::size_t>(j)]; }
  [[nodiscard]] bool is_positive(Eigen::Index j) const { return is_positive_[static_cast<std::size_t>(j)]; }
  /// u_j of a value p_j and back, as if there were no shape, and dp_j/du_j at p_j.
  [[nodiscard]] double scaled(Eigen::Index j, double p) const;
  [[nodiscard]] double unscaled(Eigen::Index j, double u) const;
  [[nodiscard]] double slope(Eigen::Index j, double p) const { return is_positive(j) ? p : units_[j]; }
  [[nodiscard]] double unit(Eigen::Index j) const { return units_[j]; }
  /// w, which makes numbers of the steps of a shape.
  [[nodiscard]] double step_unit() const { return units_[shaped_.front()]; }
  [[nodiscard]] Shape shape() const { return shape_; }
  /// Positions of v_0..v_n if there is a shape, otherwise empty; all but the last are steps u_k >= 0.
  [[nodiscard]] const std::vector<Eigen::Index>& shaped() const { return shaped_; }
  /// Bounds of the parameters themselves.
  [[nodiscard]] const Eigen::VectorXd& lowest_values() const { return lowest_values_; }
  [[nodiscard]] const Eigen::VectorXd& highest_values() const { return highest_values_; }

 private:
  std::vector<std::string> names_;
  std::vector<bool> is_positive_;
  std::vector<Eigen::Index> shaped_;  ///< positions of v_0..v_n if there is a shape
  Shape shape_;
  Eigen::VectorXd lower_, upper_, lowest_values_, highest_values_, units_, origins_;
};

}  // namespace shearfront::fit
