// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "shearfront/exact/arc_gradient.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/piece_numbers.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_calculus.hpp"
#include "shearfront/exact/sloped_route.hpp"
#include "shearfront/model/depth/model.hpp"

namespace shearfront::exact {

/// Derivatives along a path through sloped pieces, the rates at both ends of each piece as its numbers; a boundary moves with
/// them. Cost: O(pieces touched).
template <Real Scalar, class Calculus>
class SlopedGradient {
 public:
  SlopedGradient(const Calculus& calculus, const SlopedPieces<Scalar>& pieces, const Cells<Scalar>& cells,
                 const Path<Scalar>& path, const Scalar& z, const Scalar& t, PathGradient<Scalar>& out)
      : calculus_(calculus),
        pieces_(pieces),
        cells_(cells),
        path_(path),
        z_(z),
        t_(t),
        h_(Scalar(4) * path.H),
        out_(out) {}

  /// Into an `out` that is empty.
  void run() {
    if (path_.kind == PathKind::bottom_wall || path_.kind == PathKind::top_wall ||
        path_.kind == PathKind::none)
      return;
    end_ = pieces_.piece_at(z_);
    rate_at_end_ = at(end_, z_);
    is_set_up_ = path_.upward != path_.turned;
    if (path_.kind == PathKind::waiting) {
      make_room();
      return waiting();
    }
    const bool is_state = path_.kind == PathKind::constant;
    start_ =
        is_state ? cells_.layer[path_.source] : cells_.layer[is_set_up_ ? path_.source : path_.source - 1];
    const bool is_inside = start_ == end_ && (!path_.turned || cells_.layer[path_.interface] == start_);
    if (h_ == 0 && is_state && !(is_inside && kKnowsPieces && cells_.is_curved(path_.source))) return pure();
    make_room();
    if constexpr (kKnowsPieces) {
      if (is_inside) {
        ArcGradient<Scalar>(pieces_, cells_, path_, end_, z_, t_, numbers_, out_).run();
        return numbers_.move_boundaries();
      }
    }
    if (!is_state) out_.start = momentum(start_, path_.foot, is_set_up_);
    if (path_.foot == z_ && !path_.turned && !(is_state && kKnowsPieces)) return at_its_place(is_state);
    passes();
    if (path_.x == 0 && !is_state && !path_.turned) return rest_on_the_way();
    if (is_state && is_inside && !cells_.is_curved(path_.source))
      phi_of_state_inside();
    else if (is_state)
      phi_of_state();
    else
      phi_of_fan();
    numbers_.move_boundaries();
  }

 private:
  using Pair = typename PathGradient<Scalar>::Pair;

  /// A path inside one piece has closed forms of its own.
  static constexpr bool kKnowsPieces = std::is_same_v<Calculus, ParabolaCalculus<Scalar>>;

  [[nodiscard]] Scalar at(std::size_t k, const Scalar& z) const { return pieces_.rate(k, z); }
  [[nodiscard]] StartMomentum<Scalar> momentum(std::size_t k, const Scalar& z, bool upward) const {
    const Scalar less = calculus_.less(k, at(k, z), upward);
    return upward ? StartMomentum<Scalar>{Scalar(1) - less, less}
                  : StartMomentum<Scalar>{less, Scalar(1) - less};
  }

  void make_room() {
    foot_ = pieces_.piece_at(path_.foot);
    std::size_t lowest = std::min(end_, foot_), highest = std::max(end_, foot_);
    if (path_.turned || path_.kind == PathKind::waiting) {
      const std::size_t k = cells_.layer[path_.interface];
      lowest = std::min(lowest, k);
      highest = std::max(highest, k);
    }
    numbers_.make_room(lowest, highest);
  }

