// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>

#include "shearfront/exact/rate_form.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Paths with constant H where the rate r = s a is linear or exponential in z, in closed form and without cancellation.
///
/// With h = 4 H a path has q = sqrt(1 - h / r) = |2 p - 1| and moves at the speed r q. Over a run from r1 to r2 where r is
/// linear with the slope b, R_i = 1 + q_i and D = r2 R2^2 + r1 R1^2,
///
///     T = int dz / (r q) = (1 / b) log(r2 R2^2 / (r1 R1^2)) = 2 y artanh(b y) / (b y),   y = 2 d R1 R2 / ((q1 + q2) D),
///     X = H T - int (1 - q) / 2 dz = d h^2 (R2 / (r1 R1) + R1 / (r2 R2)) / (4 R1 R2 (r1 q1 + r2 q2)) >= 0.
///
/// Where r is exponential with r'/r = k, dz = 2 q dq / (k (1 - q^2)) and dt = 2 dq / (k h); with sigma = int dz / r
///
///     T = (2 / (k h)) (q2 - q1) = 2 sigma / (q1 + q2),     w = (q2 - q1) / (R1 + R2),
///     X = (1 / k) [log(R2 / R1) - (q2 - q1) / 2]
///       = h T / (2 (R1 + R2)) [h (1 / (r1 R1) + 1 / (r2 R2)) / 2 + 2 (artanh(w) / w - 1)].
///
/// So b = 0 and k = 0 are no special cases. A path that starts at M0 and gains the height U on its ways up costs U + sum X + H (t -
/// sum T), whose last term is 0 where T(h) = t: errors of h enter quadratically.
namespace shearfront::exact {

/// 1 / (2 n + 1).
inline constexpr double kOneOver[] = {1.0,      1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                      1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23,
                                      1.0 / 25, 1.0 / 27, 1.0 / 29, 1.0 / 31, 1.0 / 33, 1.0 / 35};

/// (artanh(x) / x - 1) / x^2 = 1/3 + x^2/5 + ... by x^2, 0 <= x^2 <= 1/8.
template <Real Scalar>
[[nodiscard]] Scalar artanh_series(const Scalar& x2) {
  if constexpr (std::numeric_limits<Scalar>::digits == 53) {
    double sum = 1.0 / 37;  // the first term left out is 2^-54 / 39
    for (int n = 35; n >= 3; n -= 2) sum = sum * x2 + kOneOver[n / 2];
    return sum;
  } else {
    Scalar sum(0), power(1);
    for (int n = 3; n < 400; n += 2) {
      const Scalar term = power / Scalar(n);
      sum += term;
      if (term <= unit_roundoff<Scalar>() * sum) break;
      power *= x2;
    }
    return sum;
  }
}

/// artanh(x) / x by x^2 <= 1/64.
template <Real Scalar>
[[nodiscard]] Scalar artanh_ratio(const Scalar& x2) {
  if constexpr (std::numeric_limits<Scalar>::digits == 53) {
    // The first term left out is 2^-54 / 19. By parts that do not wait for one another.
    const double x4 = x2 * x2, x8 = x4 * x4;
    const double low = (1.0 + x2 * kOneOver[1]) + x4 * (kOneOver[2] + x2 * kOneOver[3]),
                 high = (kOneOver[4] + x2 * kOneOver[5]) + x4 * (kOneOver[6] + x2 * kOneOver[7]);
    return low + x8 * (high + x8 * kOneOver[8]);
  } else {
    return Scalar(1) + x2 * artanh_series(x2);
  }
}

/// (artanh(x) / x - 1) / x^2 by x^2 < 1.
template <Real Scalar>
[[nodiscard]] Scalar artanh_rest(const Scalar& x2) {
  using std::log1p;
  using std::sqrt;
  if (x2 <= Scalar(1) / Scalar(8)) return artanh_series(x2);
  const Scalar x = sqrt(x2);
  return (log1p(Scalar(Scalar(2) * x / (Scalar(1) - x))) / (Scalar(2) * x) - Scalar(1)) / x2;
}

/// int dz / r of a piece that is exponential: the time of a pure state.
template <Real Scalar>
[[nodiscard]] Scalar exponential_slowness(const Scalar& d, const Scalar& r1, const Scalar& r2) {
  using std::log;
  const Scalar x = (r2 - r1) / (r2 + r1), x2 = x * x;
  const Scalar ratio =
      x2 < Scalar(1) / Scalar(64) ? artanh_ratio(x2) : Scalar(log(Scalar(r2 / r1)) / (Scalar(2) * x));
  return d / Scalar(2) * (Scalar(1) / r1 + Scalar(1) / r2) / ratio;
}

/// A run over d from the rate r1 to r2, and what a search needs of it at every h.
template <Real Scalar>
struct RunEnds {
  RateForm form;
  Scalar d, r1, r2, inverse1, inverse2;
  Scalar slowness;  ///< linear: 1 / slope; exponential: int dz / r

