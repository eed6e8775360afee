// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::diffusion {

/// A solution of Burgers' equation at one place and time.
template <Real Scalar>
struct BurgersPoint {
  Scalar value;       ///< u
  Scalar cumulative;  ///< int_0^x u
  Scalar gradient;    ///< u_x
};

/// u_t + (u^2 / 2)_x = mu u_xx with u(x, 0) = A sin(q x), periodic.
///
/// In X = q x, T = |A| q t, m = mu q / |A| and k = 1 / (2 m), u = -2 m w_X / w (Cole-Hopf) with
///
///     w = I_0(k) + 2 sum_n I_n(k) exp(-m n^2 T) cos n X                                     (series)
///       = const int exp(k cos Y - (X - Y)^2 / (4 m T)) dY over the line                     (integral)
///
/// The series is summed for m T >= 1. Before, its terms cancel down to exp(-2 k) at the shock; there u is the
/// mean of sin Y under the integrand, and u_X = mean(cos Y) - variance(sin Y) / (2 m): positive weights,
/// taken by the trapezoidal rule, whose error for this entire integrand is bounded by shifting the path into
/// the complex plane and is kept below the rounding. The ratios I_n / I_0 come from Miller's backward
/// recurrence.
///
/// Units: x in length, u and A in length/time, mu in length^2/time. Domain: A != 0, q > 0, mu > 0, t >= 0.
/// Guarantees in double for m >= 1e-3 (tested for q = |A| = 1): u relatively to 1e-12, beside its nodes too
/// (measured 1e-15, 2e-15, 1e-14, 6e-14 for m = 1, 0.1, 0.01, 0.001); u_x to 1e-12 (1 + |u_x|); the integral
/// to 1e-13. For smaller m the errors grow like 1 / m, the steepness of the shock. Errors: none.
/// Cost in double: 0.2 us by the series, 1 to 6 us by the integral.
/// Source: Cole (1951), Hopf (1950); Benton & Platzman (1972); Trefethen & Weideman (2014) for the rule.
template <Real Scalar>
class PeriodicBurgers {
 public:
  PeriodicBurgers(Scalar viscosity, Scalar amplitude, Scalar wave_number);

  [[nodiscard]] BurgersPoint<Scalar> at(const Scalar& x, const Scalar& t) const;

 private:
  struct Place;
  struct Means;
  [[nodiscard]] Place place(const Scalar& x) const;
  [[nodiscard]] Means series(const Place& place, const Scalar& t) const;
  [[nodiscard]] Means integral(const Place& place, const Scalar& t) const;
  [[nodiscard]] Scalar step(const Scalar& variance) const;

  Scalar wave_number_, speed_;  ///< q and |A|
  bool is_negative_;            ///< A < 0
  Scalar m_, k_;                ///< scaled viscosity, 1 / (2 m)
  std::vector<Scalar> ratios_;  ///< I_n(k) / I_0(k)
};

extern template class PeriodicBurgers<double>;

}  // namespace shearfront::diffusion
