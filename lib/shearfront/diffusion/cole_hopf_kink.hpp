// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/diffusion/cole_hopf_point.hpp"

namespace shearfront::diffusion {

/// The travelling kink of phi_t + (r phi (phi - 1))_z = D phi_zz on the whole line,
///
///     phi = g / (1 + exp(r g (z - center - speed t) / D)),     g = 1 + speed / r:
///
/// a smoothed shock between the states g and 0, whose speed r (g - 1) is the shock's. With f = -r this is
/// g/2 (1 + tanh((f - speed) (z - center - speed t) / (2 D))). For speed = 0 it is the steady front.
/// Between ends with phi_z = 0 it is a solution as long as its gradient there is below rounding.
///
/// Units: heights, times, r in height/time, D in height^2/time. Domain: r != 0, D > 0, speed / r in (-1, 0].
/// Guarantees: phi, M and phi_z are relatively exact to about (10 + 2 |e|) roundoffs, e the argument of the
/// exponential, the rounding of z - center - speed t aside. Errors: none. Cost: 30 ns in double.
/// Source: Whitham (1974), Linear and Nonlinear Waves, section 4.3; Christov (2018), equation 6.
template <Real Scalar>
class Kink {
 public:
  /// `bottom`: where M begins.
  Kink(Scalar bottom, Scalar rate, Scalar diffusivity, Scalar center, Scalar speed);

  [[nodiscard]] ColeHopfPoint<Scalar> at(const Scalar& z, const Scalar& t) const;

 private:
  Scalar bottom_, center_, speed_;
  Scalar state_, steepness_;  ///< g and r g / D
  Scalar gap_;                ///< 1 - g
};

extern template class Kink<double>;

}  // namespace shearfront::diffusion
