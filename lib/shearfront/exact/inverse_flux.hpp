// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <utility>
#include <variant>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// A convex (or, mirrored, concave) flux with one extremum and no flux at the ends of its range, in the
/// canonical form: G(u) = |f| / |f(m)| on 0 <= u <= 1, concave, 1 at u = peak().
///
/// States are given by their distance d >= 0 from the peak and a side (up: towards u = 1), fluxes by what
/// they lack to the capacity, e = 1 - G: e(d) is increasing and convex with e(0) = 0. Near the peak this
/// keeps the digits that G itself loses. The inverse branches d(e) are a root for parabolas and otherwise
/// found by Newton's method, which falls monotonically to the root because e is convex; it is exact after one
/// step on straight pieces. Guarantees: e, d to a few u absolutely, relative accuracy for parabolas. Cost: up
/// to 10 evaluations of f per inverse. Precondition: the flux passes refusal(). Source: none, elementary.
template <Real Scalar>
class InverseFlux {
 public:
  explicit InverseFlux(Flux<Scalar> flux) : flux_(std::move(flux)) {
    std::visit(
        [&](const auto& f) {
          const auto range = f.range();
          is_concave_ = f.curvature() == Curvature::concave;
          width_ = range.highest - range.lowest;
          extremum_ = f.extrema().front();
          depth_ = size(f.value(extremum_));
          peak_ = (is_concave_ ? range.highest - extremum_ : extremum_ - range.lowest) / width_;
          const Scalar near = width_ / Scalar(1 << 20);
          // A smooth flux has no slope at its extremum, up to rounding; a kink keeps those of its two sides.
          if (size(f.derivative(extremum_)) * width_ <= depth_ / Scalar(1 << 16)) return;
          for (const bool up : {true, false})
            kink_[up] =
                size(f.secant(extremum_, Scalar(up == is_concave_ ? extremum_ - near : extremum_ + near))) *
                width_ / depth_;
        },
        flux_);
  }

  [[nodiscard]] const Scalar& peak() const { return peak_; }
  /// Distance from the peak to the pure state of a side.
  [[nodiscard]] Scalar reach(bool up) const { return up ? Scalar(Scalar(1) - peak_) : peak_; }
  /// u of a state; exactly 1 or 0 at the end.
  [[nodiscard]] Scalar state(const Scalar& d, bool up) const {
    if (!(d < reach(up))) return Scalar(up ? 1 : 0);
    return up ? peak_ + d : peak_ - d;
  }
  /// e(d).
  [[nodiscard]] Scalar lack(const Scalar& d, bool up) const {
    return std::visit([&](const auto& f) { return lack_of(f, d, up); }, flux_);
  }
  /// e'(d) = |dG/du|; at the peak that of the side.
  [[nodiscard]] Scalar slope(const Scalar& d, bool up) const {
    return std::visit([&](const auto& f) { return slope_of(f, d, up); }, flux_);
  }
  /// e''(d). For fluxes without second_derivative() by a difference of e' over 2^-13 of the range.
  [[nodiscard]] Scalar bend(const Scalar& d, bool up) const {
    return std::visit([&](const auto& f) { return bend_of(f, d, up); }, flux_);
  }
  /// d(e), 0 <= e <= 1.
  [[nodiscard]] Scalar inverse(const Scalar& e, bool up) const {
    if (!(e > 0)) return Scalar(0);
    if (!(e < 1)) return reach(up);
    return std::visit([&](const auto& f) { return inverse_of(f, e, up); }, flux_);
  }

 private:
  [[nodiscard]] static Scalar size(const Scalar& x) { return x < 0 ? Scalar(-x) : x; }
  template <class Model>
  static constexpr bool kParabola = Model::kIsParabola;
  [[nodiscard]] Scalar place(const Scalar& d, bool up) const {
    return up == is_concave_ ? extremum_ - width_ * d : extremum_ + width_ * d;
  }
  template <class Model>
  [[nodiscard]] Scalar lack_of(const Model& f, const Scalar& d, bool up) const {
    if constexpr (kParabola<Model>) return Scalar(4) * d * d;
    return size(f.secant(extremum_, place(d, up))) * (width_ * d / depth_);
  }
  template <class Model>
  [[nodiscard]] Scalar slope_of(const Model& f, const Scalar& d, bool up) const {
    if constexpr (kParabola<Model>) return Scalar(8) * d;
    const Scalar x = place(d, up);
    if (x == extremum_) return kink_[up];
    return size(f.derivative(x)) * (width_ / depth_);
  }
  template <class Model>
  [[nodiscard]] Scalar bend_of(const Model& f, const Scalar& d, bool up) const {
    if constexpr (kParabola<Model>) {
      return Scalar(8);
    } else if constexpr (requires { f.second_derivative(extremum_); }) {
      return size(f.second_derivative(place(d, up))) * (width_ * width_ / depth_);
    } else {
      const Scalar step = Scalar(1) / Scalar(1 << 13);
      const Scalar lo = d > step ? Scalar(d - step) : Scalar(0);
      const Scalar hi = d + step < reach(up) ? Scalar(d + step) : reach(up);
      return (slope_of(f, hi, up) - slope_of(f, lo, up)) / (hi - lo);
    }
  }
  template <class Model>
  [[nodiscard]] Scalar inverse_of(const Model& f, const Scalar& e, bool up) const {
    using std::sqrt;
    const Scalar root = sqrt(e);
    if constexpr (kParabola<Model>) return root / Scalar(2);
    const Scalar most = reach(up);
    Scalar d = most * root;
    constexpr int kMostSteps = 200;
    for (int n = 0; n < kMostSteps; ++n) {
      const Scalar slope = slope_of(f, d, up);
      if (!(slope > 0)) break;
      Scalar next = d - (lack_of(f, d, up) - e) / slope;
      if (next > most) next = most;
      if (!(next > 0)) break;
      // After the first step every d lies above the root: no further decrease means rounding.
      if (n > 0 && !(next < d)) break;
      d = next;
    }
    return d;
  }

  Flux<Scalar> flux_;
  bool is_concave_ = false;
  Scalar width_{1}, extremum_{0}, depth_{1}, peak_{0};
  Scalar kink_[2] = {Scalar(0), Scalar(0)};  ///< e'(0) down and up
};

}  // namespace shearfront::exact
