// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/diffusion/cole_hopf_point.hpp"

namespace shearfront::diffusion {

/// The steady state of phi_t + (r phi (phi - 1))_z = D phi_zz between no-flux walls with the mean phi0,
///
///     phi = 1 / (1 + exp(r (z - z_c) / D)),     d = D / (r height),
///     z_c = bottom + height phi0 - (D / r) ln(expm1(-(1 - phi0) / d) / expm1(-phi0 / d))
///
/// (written for r > 0; for r < 0 the bed is turned upside down).
///
/// Domain: bottom < top, r != 0, D > 0, 0 <= phi0 <= 1; z in the bed. Guarantees, for every d that is a
/// normal number: phi, 1 - phi and M relatively exact to about (10 + 3 / d) roundoffs, M(top) = phi0 height
/// likewise. Errors: none. Cost: 30 ns in double. Source: Gray & Chugunov (2006), section 4.
template <Real Scalar>
class SteadyState {
 public:
  SteadyState(Scalar bottom, Scalar top, Scalar rate, Scalar diffusivity, Scalar mean);

  [[nodiscard]] ColeHopfPoint<Scalar> at(const Scalar& z) const;
  /// Where phi = 1/2; outside the bed, at an infinite height for phi0 = 0 and 1, if it is 1/2 nowhere.
  [[nodiscard]] Scalar center() const;

 private:
  Scalar bottom_, top_, height_, mean_;
  bool is_up_;      ///< r > 0
  Scalar d_;        ///< D / (|r| height)
  Scalar at_wall_;  ///< the exponent at the wall to which phi is carried
};

extern template class SteadyState<double>;

}  // namespace shearfront::diffusion
