// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/exponential_path.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Derivatives of a path that stays inside one piece, a turn included, with respect to the level and to the slope of the rate,
/// the heights held fixed.
///
/// They do not go by runs and a turn: at their common end, where r = 4 H or nearly so, these have poles that cancel
/// only in sum, and in a piece that is nearly constant all of them are divided by its slope.
namespace shearfront::exact {

/// Of the momentum at the end of a fan in an exponential piece, in the orientation in which r falls: by log r at its
/// start, by kappa = 1 / decay = -r'/r, and by the height of the start.
template <Real Scalar>
struct ExponentialFanDerivatives {
  Scalar by_log_rate{0}, by_kappa{0}, by_start{0};
};

/// The same in a linear piece: by r at its end, by the slope b, by the height of the start, and by log s.
template <Real Scalar>
struct LinearFanDerivatives {
  Scalar by_rate{0}, by_slope{0}, by_start{0}, by_log_scale{0};
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
[[nodiscard]] ExponentialFanDerivatives<Scalar> exponential_fan_derivatives(
    const FanMomenta<Scalar>& fan, const Scalar& kappa, const Scalar& way, const Scalar& d, const Scalar& e) {
  const Scalar two(2), four(4), B = way * kappa, sum = Scalar(1) + fan.S, share = fan.E / fan.S;
  const Scalar e_over_B = e / B, part = (e_over_B + B / four) / sum, relative = d / way;
  const Scalar rest =
      (e_over_B * way + way * (B / four)) / (two * sum) - d * arc_detail::exp_excess(Scalar(kappa * d));
  ExponentialFanDerivatives<Scalar> out;
  out.by_log_rate = -share * part;
  out.by_kappa = share * (relative / sum * rest - way / (four * sum) + d * part);
  out.by_start = -share / (two * way);
  return out;
}

/// Mean over the time t of the height above the start: way [p0 g(B p0) - (1 - p0) g(-B (1 - p0))], g = entropy_excess.
template <Real Scalar>
[[nodiscard]] Scalar mean_height_in_exponential(const Scalar& way, const Scalar& kappa, const Scalar& p0,
                                                const Scalar& missing0) {
  const Scalar B = way * kappa, lost = std::min(Scalar(1), Scalar(B * missing0));
  return way * (p0 * arc_detail::entropy_excess(Scalar(B * p0)) -
                missing0 * arc_detail::entropy_excess(Scalar(-lost)));
}

/// tanh(y) / y and what it lacks to 1, over y^2, of y = b t / 2: as what goes with b^2 they must not be lost where b is small.
template <Real Scalar>
struct TanhRatio {
  Scalar ratio, rest;

  explicit TanhRatio(const Scalar& y) {
    using std::tanh;
    const Scalar one(1), y2 = y * y;
    if (y2 > one) {
      ratio = tanh(y) / y;
      rest = (one - ratio) / y2;
      return;
    }
    // tanh y = y / (1 + y^2 / (3 + y^2 / (5 + ...)))
    constexpr int kDepth = std::numeric_limits<Scalar>::digits / 8 + 4;
    Scalar from_3(2 * kDepth + 1);
    for (int n = 2 * kDepth - 1; n >= 3; n -= 2) from_3 = Scalar(n) + y2 / from_3;
    ratio = one / (one + y2 / from_3);
    rest = ratio / from_3;
  }
};

namespace arc_detail {

/// dlog B/db: dlog B/dlog b = 2 y / sinh(2 y) - 1.
template <Real Scalar>
[[nodiscard]] Scalar log_drift_by_slope(const LinearDrift<Scalar>& drift, const TanhRatio<Scalar>& tanh,
                                        const Scalar& slope, const Scalar& t) {
  const Scalar one(1), two(2), y = slope * t / two;
  return y * y > one ? Scalar((Scalar(4) * drift.u * drift.v / tanh.ratio - one) / slope)
                     : Scalar(y * t / two * (tanh.rest / tanh.ratio - tanh.ratio));
}

}  // namespace arc_detail

/// How far a state of a linear piece has risen where the rate is r, r B (p0^2 u - (1 - p0)^2 v) / D^2, and its derivatives by the state,
/// the slope and r.
template <Real Scalar>
struct LinearRise {
  Scalar size, by_state, by_slope, by_rate;

