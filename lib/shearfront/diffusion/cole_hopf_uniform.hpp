// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/diffusion/cole_hopf_point.hpp"

namespace shearfront::diffusion {

/// The solution of phi_t + (r phi (phi - 1))_z = D phi_zz between no-flux walls, r phi (phi - 1) = D phi_z,
/// from phi(z, 0) = phi0, for all times.
///
/// For r > 0 (for r < 0 the bed is turned upside down) put x = (z - bottom) / h, y = 1 - x, time in units of
/// h / |r|, d = D / (|r| h), u0 = 2 phi0 - 1, a = u0 / (2 d), b = 1 / (2 d). Then phi = 1/2 - d w_x / w where
///
///     w_t = d w_xx - w / (4 d),   w(x, 0) = exp(-a x),   w(0, t) = 1,   w(1, t) = exp(-a),
///
/// the growth exp(t / (4 d)) being taken out. So M = x / 2 - d ln w without quadrature, and with the flux
/// -phi0 (1 - phi0) V / w
///
///     d phi_x = phi0 (1 - phi0) V / w - phi (1 - phi),
///
/// where V is the solution with the same start and 0 at the walls. phi = P / w and 1 - phi = Q / w with
///
///     P = (1/2 - d d/dx) w,   Q = (1/2 + d d/dx) w,   P + Q = w,   P, Q > 0,
///
/// both summed on their own so that neither tail is a difference. With the images
///
///     E_k(s) = exp((k^2 d - 1 / (4 d)) t - k s) erfc((s - 2 k d t) / sqrt(4 d t)) / 2,
///
/// the Laplace transform gives
///
///     P = phi0 exp(-a x - phi0 (1 - phi0) t / d)
///         + sum_n [T(x + 2 n) - e^-a T(1 + x + 2 n) - e^-a U(y + 2 n) + U(1 + y + 2 n)],   n = 0, 1, ...
///     T = E_b - phi0 E_a - (1 - phi0) E_-a,       U = -E_-b + (1 - phi0) E_a + phi0 E_-a,
///
/// and Q from P by exchanging phi with 1 - phi and x with y; the first term and its two images of the same
/// exponent are one difference of error functions. Later the sine series about the logistic steady state is
/// summed (decay 1 / (4 d) + d n^2 pi^2). Terms are mantissas with exponents, erfc is scaled, so nothing
/// over- or underflows before phi or 1 - phi itself does.
///
/// Units: heights, times, r in height/time, D in height^2/time.
/// Domain: bottom <= z <= top, r != 0, D > 0, 1e-12 <= d <= 1e12, 0 <= phi0 <= 1, t >= 0, infinity allowed
/// (SteadyState).
/// Guarantees, u the unit roundoff, for t |r| / h = 0 or >= 1e-6 and phi, 1 - phi > 1e-290:
///   (1) phi and 1 - phi: relative error <= u (4 + 2 / d) / (phi0 (1 - phi0)). Double, phi0 = 0.55: below 5e-13
///       for d >= 0.002, in every tail; measured 1.2e-13, 1e-14, 2e-15, 1e-15 for d = 0.002, 0.02, 0.1, 0.5.
///       1 / d is the condition of the tails exp(-(x - x_c) / d).
///   (2) M: absolute error <= u (4 + 4 d) h, M(bottom) = 0 and M(top) = phi0 h likewise, at every time
///   (3) phi_z: absolute error <= u (4 + 2 / d) / (d h)
/// Errors: none. Cost: 0.1 to 0.5 us for d = 0.002, at most 2 us (d = 0.1, t = 1) in double; 0.05 to 7 ms with
/// 50 digits.
/// Source: Cole (1951), Hopf (1950); Gray & Chugunov (2006) for walls; Carslaw & Jaeger (1959) 14.
template <Real Scalar>
class UniformStart {
 public:
  UniformStart(Scalar bottom, Scalar top, Scalar rate, Scalar diffusivity, Scalar initial);

  [[nodiscard]] ColeHopfPoint<Scalar> at(const Scalar& z, const Scalar& t) const;

 private:
  enum class Wall { bottom, top };
  struct Sums;
  struct Image;
  [[nodiscard]] Sums images(const Scalar& x, const Scalar& y, const Scalar& t) const;
  [[nodiscard]] Sums series(const Scalar& x, const Scalar& y, const Scalar& t) const;
  [[nodiscard]] Scalar departure(const Scalar& t) const;
  void add_free(Sums& sums, const Scalar& x, const Scalar& y, const Scalar& t) const;
  bool add_image(Sums& sums, const Image& image, const Scalar& t) const;
  /// How far below the largest exponent a term is dropped: e^-30 roundoffs.
  [[nodiscard]] static Scalar depth();

  Scalar bottom_, top_, height_, rate_, diffusivity_;
  Scalar d_, phi0_, u0_, spread_;  ///< d, phi0, 2 phi0 - 1 and phi0 (1 - phi0)
};

extern template class UniformStart<double>;

}  // namespace shearfront::diffusion
