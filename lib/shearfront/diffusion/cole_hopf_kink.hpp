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
/// Between ends with phi_z = 0 it is a solution up to end_effect().
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

  /// How far the solution between ends with phi_z = 0 at `bottom` and `top` may be from the kink at time t, an
  /// estimate from above for rate > 0. With k = r g / D, v = |speed| and E = g exp(-k distance) of an end:
  ///
  ///   (1) at the end phi misses a layer of E, and r f' carries the slope -phi_z <= k E that is missing into the
  ///       bed, which makes r int k E dt there, for |f'| <= 1;
  ///   (2) so no more than r ((1)) + D k E goes through the end unseen a unit of time; what went through moves the
  ///       kink, whose slope is at most k g / 4, by as much / g.
  ///
  /// E of the end ahead is largest at t and lasts for 1 / (k v), that of the end behind in the beginning, but what
  /// it left there goes on. The bed is given up where a front has reached an end: g.
  [[nodiscard]] Scalar end_effect(const Scalar& top, const Scalar& t) const;

 private:
  Scalar bottom_, center_, speed_, rate_, diffusivity_;
  Scalar state_, steepness_;  ///< g and r g / D
  Scalar gap_;                ///< 1 - g
};

extern template class Kink<double>;

}  // namespace shearfront::diffusion