  RunEnds(RateForm of, const Scalar& length, const Scalar& from, const Scalar& to)
      : form(of),
        d(length),
        r1(from),
        r2(to),
        inverse1(Scalar(1) / from),
        inverse2(Scalar(1) / to),
        slowness(of == RateForm::linear ? Scalar(length / (to - from))
                                        : exponential_slowness(length, from, to)) {}
};

/// A run over d from the rate r1 (with q1) to r2 (with q2), in either direction.
template <Real Scalar>
struct Crossing {
  Scalar T, X;

  Crossing(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2,
           const Scalar& q2, const Scalar& h)
      : Crossing(RunEnds<Scalar>(form, d, r1, r2), q1, q2, h) {}
  /// Inlined by force: a search spends half of its time here.
  [[gnu::always_inline]] inline Crossing(const RunEnds<Scalar>& run, const Scalar& q1, const Scalar& q2,
                                         const Scalar& h) {
    using std::log;
    const auto& [form, d, r1, r2, inverse1, inverse2, slowness] = run;
    const Scalar one(1), two(2);
    const Scalar R1 = one + q1, R2 = one + q2, sum = q1 + q2, product = R1 * R2;
    if (!(sum > 0)) {
      T = X = d > 0 ? infinity<Scalar>() : Scalar(0);
      return;
    }
    if (form == RateForm::exponential) {
      exponential(run, q1, q2, h);
      return;
    }
    const Scalar w1 = r1 * R1 * R1, w2 = r2 * R2 * R2, both = w1 + w2;
    // b y = (w2 - w1) / both: where that is small, not by what cancels.
    if (Scalar(8) * (w2 > w1 ? w2 - w1 : w1 - w2) < both) {
      const Scalar part = two * product / (sum * both), x = (r2 - r1) * part;
      T = two * (d * part) * artanh_ratio(Scalar(x * x));
    } else {
      T = slowness * log(Scalar(w2 / w1));
    }
    X = h == 0 ? Scalar(0)
               : d * (h * inverse1) * (h * inverse2) * both /
                     (Scalar(4) * product * product * (r1 * q1 + r2 * q2));
  }

 private:
  void exponential(const RunEnds<Scalar>& run, const Scalar& q1, const Scalar& q2, const Scalar& h) {
    const auto& [form, d, r1, r2, inverse1, inverse2, slowness] = run;
    const Scalar one(1), two(2), R1 = one + q1, R2 = one + q2, both = R1 + R2;
    T = two * slowness / (q1 + q2);
    X = Scalar(0);
    if (h == 0) return;
    const Scalar change = h * ((r2 - r1) / r1 / r2) / (q1 + q2), w = change / both, w2 = w * w;
    const Scalar lost = h * (one / (r1 * R1) + one / (r2 * R2));
    X = h * T / (two * both) * (lost / two + two * w2 * artanh_rest(w2));
  }
};

/// dT/dh of a run.
template <Real Scalar>
[[nodiscard]] Scalar crossing_T_h(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& q1,
                                  const Scalar& r2, const Scalar& q2) {
  const Scalar sum = q1 + q2;
  if (form == RateForm::linear) return d / (r1 * r2 * q1 * q2 * sum);
  return exponential_slowness(d, r1, r2) / (sum * sum) * (Scalar(1) / (r1 * q1) + Scalar(1) / (r2 * q2));
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

/// The way up from the rate r, where 1 - q^2 = h / r, to the turn at the rate h and back down, in a piece that falls with
/// the given |bend|.
template <Real Scalar>
struct Turn {
  Scalar T;
  Scalar X;      ///< H T + int p dz - the height gained
  Scalar steep;  ///< -q h dT/dh: where r is steep, 1 / h^2 is no number

  Turn(RateForm form, const Scalar& bend, const Scalar& r, const Scalar& q, const Scalar& h) {
    const Scalar two(2), four(4), arc = artanh_of(q, r, h);
    if (form == RateForm::linear) {
      T = four / bend * arc;
      X = r * q / bend;
      steep = two / bend;
    } else {
      T = four * (q / h) / bend;
      X = (arc + (arc - q)) / bend;
      steep = two * ((Scalar(1) + q * q) / h) / bend;
    }
  }
};

}  // namespace shearfront::exact
