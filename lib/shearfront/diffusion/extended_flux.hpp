// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "shearfront/model/flux/flux.hpp"

namespace shearfront::diffusion {

/// A flux for all real states: outside its range f goes on along the tangents at the ends, as iterates of an
/// implicit step may stray there. So |f'| <= fastest() for all states.
/// may_leave_tangents: polynomials of degree two go on along themselves instead, which is cheaper.
template <class Model, bool may_leave_tangents>
class ExtendedFlux {
 public:
  explicit ExtendedFlux(const Model& flux) : flux_(flux), range_(flux.range()) {}

  [[nodiscard]] double value(double phi) const {
    if constexpr (kIsEntire) {
      return flux_.value(phi);
    } else {
      const double inside = clamp(phi);
      const double f = flux_.value(inside);
      return phi == inside ? f : f + flux_.derivative(inside) * (phi - inside);
    }
  }
  [[nodiscard]] double derivative(double phi) const {
    if constexpr (kIsEntire) return flux_.derivative(phi);
    return flux_.derivative(clamp(phi));
  }
  /// max |f'| over the range: at an end if f' is monotone, from samples otherwise.
  [[nodiscard]] double fastest() const {
    const int n_samples = flux_.curvature() == Curvature::mixed ? 4097 : 2;
    double fastest = 0;
    for (int i = 0; i < n_samples; ++i) {
      const double share = static_cast<double>(i) / (n_samples - 1);
      const double phi =
          i + 1 == n_samples ? range_.highest : range_.lowest + (range_.highest - range_.lowest) * share;
      fastest = std::max(fastest, std::abs(flux_.derivative(phi)));
    }
    return fastest;
  }

 private:
  static constexpr bool kIsEntire = may_leave_tangents && is_quadratic_polynomial<Model>();

  [[nodiscard]] double clamp(double phi) const { return std::clamp(phi, range_.lowest, range_.highest); }

  Model flux_;
  StateRange<double> range_;
};

/// W = max |f'| over the range of a flux; from samples if f' is not monotone.
inline double fastest_slope(const Flux<double>& flux) {
  return ExtendedFlux<Flux<double>, false>(flux).fastest();
}

}  // namespace shearfront::diffusion
