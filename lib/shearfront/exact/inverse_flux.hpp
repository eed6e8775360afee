// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "shearfront/exact/flux_branch.hpp"
#include "shearfront/model/flux/flux.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// A convex (or, mirrored, concave) flux with one extremum and no flux at the ends of its range, in the
/// canonical form: G(u) = |f| / |f(m)| on 0 <= u <= 1, concave, 1 at u = peak().
///
/// States are given by their distance d >= 0 from the peak and a side (up: towards u = 1), fluxes by what
/// they lack to the capacity, e = 1 - G: e(d) is increasing and convex with e(0) = 0. Near the peak this
/// keeps the digits that G itself loses. The inverse branches d(e) are a root for parabolas and otherwise
/// found by Newton's method, which falls monotonically to the root because e is convex; it is exact after one
/// step on straight pieces. Next to the pure states G and the distance from them have their own functions, for the same
/// reason. Guarantees: e, d to a few u absolutely, relative accuracy for parabolas; G and the distance from a pure state
/// with relative accuracy. Cost: up
/// to 10 evaluations of f per inverse, or of polynomials for models with a kDegree (exact/flux_branch.hpp). Precondition: the flux passes
/// refusal(). Source: none, elementary.
template <Real Scalar>
class InverseFlux {
 public:
  explicit InverseFlux(Flux<Scalar> flux);

  [[nodiscard]] const Scalar& peak() const { return peak_; }
  /// A side that is a cubic between joints; null for any other.
  [[nodiscard]] const FluxBranch<Scalar>* branch(bool up) const {
    return branches_.empty() ? nullptr : &branches_[up];
  }
  /// Distance from the peak to the pure state of a side.
  [[nodiscard]] Scalar reach(bool up) const { return up ? Scalar(Scalar(1) - peak_) : peak_; }
  /// u of a state; exactly 1 or 0 at the end.
  [[nodiscard]] Scalar state(const Scalar& d, bool up) const {
    if (!(d < reach(up))) return Scalar(up ? 1 : 0);
    return up ? peak_ + d : peak_ - d;
  }
  /// e(d).
  [[nodiscard]] Scalar lack(const Scalar& d, bool up) const;
  /// e'(d) = |dG/du|; at the peak that of the side.
  [[nodiscard]] Scalar slope(const Scalar& d, bool up) const;
  /// e''(d). For fluxes without second_derivative() by a difference of e' over 2^-13 of the range.
  [[nodiscard]] Scalar bend(const Scalar& d, bool up) const;
  /// d(e), 0 <= e <= 1.
  [[nodiscard]] Scalar inverse(const Scalar& e, bool up) const;
  /// G of the state at this distance from the pure one of a side.
  [[nodiscard]] Scalar flux_beside(const Scalar& distance, bool up) const;
  /// The distance from the pure state of a side at which the flux is G, 0 <= G < 1: reach(up) - d(1 - G).
  [[nodiscard]] Scalar distance_beside(const Scalar& G, bool up) const;

  /// G of a state u.
  [[nodiscard]] Scalar height_of(const Scalar& u) const {
    if (u == Scalar(0) || u == Scalar(1)) return Scalar(0);
    const bool up = u > peak_;
    const Scalar e = lack(up ? Scalar(u - peak_) : Scalar(peak_ - u), up);
    return e + e > Scalar(1) ? flux_beside(up ? Scalar(Scalar(1) - u) : u, up) : Scalar(Scalar(1) - e);
  }
  /// G over the distance from the pure state, and dG by it.
  struct Rise {
    Scalar chord, slope;
  };
  [[nodiscard]] Rise rise_beside(const Scalar& distance, bool up) const;
  /// The slope of the chord of G between two states at these distances from the pure one of a side.
  [[nodiscard]] Scalar chord_beside(const Scalar& distance1, const Scalar& distance2, bool up) const;
  /// Whether it has a slope at its peak, on any side.
  [[nodiscard]] bool has_kink() const { return kink_[0] > 0 || kink_[1] > 0; }
  /// Whether it is analytic on both sides of its peak, or between joints.
  [[nodiscard]] bool is_smooth() const { return is_smooth_; }
  /// Distances from the pure state of a side at which it is not, ascending.
  [[nodiscard]] const std::vector<Scalar>& joints(bool up) const { return joints_[up]; }

 private:
  [[nodiscard]] static Scalar size(const Scalar& x) { return x < 0 ? Scalar(-x) : x; }
  [[nodiscard]] Scalar place(const Scalar& d, bool up) const {
    return up == is_concave_ ? extremum_ - width_ * d : extremum_ + width_ * d;
  }
  [[nodiscard]] const Scalar& pure_share(bool up) const { return up == is_concave_ ? lowest_ : highest_; }
  [[nodiscard]] Scalar place_beside(const Scalar& distance, bool up) const {
    return up == is_concave_ ? lowest_ + width_ * distance : highest_ - width_ * distance;
  }
  [[nodiscard]] FluxBranch<Scalar> branch_of(bool up) const;
  template <class Model>
  [[nodiscard]] Scalar distance_of(const Model& f, const Scalar& G, bool up) const;
  template <class Model>
  [[nodiscard]] Scalar lack_of(const Model& f, const Scalar& d, bool up) const;
  template <class Model>
  [[nodiscard]] Scalar slope_of(const Model& f, const Scalar& d, bool up) const;
  template <class Model>
  [[nodiscard]] Scalar bend_of(const Model& f, const Scalar& d, bool up) const;
  template <class Model>
  [[nodiscard]] Scalar inverse_of(const Model& f, const Scalar& e, bool up) const;

  Flux<Scalar> flux_;
  bool is_concave_ = false, is_smooth_ = false;
  Scalar lowest_{0}, highest_{1}, width_{1}, extremum_{0}, depth_{1}, peak_{0};
  std::vector<Scalar> joints_[2];
  std::vector<FluxBranch<Scalar>> branches_;  ///< down and up, or none
  Scalar kink_[2] = {Scalar(0), Scalar(0)};   ///< e'(0) down and up
};

}  // namespace shearfront::exact
