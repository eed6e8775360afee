// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_route.hpp"
#include "shearfront/model/depth/model.hpp"

namespace shearfront::exact {

/// Of a run from r1 to r2: its time and that by h and by the rates at its ends, and of int p dz at fixed H, over h / 4, by them.
template <Real Scalar>
struct RunParts {
  Scalar T, T_h, T1, T2, J1, J2;
};

/// Of a turn entered at the rate A: its time and that by h, A and the rates at the ends of its piece, at fixed A, and dM by these.
template <Real Scalar>
struct TurnParts {
  Scalar T, T_h, T_A, T_near, T_far, M_near, M_far;
};

/// A run over d of a parabola: J_i = int (dr / dr_i) / (r^2 q) dz.
template <Real Scalar>
struct CrossingDerivatives : RunParts<Scalar> {
  CrossingDerivatives(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2,
                      const Scalar& q2, const Scalar& h) {
    form == RateForm::linear ? linear(d, r1, q1, r2, q2, h) : exponential(d, r1, q1, r2, q2, h);
  }

 private:
  using RunParts<Scalar>::T, RunParts<Scalar>::T_h, RunParts<Scalar>::T1, RunParts<Scalar>::T2,
      RunParts<Scalar>::J1, RunParts<Scalar>::J2;

  /// With y and x = b y of exact/sloped_crossing.hpp; -2 T_i = J_i + L_i, L_i = int hat_i / (r^2 q^3) dz.
  void linear(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2, const Scalar& q2,
              const Scalar& h) {
    using std::log;
    const Scalar one(1), two(2), sum = q1 + q2, per_sum = one / sum, per_q1 = one / q1, per_q2 = one / q2;
    const Scalar inverse1 = one / r1, inverse2 = one / r2;
    const Scalar R1 = one + q1, R2 = one + q2, w1 = r1 * R1 * R1, w2 = r2 * R2 * R2;
    const Scalar slowness = two * R1 * R2 / (sum * (w1 + w2)), y = d * slowness, x = (r2 - r1) * slowness,
                 x2 = x * x;
    // artanh(x) / x, and what it is more than 1 over x^2.
    Scalar ratio, rest;
    if (x2 <= one / Scalar(8)) {
      rest = artanh_series(x2);
      ratio = one + x2 * rest;
    } else {
      ratio = log(Scalar(w2 / w1)) / (two * x);
      rest = (ratio - one) / x2;
    }
    const Scalar c = two * x * y * slowness * rest, part = two * y * per_sum,
                 steep = (h * inverse1) * (d * inverse2) * per_sum * per_sum;
    T = two * y * ratio;
    T_h = (d * inverse1) * inverse2 * per_q1 * per_q2 * per_sum;
    J1 = part * q2 * inverse1 - c;
    J2 = part * q1 * inverse2 + c;
    T1 = -J1 - steep * inverse1 * per_q1;
    T2 = -J2 - steep * inverse2 * per_q2;
  }
  /// r_i dr/dr_i = r times the part of the way that lies on the side of i: the mean of that part over the time for J, over
  /// int dz / r for T.
  void exponential(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2, const Scalar& q2,
                   const Scalar& h) {
    using std::log;
    const Scalar one(1), two(2), sum = q1 + q2;
    T = two * exponential_slowness(d, r1, r2) / sum;
    T_h = crossing_T_h(RateForm::exponential, d, r1, q1, r2, q2);
    const Scalar size = r2 > r1 ? Scalar(log(Scalar(r2 / r1))) : Scalar(log(Scalar(r1 / r2)));
    const Scalar in_r = r2 > r1 ? Scalar(one - exponential_mean_place(size)) : exponential_mean_place(size);
    const Scalar in_time = mean_place_in_time(r1, q1, r2, q2, h);
    J1 = T / r1 * (one - in_time);
    J2 = T / r2 * in_time;
    T1 = -T / r1 * ((one - in_r) + h / r1 / (two * q1 * sum));
    T2 = -T / r2 * (in_r + h / r2 / (two * q2 * sum));
  }
  /// q grows evenly in time: the mean of log(r / r1) / log(r2 / r1) over q.
  [[nodiscard]] static Scalar mean_place_in_time(const Scalar& r1, const Scalar& q1, const Scalar& r2,
                                                 const Scalar& q2, const Scalar& h) {
    using std::log1p;
    const Scalar rise = (r2 - r1) / r1, one(1);
    if (rise == 0) return Scalar(0.5);
    const Scalar less = -(rise / (one + rise)) * ((one + q1) / (q1 + q2)),  // (1 - q2) / (1 - q1) - 1
        more = h / r2 * rise / ((q1 + q2) * (one + q1));                    // (1 + q2) / (1 + q1) - 1
    return -(mean_log(less) + mean_log(more)) / log1p(rise);
  }
  /// int_0^1 log(1 + x u) du = ((1 + x) log(1 + x) - x) / x, by its series sum -(-x)^n / (n (n + 1)) for small x.
  [[nodiscard]] static Scalar mean_log(const Scalar& x) {
    using std::log1p;
    const Scalar size = x < 0 ? Scalar(-x) : x;
    if (!(x > Scalar(-1))) return Scalar(-1);
    if (size > Scalar(0.125)) return ((Scalar(1) + x) * log1p(x) - x) / x;
    Scalar power = x, sum(0);
    for (int n = 1; n < 400; ++n) {
      const Scalar term = power / Scalar(n * (n + 1));
      sum += term;
      const Scalar term_size = term < 0 ? Scalar(-term) : term, sum_size = sum < 0 ? Scalar(-sum) : sum;
      if (term_size <= unit_roundoff<Scalar>() * sum_size * Scalar(0.25)) break;
      power *= -x;
    }
    return sum;
  }
};

/// What derivatives along a path need to know of the fluxes: parabolas.
template <Real Scalar>
class ParabolaCalculus {
 public:
  ParabolaCalculus(const SlopedPieces<Scalar>& pieces, const Path<Scalar>& path)
      : pieces_(pieces), path_(path), h_(Scalar(4) * path.H) {}