  [[nodiscard]] std::size_t piece_of(const Scalar& z) const {
    return z == z_ ? end_ : z == path_.foot ? foot_ : pieces_.piece_at(z);
  }
  /// The run from one height to another.
  void add_run(const Scalar& from, const Scalar& to) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to);
    for (std::size_t k = piece_of(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
      const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
      if (!(b > a)) continue;
      const bool is_at_low = a == pieces_.boundaries[k], is_at_high = b == pieces_.boundaries[k + 1];
      const Scalar r1 = is_at_low ? pieces_.low[k] : at(k, a), r2 = is_at_high ? pieces_.high[k] : at(k, b);
      const RunParts<Scalar> by = calculus_.run(k, from < to, Scalar(b - a), r1, r2);
      T_h_ += by.T_h;
      time_ += by.T;
      const Scalar gain = h_ / Scalar(4), M1 = gain * by.J1, M2 = gain * by.J2;
      is_at_low ? numbers_.add_at_end(k, false, M1, by.T1) : numbers_.add_at(k, a, M1, by.T1);
      is_at_high ? numbers_.add_at_end(k, true, M2, by.T2) : numbers_.add_at(k, b, M2, by.T2);
    }
  }
  /// The jump at a boundary, passed upwards or downwards.
  void add_jump(std::size_t boundary, bool is_up) {
    const std::size_t below = boundary - 1;
    if (!calculus_.is_jump(below, boundary)) return;
    Pair& by = numbers_.boundary(boundary);
    by.M += calculus_.change(below, boundary, is_up);
    by.phi += calculus_.slowness(below, pieces_.high[below], is_up) -
              calculus_.slowness(boundary, pieces_.low[boundary], is_up);
  }
  /// Of the boundaries between two heights, `from` and `to` left out.
  void add_jumps(const Scalar& from, const Scalar& to) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to);
    for (std::size_t k = piece_of(lo) + 1; k < pieces_.size() && pieces_.boundaries[k] < hi; ++k)
      if (pieces_.boundaries[k] > lo) add_jump(k, from < to);
  }
  void add_jump_at(const Scalar& z, bool is_up) {
    const std::size_t k = piece_of(z);
    if (k > 0 && pieces_.boundaries[k] == z) add_jump(k, is_up);
  }

  /// The turn in piece j, beyond the height `from`.
  void add_turn(std::size_t j, const Scalar& from) {
    const TurnParts<Scalar> by = calculus_.turn(j, is_set_up_, at(j, from), from);
    time_ += by.T;
    T_h_ += by.T_h;
    Pair &by_near = numbers_.number(j, !is_set_up_), &by_far = numbers_.number(j, is_set_up_);
    by_far.M += by.M_far;
    by_near.M += by.M_near;
    numbers_.add_at(j, from, Scalar(0), by.T_A);
    by_far.phi += by.T_far;
    by_near.phi += by.T_near;
  }

  /// All runs, jumps and the turn: dM, and into the phi entries dT at fixed h.
  void passes() {
    add_run(path_.foot, z_);
    add_jumps(path_.foot, z_);
    if (!path_.turned) return;
    const std::size_t j = cells_.layer[path_.interface];
    const Scalar& outer = is_set_up_ ? std::max(path_.foot, z_) : std::min(path_.foot, z_);
    const Scalar& entry = pieces_.boundaries[is_set_up_ ? j : j + 1];
    const Scalar& last = is_set_up_ ? std::max(outer, entry) : std::min(outer, entry);
    if (last != outer) {
      add_run(outer, last);
      add_run(last, outer);
      add_jumps(outer, last);
      add_jumps(last, outer);
      for (const bool is_up : {true, false}) add_jump_at(last, is_up);
    }
    // A boundary at the outer one of start and end is passed once more than counted.
    if (path_.foot != z_ && (last != outer || entry == outer))
      add_jump_at(outer, (outer == z_) == is_set_up_);
    add_turn(j, last);
  }

  /// d phi = +-dq / 2 at z, from dh and the rate at z.
  [[nodiscard]] Scalar phi_by_h() const {
    const Scalar by = calculus_.slowness(end_, rate_at_end_, path_.upward) / Scalar(-4);
    return path_.upward ? by : Scalar(-by);
  }
  [[nodiscard]] Scalar phi_by_rate() const { return -phi_by_h() * (h_ / rate_at_end_); }

  void phi_of_fan() {
    const Scalar by_h = phi_by_h(), turn = -by_h / T_h_;  // dh = -dT / T_h
    numbers_.multiply_phi(turn);
    const Scalar slowness = calculus_.slowness(start_, at(start_, path_.foot), is_set_up_);
    out_.phi_start = turn * (is_set_up_ ? Scalar(-slowness) : slowness);
    out_.phi_log_scale = by_h * t_ / T_h_;
    numbers_.add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// h = 4 g r(y) and T(y, h) = t with y free, on which g depends as well where the start is smooth.
  void phi_of_state() {
    const Scalar p0 = cells_.state(path_.source, path_.foot), one(1), G = calculus_.height(start_, p0);
    const Scalar r = at(start_, path_.foot), speed = one / calculus_.slowness(start_, r, is_set_up_);
    // By the speed that the path has there, r |dG/dp| / 4: next to the peak rounding gives that of the state another one.
    const Scalar G_p = Scalar(is_set_up_ ? -4 : 4) * speed / r;
    // dh/dy, away from where it goes.
    const Scalar slope = G * slope_at(pieces_.form[start_], pieces_.bend[start_], r) +
                         r * G_p * cells_.slope(path_.source, path_.foot);
    const Scalar b = is_set_up_ ? slope : Scalar(-slope);
    const Scalar all = one - b * (speed * T_h_), by_h = phi_by_h();
    const Scalar turn = by_h * b * speed / all;
    numbers_.multiply_phi(turn);
    numbers_.add_at(start_, path_.foot, Scalar(0), by_h * G / all);
    out_.phi_state = by_h * r * G_p / all;
    out_.phi_log_scale = -turn * t_;
    numbers_.add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// A constant state that has not left its piece: of a linear one with the slope b int dp / G rises by b t / 4, of an exponential one with
  /// r' / r = k, p by k r(z) G(p) t / 4.
  void phi_of_state_inside() {
    numbers_.clear_phi();
    const Scalar &p0 = cells_.phi[path_.source], &bend = pieces_.bend[end_], one(1),
                 width = pieces_.width(end_);
    const Scalar r = rate_at_end_, G = h_ / r, unit = t_ / Scalar(4);
    if (pieces_.form[end_] == RateForm::linear) {
      const Scalar G0 = calculus_.height(start_, p0);
      out_.phi_state = G0 > 0 ? Scalar(G / G0) : Scalar(r / at(end_, path_.foot));
      out_.phi_log_scale = unit * bend * G;
      numbers_.number(end_, true).phi += unit * G / width;
      numbers_.number(end_, false).phi -= unit * G / width;
      return;
    }
    const Scalar slope = calculus_.height_slope(end_, path_.p, path_.upward),
                 all = one / (one - unit * bend * r * slope), by_rate = unit * bend * G * all;
    out_.phi_state = all;
    out_.phi_log_scale = by_rate * r;
    numbers_.add_at(end_, z_, Scalar(0), by_rate);
    // k = log(r_high / r_low) / width.
    const Scalar by_bend = unit * r * G * all / width;
    numbers_.number(end_, true).phi += by_bend / pieces_.high[end_];
    numbers_.number(end_, false).phi -= by_bend / pieces_.low[end_];
  }

  /// H is the least capacity on the way, where a path through a flux with a kink spends the time that is left: at an end of a
  /// piece, at its start, or at z.
  void rest_on_the_way() {
    numbers_.clear_phi();
    numbers_.add_at(end_, z_, Scalar(0), phi_by_rate());
    const Scalar M = (t_ - time_) / Scalar(4), phi = phi_by_h(), &lowest = std::min(path_.foot, z_),
                 &highest = std::max(path_.foot, z_);
    const auto excess = [&](const Scalar& r) {
      return r < path_.r_reference ? Scalar(path_.r_reference - r) : Scalar(r - path_.r_reference);
    };
    Scalar least = excess(rate_at_end_);
    std::size_t piece = end_;
    const Scalar* place = &z_;
    const auto take = [&](std::size_t k, const Scalar& z, const Scalar& r) {
      if (z < lowest || z > highest || !(excess(r) < least)) return;
      least = excess(r);
      piece = k;
      place = &z;
    };
    take(start_, path_.foot, at(start_, path_.foot));
    for (std::size_t k = std::min(start_, end_); k <= std::max(start_, end_); ++k) {
      take(k, pieces_.boundaries[k], pieces_.low[k]);
      take(k, pieces_.boundaries[k + 1], pieces_.high[k]);
    }
    if (place == &z_ || place == &path_.foot) {
      numbers_.add_at(piece, *place, M, phi);
      numbers_.move_boundaries();
    } else {  // there the capacity moves with the boundary
      numbers_.move_boundaries();
      numbers_.add_at_end(piece, place == &pieces_.boundaries[piece + 1], M, phi);
    }
    if (place == &path_.foot) {  // the start takes its capacity along
      const Scalar slope = slope_at(pieces_.form[piece], pieces_.bend[piece], at(piece, *place));
      out_.start.p -= M * slope;
      out_.start.missing += M * slope;
      out_.phi_start = phi * slope;
    }
  }

  /// H = 0: phi stays 0 or 1, and M does not change with the bed.
  void pure() {
    // H = r(y) g is conserved.
    out_.phi_state = at(start_, path_.foot) / rate_at_end_ * calculus_.pure_ratio(start_, end_, path_.upward);
  }

  /// A jump or a state at the peak in a flat piece, seen from its place: the path rests there.
  void at_its_place(bool is_state) {
    numbers_.add_at(end_, z_, is_state ? Scalar(path_.H * t_ / rate_at_end_) : Scalar(t_ / Scalar(4)),
                    Scalar(0));
    if (is_state && start_ == end_)
      phi_of_state_inside();
    else if (is_state)
      out_.phi_state = Scalar(1);
    else
      out_.phi_start = calculus_.at_source(end_) / (rate_at_end_ * t_);
  }

  void waiting() {
    const std::size_t w = cells_.layer[path_.interface];  // the piece above the throat
    const Scalar& z_w = pieces_.boundaries[w];
    const Scalar &low_side = pieces_.low[w], &high_side = pieces_.high[w - 1];
    add_run(path_.foot, z_w);
    add_jumps(path_.foot, z_w);
    add_run(z_w, z_);
    add_jumps(z_w, z_);
    numbers_.clear_phi();
    const bool is_still = calculus_.is_at_peak(end_, rate_at_end_, path_.upward);  // at the place of rest
    if (!is_still) numbers_.add_at(end_, z_, Scalar(0), phi_by_rate());
    numbers_.move_boundaries();
    // What limits the throat; at rest it moves with the boundary.
    const bool is_above = low_side < high_side;
    Pair& limit = numbers_.number(is_above ? w : w - 1, !is_above);
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
        numbers_.boundary(w).M += from_below ? Scalar((Scalar(1) - back.p) - in.missing)
                                             : Scalar((in.p - Scalar(1)) + back.missing);
      }
    } else if (goes) {
      out_.start = beside(goes_up, goes_up);
    }
  }

  const Calculus& calculus_;
  const SlopedPieces<Scalar>& pieces_;
  const Cells<Scalar>& cells_;
  const Path<Scalar>& path_;
  Scalar z_, t_, h_;
  Scalar rate_at_end_{0};
  std::size_t end_ = 0, foot_ = 0, start_ = 0;  ///< pieces of z, of the height of the start, of its source
  bool is_set_up_ = true;
  Scalar T_h_{0}, time_{0};
  PathGradient<Scalar>& out_;
  PieceNumbers<Scalar> numbers_{pieces_, out_};
};

}  // namespace shearfront::exact