  LinearRise(const LinearDrift<Scalar>& drift, const Scalar& slope, const Scalar& t, const Scalar& p0,
             const Scalar& missing0, const Scalar& r) {
    const Scalar two(2), D = p0 * drift.u + missing0 * drift.v, uv = drift.u * drift.v;
    const Scalar up = p0 / D * (p0 * drift.u / D), down = missing0 / D * (missing0 * drift.v / D),
                 part = up - down;
    const TanhRatio<Scalar> tanh(Scalar(slope * t / two));
    const Scalar log_B = arc_detail::log_drift_by_slope(drift, tanh, slope, t);
    const Scalar by_drift =
        t * uv * ((p0 / D) * (p0 / D) + (missing0 / D) * (missing0 / D) - two * part * ((p0 - missing0) / D));
    by_rate = drift.B * part;
    size = r * by_rate;
    by_state = two * r * drift.B * (uv / D) / (D * D);
    by_slope = r * drift.B * (log_B * part + by_drift);
  }
};

/// The same in an exponential piece in which r falls: log E / kappa, by the state, log r and kappa, b = r t kappa. With q = b (p0 -
/// (1 - p0)) - 2 b^2 E p0 (1 - p0): dlog E/dlog b = q / (1 - q), dlog E/dp0 = b (2 - b E ((1 - p0) - p0)) / (1 - q).
template <Real Scalar>
struct ExponentialRise {
  Scalar by_state, by_log_rate, by_kappa;

  ExponentialRise(const FootRoot<Scalar>& root, const Scalar& b, const Scalar& kappa, const Scalar& p0,
                  const Scalar& missing0) {
    const Scalar one(1), two(2), lean = p0 - missing0, q = b * (lean - two * (b * root.E) * p0 * missing0);
    by_state = b * (two + b * root.E * lean) / (one - q) / kappa;
    by_log_rate = q / (one - q) / kappa;
    by_kappa = (by_log_rate - root.log_E() / kappa) / kappa;
  }
};

/// r B (p^2 / u - (1 - p)^2 / v) = d by exact/arc.hpp, differentiated; B = (t / 2) tanh(y) / y, y = b t / 2.
template <Real Scalar>
[[nodiscard]] LinearFanDerivatives<Scalar> linear_fan_derivatives(const Arc<Scalar>& arc,
                                                                  const LinearDrift<Scalar>& drift,
                                                                  const Scalar& slope, const Scalar& t,
                                                                  const Scalar& d, const Scalar& r) {
  const Scalar one(1), two(2);
  const Scalar x = slope * t, y = x / two, up = arc.p / drift.u, down = arc.missing / drift.v;
  const TanhRatio<Scalar> tanh(y);
  const Scalar k = d / (r * drift.B), by_p = two * (up + down);
  const Scalar log_B_by_slope = arc_detail::log_drift_by_slope(drift, tanh, slope, t);
  const Scalar drifted = drift.u * drift.v * (up * up + down * down);  // (p^2 v / u + (1 - p)^2 u / v)
  LinearFanDerivatives<Scalar> out;
  out.by_rate = -k / r / by_p;
  out.by_slope = (t * drifted - k * log_B_by_slope) / by_p;
  out.by_start = -one / (r * drift.B * by_p);
  out.by_log_scale = (x * drifted - k * (one + slope * log_B_by_slope)) / by_p;
  return out;
}

/// H int dt / r and H int (z - start) / r dt along a path in a linear piece.
template <Real Scalar>
struct LinearArcIntegrals {
  Scalar level, height;

  LinearArcIntegrals(const Scalar& H, const LinearDrift<Scalar>& drift, const Scalar& slope, const Scalar& t,
                     const Scalar& p0, const Scalar& missing0) {
    const Scalar two(2), x = slope * t;
    const TanhRatio<Scalar> tanh(Scalar(x / two));
    const Scalar D = p0 * drift.u + missing0 * drift.v;
    level = p0 / D * (missing0 * drift.B);
    height = H / D * (t / two) * (x * t * tanh.rest / Scalar(4) + (p0 - missing0) * drift.B);
  }
};

}  // namespace shearfront::exact
