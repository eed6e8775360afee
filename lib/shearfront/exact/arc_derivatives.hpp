// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/exponential_path.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Derivatives of a path that stays inside one exponential piece, a turn included, with respect to the level of log r
/// and to kappa = 1 / decay = -r'/r, in the orientation in which r falls.
///
/// They do not go by runs and a turn: at their common end, where r = 4 H or nearly so, these have poles that cancel
/// only in sum, and in a piece that is nearly constant by 1 / (kappa width).
namespace shearfront::exact {

/// Of the momentum at the end: with log r at the start of a fan (the end of a state) and kappa, the heights held fixed.
template <Real Scalar>
struct ArcMomentumDerivatives {
  Scalar by_log_rate{0}, by_kappa{0};
  Scalar by_start{0};  ///< fans: with the height of the start
};

namespace arc_detail {

/// (e^x - 1 - x) / x^2.
template <Real Scalar>
[[nodiscard]] Scalar exp_excess(const Scalar& x) {
  using std::expm1;
  const Scalar size = x < 0 ? Scalar(-x) : x;
  if (size > Scalar(0.5)) return (expm1(x) - x) / (x * x);
  Scalar term = Scalar(1) / Scalar(2), sum = term;
  for (int n = 3; n < 400; ++n) {
    term *= x / Scalar(n);
    sum += term;
    const Scalar term_size = term < 0 ? Scalar(-term) : term;
    if (term_size <= unit_roundoff<Scalar>() * sum * Scalar(0.25)) break;
  }
  return sum;
}

/// ((1 + x) log(1 + x) - x) / x^2 for x >= -1.
template <Real Scalar>
[[nodiscard]] Scalar entropy_excess(const Scalar& x) {
  using std::log1p;
  const Scalar one(1), size = x < 0 ? Scalar(-x) : x;
  if (size <= Scalar(0.25)) return one - (one + x) * log_excess(x);
  return x > Scalar(-1) ? Scalar(((one + x) * log1p(x) - x) / (x * x)) : one;
}

}  // namespace arc_detail

/// p = 1/2 + (E - S) / B with B = way kappa, way = r0 t, and E = exp(kappa d), from a start with the rate r0 that lies d below the end.
/// dp/dlog B = -E (e / B + B / 4) / (S (1 + S)), e = E - 1, and together with dp/dlog E it is E / (2 B S). Divided by kappa, what
/// is large in both cancels by S - 1 = (e + B^2 / 4) / (S + 1) and e = kappa d + (kappa d)^2 exp_excess(kappa d).
template <Real Scalar>
[[nodiscard]] ArcMomentumDerivatives<Scalar> fan_momentum_derivatives(const FanMomenta<Scalar>& fan,
                                                                      const Scalar& kappa, const Scalar& way,
                                                                      const Scalar& d, const Scalar& e) {
  const Scalar two(2), four(4), B = way * kappa, sum = Scalar(1) + fan.S, share = fan.E / fan.S;
  const Scalar e_over_B = e / B, part = (e_over_B + B / four) / sum, relative = d / way;
  const Scalar rest =
      (e_over_B * way + way * (B / four)) / (two * sum) - d * arc_detail::exp_excess(Scalar(kappa * d));
  ArcMomentumDerivatives<Scalar> out;
  out.by_log_rate = -share * part;
  out.by_kappa = share * (relative / sum * rest - way / (four * sum) + d * part);
  out.by_start = -share / (two * way);
  return out;
}

/// Mean over the time t of the height above the start: way [p0 g(B p0) - (1 - p0) g(-B (1 - p0))], g = entropy_excess.
template <Real Scalar>
[[nodiscard]] Scalar mean_height_of_arc(const Scalar& way, const Scalar& kappa, const Scalar& p0,
                                        const Scalar& missing0) {
  const Scalar B = way * kappa, lost = std::min(Scalar(1), Scalar(B * missing0));
  return way * (p0 * arc_detail::entropy_excess(Scalar(B * p0)) -
                missing0 * arc_detail::entropy_excess(Scalar(-lost)));
}

}  // namespace shearfront::exact
