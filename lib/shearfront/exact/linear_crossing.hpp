// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/numeric/scalar.hpp"

/// Paths with constant H where the rate r = s a is linear in z, in closed form and without cancellation.
///
/// With h = 4 H a path has q = sqrt(1 - h / r) = |2 p - 1| and moves at the speed r q. Over a run from r1 to r2 with
/// the slope b, R_i = 1 + q_i and D = r2 R2^2 + r1 R1^2,
///
///     T = int dz / (r q) = (1 / b) log(r2 R2^2 / (r1 R1^2)) = 2 y artanh(b y) / (b y),   y = 2 d R1 R2 / ((q1 + q2) D),
///     X = H T - int (1 - q) / 2 dz = d h^2 (R2 / (r1 R1) + R1 / (r2 R2)) / (4 R1 R2 (r1 q1 + r2 q2)) >= 0.
///
/// So b = 0 is no special case. A path that starts at M0 and gains the height U on its ways up costs U + sum X + H (t -
/// sum T), whose last term is 0 where T(h) = t: errors of h enter quadratically.
namespace shearfront::exact {

/// artanh(x) / x - 1 over x^2, |x| < 1.
template <Real Scalar>
[[nodiscard]] Scalar artanh_rest(const Scalar& x) {
  using std::log1p;
  const Scalar x2 = x * x;
  if (x2 > Scalar(1) / Scalar(16)) {
    const Scalar size = x < 0 ? Scalar(-x) : x;
    return (log1p(Scalar(Scalar(2) * size / (Scalar(1) - size))) / (Scalar(2) * size) - Scalar(1)) / x2;
  }
  Scalar sum(0), power(1);
  for (int n = 3; n < 400; n += 2) {
    const Scalar term = power / Scalar(n);
    sum += term;
    if (term <= unit_roundoff<Scalar>() * sum) break;
    power *= x2;
  }
  return sum;
}

/// artanh(x) / x for small |x|.
template <Real Scalar>
[[nodiscard]] Scalar artanh_ratio(const Scalar& x2) {
  if constexpr (std::numeric_limits<Scalar>::digits == 53) {
    // Up to x^2 = 1/64: the first term left out is 2^-54 / 19.
    double sum = 1.0 / 17;
    for (const double c : {1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3, 1.0})
      sum = sum * x2 + c;
    return sum;
  } else {
    Scalar sum(0), power(1);
    for (int n = 1; n < 400; n += 2) {
      const Scalar term = power / Scalar(n);
      sum += term;
      if (term <= unit_roundoff<Scalar>() * sum) break;
      power *= x2;
    }
    return sum;
  }
}

/// A run over d from the rate r1 (with q1) to r2 (with q2), in either direction.
template <Real Scalar>
struct Crossing {
  Scalar T, X;

  Crossing(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2, const Scalar& q2,
           const Scalar& h) {
    using std::log;
    const Scalar one(1), two(2);
    const Scalar R1 = one + q1, R2 = one + q2, sum = q1 + q2, product = R1 * R2;
    if (!(sum > 0)) {
      T = X = d > 0 ? infinity<Scalar>() : Scalar(0);
      return;
    }
    const Scalar w1 = r1 * R1 * R1, w2 = r2 * R2 * R2;
    const Scalar y = two * d * product / (sum * (w1 + w2));
    const Scalar x = (r2 - r1) * (two * product) / (sum * (w1 + w2));
    const Scalar x2 = x * x;
    T = two * y * (x2 < Scalar(1) / Scalar(64) ? artanh_ratio(x2) : Scalar(log(Scalar(w2 / w1)) / (two * x)));
    X = h == 0 ? Scalar(0)
               : d * h * h * (R2 * r2 * R2 + R1 * r1 * R1) /
                     (Scalar(4) * product * product * r1 * r2 * (r1 * q1 + r2 * q2));
  }
};

/// dT/dh of a run.
template <Real Scalar>
[[nodiscard]] Scalar crossing_T_h(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2,
                                  const Scalar& q2) {
  return d / (r1 * r2 * q1 * q2 * (q1 + q2));
}

/// artanh q at the rate r, where 1 - q^2 = h / r.
template <Real Scalar>
[[nodiscard]] Scalar artanh_of(const Scalar& q, const Scalar& r, const Scalar& h) {
  using std::log;
  using std::log1p;
  const Scalar one(1);
  if (q < Scalar(0.5)) return log1p(Scalar(Scalar(2) * q / (one - q))) / Scalar(2);
  return log(Scalar((one + q) * (one + q) * (r / h))) / Scalar(2);
}

/// What the linear law does to momenta in the time t: logit p rises by x = b t in a constant state.
template <Real Scalar>
struct LinearDrift {
  Scalar u, v;  ///< 1 / (1 + e^-x), 1 / (1 + e^x)
  Scalar B;     ///< (t / 2) tanh(x / 2) / (x / 2)

  LinearDrift(const Scalar& b, const Scalar& t) {
    using std::exp;
    using std::tanh;
    const Scalar one(1), x = b * t;
    const Scalar e = exp(Scalar(x < 0 ? x : Scalar(-x))), small = e / (one + e), large = one / (one + e);
    u = x < 0 ? small : large;
    v = x < 0 ? large : small;
    const Scalar half = x / Scalar(2);
    B = half == 0 ? Scalar(t / Scalar(2)) : Scalar(tanh(half) / b);
  }
};

/// A path inside one linear piece that ends at the rate r: p and 1 - p there, and what it gains on its ways up and down;
/// it starts up - down below its end.
template <Real Scalar>
struct LinearArc {
  Scalar p, missing, up, down, start_odds;  ///< start_odds = p0 / (1 - p0) at its start

  [[nodiscard]] static LinearArc from_state(const LinearDrift<Scalar>& drift, const Scalar& p0,
                                            const Scalar& missing0, const Scalar& r) {
    const Scalar D = p0 * drift.u + missing0 * drift.v;
    LinearArc arc;
    arc.p = p0 * drift.u / D;
    arc.missing = missing0 * drift.v / D;
    arc.up = r * drift.B * (p0 / D) * arc.p;
    arc.down = r * drift.B * (missing0 / D) * arc.missing;
    arc.start_odds = p0 / missing0;
    return arc;
  }
  /// From a height with the rate r0, d below.
  [[nodiscard]] static LinearArc from_point(const LinearDrift<Scalar>& drift, const Scalar& d,
                                            const Scalar& r0, const Scalar& r) {
    using std::sqrt;
    const Scalar k = d / (r * drift.B);
    const Scalar g = sqrt(Scalar(drift.u * drift.v * (r0 / r)));
    LinearArc arc;
    arc.p = (drift.u + k * drift.u * drift.v) / (drift.u + g);
    arc.missing = (drift.v - k * drift.u * drift.v) / (drift.v + g);
    arc.up = r * drift.B * arc.p * arc.p / drift.u;
    arc.down = r * drift.B * arc.missing * arc.missing / drift.v;
    arc.start_odds = arc.p * drift.v / (arc.missing * drift.u);
    return arc;
  }
};

}  // namespace shearfront::exact
