// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/arc_derivatives.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_route.hpp"
#include "shearfront/model/depth/model.hpp"

namespace shearfront::exact {

/// Derivatives with respect to the rates at both ends of a run: of its time at fixed h, and of int p dz at fixed H, over h / 4:
/// J_i = int (dr / dr_i) / (r^2 q) dz.
template <Real Scalar>
struct CrossingDerivatives {
  Scalar J1, J2, T1, T2;

  CrossingDerivatives(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2,
                      const Scalar& q2, const Scalar& h) {
    form == RateForm::linear ? linear(d, r1, q1, r2, q2, h) : exponential(d, r1, q1, r2, q2, h);
  }

 private:
  /// -2 T_i = J_i + L_i, L_i = int hat_i / (r^2 q^3) dz.
  void linear(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2, const Scalar& q2,
              const Scalar& h) {
    const Scalar one(1), two(2), four(4), sum = q1 + q2;
    const Scalar product = (one + q1) * (one + q2), w1 = r1 * (one + q1) * (one + q1);
    const Scalar D = w1 + r2 * (one + q2) * (one + q2), y = two * d * product / (sum * D);
    const Scalar b = (r2 - r1) / d, x = (r2 - r1) * (two * product) / (sum * D);
    const Scalar c = two / d * b * y * y * y * artanh_rest(Scalar(x * x)),
                 part = four * d * product / (sum * sum * D);
    J1 = part * q2 / r1 - c;
    J2 = part * q1 / r2 + c;
    T1 = -J1 - h * d / (r1 * r1 * r2 * sum * sum) / q1;
    T2 = -J2 - h * d / (r1 * r2 * r2 * sum * sum) / q2;
  }
  /// r_i dr/dr_i = r times the part of the way that lies on the side of i: the mean of that part over the time for J, over
  /// int dz / r for T.
  void exponential(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2, const Scalar& q2,
                   const Scalar& h) {
    using std::log;
    const Scalar one(1), two(2), sum = q1 + q2, T = two * exponential_slowness(d, r1, r2) / sum;
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

/// Derivatives along a path through sloped pieces, the rates at both ends of each piece as its numbers; a boundary moves with
/// them. Cost: O(pieces touched).
///
/// Moving a boundary between the slopes b_- and b_+ changes r next to it as changing the rates there by -b_- and -b_+
/// does, and moves the jump with it.
template <Real Scalar>
class SlopedGradient {
 public:
  SlopedGradient(const SlopedPieces<Scalar>& pieces, const Cells<Scalar>& cells, const Path<Scalar>& path,
                 const Scalar& z, const Scalar& t)
      : pieces_(pieces),
        cells_(cells),
        path_(path),
        z_(z),
        t_(t),
        h_(Scalar(4) * path.H),
        end_(pieces.piece_at(z)) {}

  [[nodiscard]] PathGradient<Scalar> run() {
    if (path_.kind == PathKind::bottom_wall || path_.kind == PathKind::top_wall ||
        path_.kind == PathKind::none)
      return {};
    is_set_up_ = path_.upward != path_.turned;
    make_room();
    if (path_.kind == PathKind::waiting) {
      waiting();
      return std::move(out_);
    }
    const bool is_state = path_.kind == PathKind::constant;
    start_ =
        is_state ? cells_.layer[path_.source] : cells_.layer[is_set_up_ ? path_.source : path_.source - 1];
    if (start_ == end_ && (!path_.turned || cells_.layer[path_.interface] == start_)) {
      pieces_.form[end_] == RateForm::linear ? in_linear_piece() : in_exponential_piece();
      move_boundaries();
      return std::move(out_);
    }
    if (!is_state) out_.start = momentum(start_, path_.foot, is_set_up_);
    if (h_ == 0 && is_state) return pure();
    if (!is_state && path_.foot == z_ && !path_.turned) return at_its_source();
    passes();
    if (is_state)
      phi_of_state();
    else
      phi_of_fan();
    move_boundaries();
    return std::move(out_);
  }

 private:
  using Pair = typename PathGradient<Scalar>::Pair;

  [[nodiscard]] Scalar q(const Scalar& rate) const {
    return q_at(rate, path_.r_reference, Scalar(path_.x * path_.x));
  }
  [[nodiscard]] Scalar at(std::size_t k, const Scalar& z) const { return pieces_.rate(k, z); }
  /// Where a state of 1/2 starts, dT is divided by q and multiplied by it in the end: half of the digits are kept.
  [[nodiscard]] static Scalar least_q() {
    using std::sqrt;
    return sqrt(unit_roundoff<Scalar>());
  }
  /// Derivatives of the rate at z by the rates at both ends of its piece, which has the rate `rate` there.
  struct EndParts {
    Scalar low, high;
  };
  [[nodiscard]] EndParts parts(std::size_t k, const Scalar& z) const {
    const Scalar high = (z - pieces_.boundaries[k]) / pieces_.width(k), low = Scalar(1) - high;
    if (pieces_.form[k] == RateForm::linear) return {low, high};
    const Scalar rate = at(k, z);
    return {low * (rate / pieces_.low[k]), high * (rate / pieces_.high[k])};
  }
  [[nodiscard]] Pair& number(std::size_t k, bool is_high) {
    return out_.pieces[2 * (k - out_.first) + (is_high ? 1 : 0)];
  }
  /// Adds to the numbers of piece k what the rate at z does.
  void add_at(std::size_t k, const Scalar& z, const Scalar& M, const Scalar& phi) {
    const auto [low, high] = parts(k, z);
    number(k, false).M += low * M;
    number(k, false).phi += low * phi;
    number(k, true).M += high * M;
    number(k, true).phi += high * phi;
  }
  [[nodiscard]] StartMomentum<Scalar> momentum(std::size_t k, const Scalar& z, bool upward) const {
    const Scalar r = at(k, z), less = h_ / r / (Scalar(1) + q(r)) / Scalar(2);
    return upward ? StartMomentum<Scalar>{Scalar(1) - less, less}
                  : StartMomentum<Scalar>{less, Scalar(1) - less};
  }

  void make_room() {
    std::size_t lowest = std::min(end_, pieces_.piece_at(path_.foot)),
                highest = std::max(end_, pieces_.piece_at(path_.foot));
    const auto touch = [&](std::size_t k) {
      lowest = std::min(lowest, k);
      highest = std::max(highest, k);
    };
    if (path_.turned) touch(cells_.layer[path_.interface]);
    if (path_.kind == PathKind::waiting) touch(cells_.layer[path_.interface]);
    out_.first = lowest > 0 ? lowest - 1 : 0;
    highest = std::min(highest + 1, pieces_.size() - 1);
    out_.pieces.resize(2 * (highest - out_.first + 1));
    out_.boundaries.resize(highest - out_.first + 1);
  }

  /// The run between two heights, passed n times.
  void add_run(const Scalar& from, const Scalar& to, int n) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to), times(n);
    for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
      const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
      if (!(b > a)) continue;
      const Scalar d = b - a, r1 = at(k, a), r2 = at(k, b), q1 = q(r1), q2 = q(r2);
      const RateForm form = pieces_.form[k];
      const Scalar some_q1 = std::max(least_q(), q1), some_q2 = std::max(least_q(), q2);
      const CrossingDerivatives<Scalar> by(form, d, r1, q1, r2, q2, h_),
          by_time(form, d, r1, some_q1, r2, some_q2, h_);
      T_h_ += times * crossing_T_h(form, d, r1, some_q1, r2, some_q2);
      time_ += times * Crossing<Scalar>(form, d, r1, q1, r2, q2, h_).T;
      const Scalar gain = times * h_ / Scalar(4);
      add_at(k, a, gain * by.J1, times * by_time.T1);
      add_at(k, b, gain * by.J2, times * by_time.T2);
    }
  }
  /// The jumps passed n times.
  void add_jump(std::size_t boundary, int n) {
    const Scalar &below = pieces_.high[boundary - 1], &above = pieces_.low[boundary];
    if (below == above) return;
    const Scalar q_below = q(below), q_above = q(above), times(n);
    Pair& by = out_.boundaries[boundary - out_.first];
    by.M += times * (q_below - q_above) / Scalar(2);
    by.phi += times * (Scalar(1) / (below * q_below) - Scalar(1) / (above * q_above));
  }
  /// Of the boundaries between two heights, `from` and `to` left out.
  void add_jumps(const Scalar& from, const Scalar& to, int n) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to);
    for (std::size_t k = pieces_.piece_at(lo) + 1; k < pieces_.size() && pieces_.boundaries[k] < hi; ++k)
      if (pieces_.boundaries[k] > lo) add_jump(k, n);
  }
  void add_jump_at(const Scalar& z, int n) {
    const std::size_t k = pieces_.piece_at(z);
    if (k > 0 && pieces_.boundaries[k] == z) add_jump(k, n);
  }

  /// The turn in piece j, beyond the height `from`.
  void add_turn(std::size_t j, const Scalar& from) {
    const Scalar A = at(j, from), qA = q(A),
                 bend = pieces_.bend[j] < 0 ? Scalar(-pieces_.bend[j]) : pieces_.bend[j];
    const Scalar& near = is_set_up_ ? pieces_.low[j] : pieces_.high[j];  // on the side it comes from
    const Scalar& far = is_set_up_ ? pieces_.high[j] : pieces_.low[j];
    const Turn<Scalar> turn(pieces_.form[j], bend, A, qA, h_);
    time_ += turn.T;
    T_h_ -= turn.steep / qA;
    Pair &by_near = number(j, !is_set_up_), &by_far = number(j, is_set_up_);
    const Scalar two(2), four(4);
    const Scalar cube = qA * qA * qA * artanh_rest(Scalar(qA * qA));  // artanh q - q
    if (pieces_.form[j] == RateForm::linear) {
      const Scalar fall = near - far;  // |b| = fall / width
      // int (near - r) / (r^2 q) and int (r - far) / (r^2 q) over both ways.
      const Scalar to_far = qA * ((near - A) + A * qA * qA) / h_ - cube;
      const Scalar to_near = cube + qA * ((A - far) - A * qA * qA) / h_;
      const Scalar scale = h_ / (bend * fall);
      by_far.M += scale * to_far;
      by_near.M += scale * to_near;
      add_at(j, from, Scalar(0), two / (bend * A * qA));
      by_far.phi += turn.T / fall;
      by_near.phi -= turn.T / fall;
    } else {
      // The part of the piece passed, in time: that at `from`, and log(A / r) / log(near / far) beyond.
      const Scalar fall = bend * pieces_.width(j), w_high = (from - pieces_.boundaries[j]) / pieces_.width(j);
      const Scalar beyond = Scalar(8) / (bend * h_) * cube / fall;
      const Scalar passed = (is_set_up_ ? w_high : Scalar(Scalar(1) - w_high)) * turn.T + beyond;
      by_far.M += h_ / four / far * passed;
      by_near.M += h_ / four / near * (turn.T - passed);
      add_at(j, from, Scalar(0), two / (bend * A * A * qA));
      by_far.phi += turn.T / (fall * far);
      by_near.phi -= turn.T / (fall * near);
    }
  }

  /// All runs, jumps and the turn: dM, and into the phi entries dT at fixed h.
  void passes() {
    add_run(path_.foot, z_, 1);
    add_jumps(path_.foot, z_, 1);
    if (!path_.turned) return;
    const std::size_t j = cells_.layer[path_.interface];
    const Scalar& outer = is_set_up_ ? std::max(path_.foot, z_) : std::min(path_.foot, z_);
    const Scalar& entry = pieces_.boundaries[is_set_up_ ? j : j + 1];
    const Scalar& last = is_set_up_ ? std::max(outer, entry) : std::min(outer, entry);
    if (last != outer) {
      add_run(outer, last, 2);
      add_jumps(outer, last, 2);
      add_jump_at(last, 2);
    }
    // A boundary at the outer one of start and end is passed once more than counted.
    if (path_.foot != z_ && (last != outer || entry == outer)) add_jump_at(outer, 1);
    add_turn(j, last);
  }

  /// d phi = +-dq / 2 at z, from dh and the rate at z.
  [[nodiscard]] Scalar phi_by_h() const {
    const Scalar r = at(end_, z_), tiny = unit_roundoff<Scalar>() * unit_roundoff<Scalar>();
    const Scalar by = Scalar(-1) / (Scalar(4) * r * std::max(tiny, q(r)));
    return path_.upward ? by : Scalar(-by);
  }
  [[nodiscard]] Scalar phi_by_rate() const { return -phi_by_h() * (h_ / at(end_, z_)); }

  void phi_of_fan() {
    const Scalar by_h = phi_by_h(), turn = -by_h / T_h_;  // dh = -dT / T_h
    for (Pair& pair : out_.pieces) pair.phi *= turn;
    for (Pair& pair : out_.boundaries) pair.phi *= turn;
    const Scalar r = at(start_, path_.foot), slowness = Scalar(1) / (r * q(r));
    out_.phi_start = turn * (is_set_up_ ? Scalar(-slowness) : slowness);
    out_.phi_log_scale = by_h * t_ / T_h_;
    add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// h = 4 g r(y) and T(y, h) = t with y free.
  void phi_of_state() {
    const Scalar p0 = cells_.phi[path_.source], one(1), four(4), g = p0 * (one - p0);
    const Scalar r = at(start_, path_.foot);
    const Scalar q0 = std::max(q(r), least_q());
    const Scalar slope = slope_at(pieces_.form[start_], pieces_.bend[start_], r);
    const Scalar b = is_set_up_ ? slope : Scalar(-slope);
    const Scalar all = one - four * g * b * r * (q0 * T_h_), by_h = phi_by_h();
    const Scalar turn = by_h * four * g * b * r * q0 / all;
    for (Pair& pair : out_.pieces) pair.phi *= turn;
    for (Pair& pair : out_.boundaries) pair.phi *= turn;
    add_at(start_, path_.foot, Scalar(0), by_h * four * g / all);
    const Scalar lean = one - Scalar(2) * p0, size = lean < 0 ? Scalar(-lean) : lean;
    const Scalar least = is_set_up_ ? Scalar(-least_q()) : least_q();
    out_.phi_state = by_h * four * r * (size < least_q() ? least : lean) / all;
    out_.phi_log_scale = -turn * t_;
    add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// A path that does not leave a linear piece: by r at its start or end and by the slope. Of a state logit phi = logit p0 + b t.
  void in_linear_piece() {
    const Scalar one(1), &slope = pieces_.bend[end_], width = pieces_.width(end_);
    const LinearDrift<Scalar> drift(slope, t_);
    StartMomentum<Scalar> start;
    Scalar by_slope;
    if (path_.kind == PathKind::constant) {
      start = {cells_.phi[path_.source], one - cells_.phi[path_.source]};
      const Scalar D = start.p * drift.u + start.missing * drift.v;
      out_.phi_state = drift.u / D * (drift.v / D);
      by_slope = out_.phi_state * start.p * start.missing * t_;
      out_.phi_log_scale = by_slope * slope;
    } else {
      const Scalar r = at(end_, z_), d = z_ - path_.foot;
      const auto arc = arc_from_point(RateForm::linear, slope, t_, d, at(start_, path_.foot), r);
      const auto by = linear_fan_derivatives(arc, drift, slope, t_, d, r);
      const Scalar p = arc.p * drift.v, missing = arc.missing * drift.u;
      start = {p / (p + missing), missing / (p + missing)};
      out_.start = start;
      out_.phi_start = by.by_start;
      out_.phi_log_scale = by.by_log_scale;
      by_slope = by.by_slope;
      add_at(end_, z_, Scalar(0), by.by_rate);
    }
    number(end_, true).phi += by_slope / width;
    number(end_, false).phi -= by_slope / width;
    if (!(h_ > 0)) return;
    const LinearArcIntegrals<Scalar> integrals(path_.H, drift, slope, t_, start.p, start.missing);
    add_at(end_, path_.foot, integrals.level, Scalar(0));
    number(end_, true).M += integrals.height / width;
    number(end_, false).M -= integrals.height / width;
  }

  /// A path that does not leave an exponential piece: by log r at its start or end and by kappa = |r'/r|, which are
  ///   log r(z) = w_low log r_low + w_high log r_high,   kappa = log(near / far) / width,
  /// near the end with the larger rate. Where r rises all is turned upside down.
  void in_exponential_piece() {
    using std::expm1;
    const Scalar one(1), &bend = pieces_.bend[end_];
    const bool is_rising = bend > 0;
    const Scalar kappa = is_rising ? bend : Scalar(-bend), sign(is_rising ? -1 : 1);
    const Scalar r0 = at(start_, path_.foot), d = sign * (z_ - path_.foot);
    ExponentialFanDerivatives<Scalar> phi;
    StartMomentum<Scalar> start;  // in the orientation in which r falls
    if (path_.kind == PathKind::constant) {
      const Scalar& p0 = cells_.phi[path_.source];
      start = is_rising ? StartMomentum<Scalar>{one - p0, p0} : StartMomentum<Scalar>{p0, one - p0};
      const Scalar b = at(end_, z_) * t_ * kappa;
      const FootRoot<Scalar> root(b, start.p);
      out_.phi_state = root.phi_by_state(b, start.p);
      phi.by_log_rate = root.phi_by_log_b(b, start.p);
      phi.by_kappa = phi.by_log_rate / kappa;
    } else {
      const Scalar log_E = kappa * d, e = expm1(log_E), way = r0 * t_;
      const FanMomenta<Scalar> fan(Scalar(way * kappa), log_E, e);
      start = {fan.p0, fan.one_minus_p0};
      out_.start = is_rising ? StartMomentum<Scalar>{fan.one_minus_p0, fan.p0} : start;
      phi = exponential_fan_derivatives<Scalar>(fan, kappa, way, d, e);
      out_.phi_start = phi.by_start;
    }
    out_.phi_log_scale = sign * phi.by_log_rate;
    const Scalar gain = path_.H * t_, width = pieces_.width(end_);
    const Scalar& from = path_.kind == PathKind::constant ? z_ : path_.foot;
    // log r falls by kappa times the way from the start.
    const Scalar by_kappa =
        -gain * mean_height_in_exponential<Scalar>(Scalar(r0 * t_), kappa, start.p, start.missing);
    for (const bool is_high : {false, true}) {
      const Scalar& beyond = pieces_.boundaries[is_high ? end_ : end_ + 1];
      const Scalar unit =
          Scalar(is_high ? 1 : -1) / (width * (is_high ? pieces_.high[end_] : pieces_.low[end_]));
      number(end_, is_high).M += unit * (gain * (path_.foot - beyond) - sign * by_kappa);
      number(end_, is_high).phi += unit * (out_.phi_log_scale * (from - beyond) - phi.by_kappa);
    }
  }

  /// H = 0: phi stays 0 or 1, and M does not change with the bed.
  PathGradient<Scalar> pure() {
    out_.phi_state = at(start_, path_.foot) / at(end_, z_);  // H = r(y) g is conserved
    return std::move(out_);
  }

  /// A jump in a flat piece, seen from its place: the path rests there.
  PathGradient<Scalar> at_its_source() {
    const Scalar r = at(end_, z_);
    add_at(end_, z_, t_ / Scalar(4), Scalar(0));
    out_.phi_start = Scalar(-1) / (Scalar(2) * r * t_);
    return std::move(out_);
  }

  void move_boundaries() {
    for (std::size_t n = 1; n < out_.boundaries.size(); ++n) {
      const std::size_t k = out_.first + n;
      const Pair &below = number(k - 1, true), &above = number(k, false);
      const Scalar slope_below = pieces_.end_slope(k - 1, true), slope_above = pieces_.end_slope(k, false);
      out_.boundaries[n].M -= slope_below * below.M + slope_above * above.M;
      out_.boundaries[n].phi -= slope_below * below.phi + slope_above * above.phi;
    }
  }

  void waiting() {
    const std::size_t w = cells_.layer[path_.interface];  // the piece above the throat
    const Scalar& z_w = pieces_.boundaries[w];
    const Scalar &low_side = pieces_.low[w], &high_side = pieces_.high[w - 1];
    add_run(path_.foot, z_w, 1);
    add_jumps(path_.foot, z_w, 1);
    add_run(z_w, z_, 1);
    add_jumps(z_w, z_, 1);
    for (Pair& pair : out_.pieces) pair.phi = Scalar(0);
    for (Pair& pair : out_.boundaries) pair.phi = Scalar(0);
    const bool is_still = !(q(at(end_, z_)) > 0);  // phi = 1/2 at the place of rest
    if (!is_still) add_at(end_, z_, Scalar(0), phi_by_rate());
    move_boundaries();
    // What limits the throat; at rest it moves with the boundary.
    const bool is_above = low_side < high_side;
    Pair& limit = number(is_above ? w : w - 1, !is_above);
    limit.M += (t_ - time_) / Scalar(4);
    if (!is_still) limit.phi += phi_by_h();
    const bool comes = path_.foot != z_w, goes = z_ != z_w, from_below = path_.foot < z_w, goes_up = z_w < z_;
    const auto beside = [&](bool above, bool upward) { return momentum(above ? w : w - 1, z_w, upward); };
    if (comes) {
      const std::size_t k = path_.is_state ? cells_.layer[path_.source]
                            : from_below   ? cells_.layer[path_.source]
                                           : cells_.layer[path_.source - 1];
      out_.start = momentum(k, path_.foot, from_below);
      if (goes) {
        const auto in = beside(!from_below, from_below), back = beside(goes_up, goes_up);
        out_.boundaries[w - out_.first].M += from_below ? Scalar((Scalar(1) - back.p) - in.missing)
                                                        : Scalar((in.p - Scalar(1)) + back.missing);
      }
    } else if (goes) {
      out_.start = beside(goes_up, goes_up);
    }
  }

  const SlopedPieces<Scalar>& pieces_;
  const Cells<Scalar>& cells_;
  const Path<Scalar>& path_;
  Scalar z_, t_, h_;
  std::size_t end_, start_ = 0;
  bool is_set_up_ = true;
  Scalar T_h_{0}, time_{0};
  PathGradient<Scalar> out_;
};

}  // namespace shearfront::exact