  /// Distance from the pure state of its side.
  [[nodiscard]] Scalar less(std::size_t, const Scalar& r, bool) const {
    return h_ / r / (Scalar(1) + q(r)) / Scalar(2);
  }
  /// What p loses (going up) or gains over an interface to the layer above it.
  [[nodiscard]] Scalar change(std::size_t below, std::size_t above, bool) const {
    return (q(pieces_.high[below]) - q(pieces_.low[above])) / Scalar(2);
  }
  [[nodiscard]] bool is_jump(std::size_t below, std::size_t above) const {
    return pieces_.high[below] != pieces_.low[above];
  }
  [[nodiscard]] bool is_at_peak(std::size_t, const Scalar& r, bool) const { return !(q(r) > 0); }
  [[nodiscard]] Scalar slowness(std::size_t, const Scalar& r, bool) const {
    return Scalar(1) / (r * std::max(tiny(), q(r)));
  }
  [[nodiscard]] static Scalar height(std::size_t, const Scalar& p0) {
    return Scalar(4) * p0 * (Scalar(1) - p0);
  }
  /// dG/dp, no less than what its speed is taken for at the peak.
  [[nodiscard]] static Scalar height_slope(std::size_t, const Scalar& p0, bool is_up) {
    const Scalar lean = Scalar(1) - Scalar(2) * p0, size = lean < 0 ? Scalar(-lean) : lean;
    return Scalar(4) * (size < tiny() ? (is_up ? Scalar(-tiny()) : tiny()) : lean);
  }
  [[nodiscard]] static Scalar pure_ratio(std::size_t, std::size_t, bool) { return Scalar(1); }
  [[nodiscard]] static Scalar at_source(std::size_t) { return Scalar(-0.5); }

  [[nodiscard]] RunParts<Scalar> run(std::size_t k, bool, const Scalar& d, const Scalar& r1,
                                     const Scalar& r2) const {
    const RateForm form = pieces_.form[k];
    const Scalar q1 = q(r1), q2 = q(r2), some_q1 = std::max(tiny(), q1), some_q2 = std::max(tiny(), q2);
    RunParts<Scalar> parts = CrossingDerivatives<Scalar>(form, d, r1, some_q1, r2, some_q2, h_);
    // At the start of a state of 1/2 what is divided by q is multiplied by it in the end.
    if (some_q1 != q1 || some_q2 != q2) {
      const RunParts<Scalar> at = CrossingDerivatives<Scalar>(form, d, r1, q1, r2, q2, h_);
      parts.T = at.T;
      parts.J1 = at.J1;
      parts.J2 = at.J2;
    }
    return parts;
  }
  [[nodiscard]] TurnParts<Scalar> turn(std::size_t j, bool is_set_up, const Scalar& A,
                                       const Scalar& from) const {
    const Scalar qA = q(A), bend = pieces_.bend[j] < 0 ? Scalar(-pieces_.bend[j]) : pieces_.bend[j];
    const Scalar& near = is_set_up ? pieces_.low[j] : pieces_.high[j];  // on the side it comes from
    const Scalar& far = is_set_up ? pieces_.high[j] : pieces_.low[j];
    const Turn<Scalar> turn(pieces_.form[j], bend, A, qA, h_);
    TurnParts<Scalar> by{};
    by.T = turn.T;
    by.T_h = -turn.steep / h_ / qA;
    const Scalar two(2), four(4);
    const Scalar cube = qA * qA * qA * artanh_rest(Scalar(qA * qA));  // artanh q - q
    if (pieces_.form[j] == RateForm::linear) {
      const Scalar fall = near - far;  // |b| = fall / width
      // int (near - r) / (r^2 q) and int (r - far) / (r^2 q) over both ways.
      const Scalar to_far = qA * ((near - A) + A * qA * qA) / h_ - cube;
      const Scalar to_near = cube + qA * ((A - far) - A * qA * qA) / h_;
      const Scalar scale = h_ / (bend * fall);
      by.M_far = scale * to_far;
      by.M_near = scale * to_near;
      by.T_A = two / (bend * A * qA);
      by.T_far = turn.T / fall;
      by.T_near = -turn.T / fall;
    } else {
      // The part of the piece passed, in time: that at `from`, and log(A / r) / log(near / far) beyond.
      const Scalar fall = bend * pieces_.width(j), w_high = (from - pieces_.boundaries[j]) / pieces_.width(j);
      const Scalar beyond = Scalar(8) / (bend * h_) * cube / fall;
      const Scalar passed = (is_set_up ? w_high : Scalar(Scalar(1) - w_high)) * turn.T + beyond;
      by.M_far = h_ / four / far * passed;
      by.M_near = h_ / four / near * (turn.T - passed);
      by.T_A = two / (bend * A * A * qA);
      by.T_far = turn.T / (fall * far);
      by.T_near = -turn.T / (fall * near);
    }
    return by;
  }

 private:
  /// Terms that cancel in sum are divided by q: half of the digits are kept.
  [[nodiscard]] static Scalar tiny() {
    using std::sqrt;
    return sqrt(unit_roundoff<Scalar>());
  }
  [[nodiscard]] Scalar q(const Scalar& rate) const { return q_at(rate, path_.r_reference, path_.lost()); }

  const SlopedPieces<Scalar>& pieces_;
  const Path<Scalar>& path_;
  Scalar h_;
};

}  // namespace shearfront::exact
