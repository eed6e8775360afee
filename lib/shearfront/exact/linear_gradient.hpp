// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/exact/linear_bed.hpp"
#include "shearfront/exact/linear_route.hpp"
#include "shearfront/exact/medium.hpp"

namespace shearfront::exact {

/// Derivatives of the time of a run at fixed h with respect to the rates at both ends of it, and of int p dz at fixed H over
/// h / 4: J_i = int hat_i / (r^2 q) dz, -2 dT/dr_i = J_i + L_i, L_i = int hat_i / (r^2 q^3) dz.
template <Real Scalar>
struct CrossingDerivatives {
  Scalar J1, J2;
  Scalar rest1, rest2;  ///< q_i (L_i - J_i)

  CrossingDerivatives(const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2, const Scalar& q2,
                      const Scalar& h) {
    const Scalar one(1), two(2), four(4), sum = q1 + q2;
    const Scalar product = (one + q1) * (one + q2), w1 = r1 * (one + q1) * (one + q1);
    const Scalar D = w1 + r2 * (one + q2) * (one + q2), y = two * d * product / (sum * D);
    const Scalar b = (r2 - r1) / d, x = (r2 - r1) * (two * product) / (sum * D);
    const Scalar c = two / d * b * y * y * y * artanh_rest(x), part = four * d * product / (sum * sum * D);
    J1 = part * q2 / r1 - c;
    J2 = part * q1 / r2 + c;
    rest1 = two * h * d / (r1 * r1 * r2 * sum * sum);
    rest2 = two * h * d / (r1 * r2 * r2 * sum * sum);
  }
};

/// Derivatives along a path through linear pieces, the rates at both ends of each piece as its numbers; a boundary moves with
/// them. Cost: O(pieces touched).
///
/// Moving a boundary between the slopes b_- and b_+ changes r next to it as changing the rates there by -b_- and -b_+
/// does, and moves the jump with it.
template <Real Scalar>
class LinearGradient {
 public:
  LinearGradient(const LinearPieces<Scalar>& pieces, const Cells<Scalar>& cells, const Path<Scalar>& path,
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
  /// Part of the number at the upper end of piece k in the rate at z.
  [[nodiscard]] Scalar part(std::size_t k, const Scalar& z) const {
    return (z - pieces_.boundaries[k]) / (pieces_.boundaries[k + 1] - pieces_.boundaries[k]);
  }
  [[nodiscard]] Pair& number(std::size_t k, bool is_high) {
    return out_.pieces[2 * (k - out_.first) + (is_high ? 1 : 0)];
  }
  /// Adds to the numbers of piece k what the rate at z does.
  void add_at(std::size_t k, const Scalar& z, const Scalar& M, const Scalar& phi) {
    const Scalar high = part(k, z), low = Scalar(1) - high;
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

  /// The run between two heights, passed n times. At the start of a constant state its q is q_start_, of which
  /// derivatives are kept times q: with_q0_ is a sum of those.
  void add_run(const Scalar& from, const Scalar& to, int n) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to), times(n);
    for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
      const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
      if (!(b > a)) continue;
      const Scalar d = b - a, r1 = at(k, a), r2 = at(k, b), q1 = q(r1), q2 = q(r2);
      const CrossingDerivatives<Scalar> by(d, r1, q1, r2, q2, h_);
      T_h_ += times * crossing_T_h(d, r1, q1, r2, q2);
      time_ += times * Crossing<Scalar>(d, r1, q1, r2, q2, h_).T;
      const Scalar half = times / Scalar(2), gain = times * h_ / Scalar(4);
      add_at(k, a, gain * by.J1, -half * (Scalar(2) * by.J1 + by.rest1 / q1));
      add_at(k, b, gain * by.J2, -half * (Scalar(2) * by.J2 + by.rest2 / q2));
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
    const Scalar A = at(j, from), qA = q(A), two(2), four(4);
    const Scalar width = pieces_.boundaries[j + 1] - pieces_.boundaries[j];
    const Scalar& near = is_set_up_ ? pieces_.low[j] : pieces_.high[j];  // on the side it comes from
    const Scalar& far = is_set_up_ ? pieces_.high[j] : pieces_.low[j];
    const Scalar fall = near - far, slope = fall / width;
    const Scalar T = four / slope * artanh_of(qA, A, h_);
    time_ += T;
    T_h_ -= two / (slope * h_ * qA);
    // int (near - r) / (r^2 q) and int (r - far) / (r^2 q) over both ways.
    const Scalar cube = qA * qA * qA * artanh_rest(qA);
    const Scalar to_far = qA * ((near - A) + A * qA * qA) / h_ - cube;
    const Scalar to_near = cube + qA * ((A - far) - A * qA * qA) / h_;
    const Scalar scale = h_ / (slope * fall);
    number(j, is_set_up_).M += scale * to_far;
    number(j, !is_set_up_).M += scale * to_near;
    add_at(j, from, Scalar(0), two / (slope * A * qA));
    number(j, is_set_up_).phi += T / fall;  // |b| = (near - far) / width
    number(j, !is_set_up_).phi -= T / fall;
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
    if (start_ == end_ && (!path_.turned || cells_.layer[path_.interface] == start_))
      return phi_in_one_piece(p0);
    const Scalar r = at(start_, path_.foot);
    const Scalar q0 = std::max(q(r), Scalar(unit_roundoff<Scalar>() * unit_roundoff<Scalar>()));
    const Scalar b = is_set_up_ ? pieces_.slope(start_) : Scalar(-pieces_.slope(start_));
    const Scalar all = one - four * g * b * r * (q0 * T_h_), by_h = phi_by_h();
    const Scalar turn = by_h * four * g * b * r * q0 / all;
    for (Pair& pair : out_.pieces) pair.phi *= turn;
    for (Pair& pair : out_.boundaries) pair.phi *= turn;
    add_at(start_, path_.foot, Scalar(0), by_h * four * g / all);
    out_.phi_state = by_h * four * r * (one - Scalar(2) * p0) / all;
    out_.phi_log_scale = -turn * t_;
    add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// logit phi = logit p0 + b t.
  void phi_in_one_piece(const Scalar& p0) {
    for (Pair& pair : out_.pieces) pair.phi = Scalar(0);
    for (Pair& pair : out_.boundaries) pair.phi = Scalar(0);
    const LinearDrift<Scalar> drift(pieces_.slope(end_), t_);
    const Scalar one(1), D = p0 * drift.u + (one - p0) * drift.v, by = drift.u * drift.v / (D * D);
    out_.phi_state = by;
    const Scalar by_slope = by * p0 * (one - p0) * t_;
    const Scalar width = pieces_.boundaries[end_ + 1] - pieces_.boundaries[end_];
    number(end_, true).phi += by_slope / width;
    number(end_, false).phi -= by_slope / width;
    out_.phi_log_scale = by_slope * pieces_.slope(end_);
  }

  /// H = 0: phi stays 0 or 1, and M does not change with the bed.
  PathGradient<Scalar> pure() {
    const Scalar& p0 = cells_.phi[path_.source];
    if (start_ == end_)
      phi_in_one_piece(p0);
    else
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
      out_.boundaries[n].M -= pieces_.slope(k - 1) * below.M + pieces_.slope(k) * above.M;
      out_.boundaries[n].phi -= pieces_.slope(k - 1) * below.phi + pieces_.slope(k) * above.phi;
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

  const LinearPieces<Scalar>& pieces_;
  const Cells<Scalar>& cells_;
  const Path<Scalar>& path_;
  Scalar z_, t_, h_;
  std::size_t end_, start_ = 0;
  bool is_set_up_ = true;
  Scalar T_h_{0}, time_{0};
  PathGradient<Scalar> out_;
};

}  // namespace shearfront::exact
