// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/scene/entries.hpp"

namespace shearfront::fit {

/// One coordinate x for each unknown p, -infinity < x < infinity, both ways smooth inside the bounds l < p < h: what a sampler
/// moves in. With s(x) = 1 / (1 + exp(-x))
///
///   l and h finite         p = l + (h - l) s(x); of log p where 0 < l and h > kWide l: p = l (h / l)^s(x)
///   l alone                p = l + exp(x)
///   h alone                p = h - exp(x)
///   none                   p = x
///
/// and an order holds because l follows the unknowns before: of breaks the one below, of the values of a(z) with a shape
/// the one above, v_k > v_{k+1}, and if convex v_k > 2 v_{k+1} - v_{k+2} but for the topmost two. There l is the larger of that
/// and of the bound, and p is not taken by its logarithm. dp/dx is triangular in the order in which they are made, so that
///
///   log |det dp/dx| = sum_i log |dp_i/dx_i|.
///
/// Guaranteed: (1) p(x) keeps all bounds and orders; (2) values and coordinates are each other's inverse up to rounding for
/// |x| < log(1e6) of those with two ends. Where one end follows others and meets the bound, derivatives jump.
class UnboundedCoordinates {
 public:
  static constexpr double kWide = 10;

  struct Point {
    Eigen::VectorXd p;
    Eigen::MatrixXd derivative;  ///< dp/dx: row = unknown, column = coordinate
    double log_volume = 0;       ///< log |det dp/dx|
    Eigen::VectorXd slope;       ///< its gradient in x
  };

  /// One entry, one lower and one upper bound (may be infinite) for each unknown. The shape is that of shear_rate.values.
  UnboundedCoordinates(const std::vector<Entry>& entries, Eigen::VectorXd lower, Eigen::VectorXd upper,
                       Shape shape);

  [[nodiscard]] Eigen::Index size() const { return lower_.size(); }
  /// The unknowns at x; none where rounding leaves no room for them, or x is not finite. Cost: n^2.
  [[nodiscard]] std::optional<Point> at(const Eigen::VectorXd& x) const;
  /// x of the unknowns p; those at a bound, or beyond, are moved inside by a millionth: of the room, or of their size
  /// where that has one end.
  [[nodiscard]] Eigen::VectorXd coordinates(Eigen::VectorXd p) const;
  /// Whether p keeps bounds and orders, the ends themselves included.
  [[nodiscard]] bool contains(const Eigen::VectorXd& p) const;

 private:
  struct Term {
    Eigen::Index unknown = 0;
    double coefficient = 0;
  };
  struct Room {
    double low = 0, high = 0;
    bool follows = false, is_log = false;  ///< whether low follows others; whether it is one of log p
  };
  /// Of p_i, with those that it follows in place.
  [[nodiscard]] Room room(Eigen::Index i, const Eigen::VectorXd& p) const;
  void order_elements(const std::vector<Entry>& entries, Shape shape);

  Eigen::VectorXd lower_, upper_;
  std::vector<std::vector<Term>> floor_;  ///< of each the sum that bounds it from below; empty: none
  std::vector<Eigen::Index> order_;       ///< in which they are made
};

}  // namespace shearfront::fit
