// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/arc_derivatives.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_calculus.hpp"
#include "shearfront/exact/sloped_route.hpp"
#include "shearfront/model/depth/model.hpp"

namespace shearfront::exact {

/// Derivatives along a path through sloped pieces, the rates at both ends of each piece as its numbers; a boundary moves with
/// them. Cost: O(pieces touched).
///
/// Moving a boundary between the slopes b_- and b_+ changes r next to it as changing the rates there by -b_- and -b_+
/// does, and moves the jump with it.
template <Real Scalar, class Calculus>
class SlopedGradient {
 public:
  SlopedGradient(const Calculus& calculus, const SlopedPieces<Scalar>& pieces, const Cells<Scalar>& cells,
                 const Path<Scalar>& path, const Scalar& z, const Scalar& t)
      : calculus_(calculus),
        pieces_(pieces),
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
    if constexpr (kKnowsPieces) {
      if (start_ == end_ && (!path_.turned || cells_.layer[path_.interface] == start_)) {
        pieces_.form[end_] == RateForm::linear ? in_linear_piece() : in_exponential_piece();
        move_boundaries();
        return std::move(out_);
      }
    }
    if (!is_state) out_.start = momentum(start_, path_.foot, is_set_up_);
    if (h_ == 0 && is_state) return pure();
    if (path_.foot == z_ && !path_.turned && !(is_state && kKnowsPieces)) return at_its_place(is_state);
    passes();
    if (path_.x == 0 && !is_state && !path_.turned)
      rest_on_the_way();
    else if (is_state && start_ == end_ && (!path_.turned || cells_.layer[path_.interface] == start_))
      phi_of_state_inside();
    else if (is_state)
      phi_of_state();
    else
      phi_of_fan();
    move_boundaries();
    return std::move(out_);
  }

 private:
  using Pair = typename PathGradient<Scalar>::Pair;

  /// A path inside one piece has closed forms of its own.
  static constexpr bool kKnowsPieces = std::is_same_v<Calculus, ParabolaCalculus<Scalar>>;

  [[nodiscard]] Scalar at(std::size_t k, const Scalar& z) const { return pieces_.rate(k, z); }
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
    const Scalar less = calculus_.less(k, at(k, z), upward);
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

  /// The run from one height to another.
  void add_run(const Scalar& from, const Scalar& to) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to);
    for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
      const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
      if (!(b > a)) continue;
      const RunParts<Scalar> by = calculus_.run(k, from < to, Scalar(b - a), at(k, a), at(k, b));
      T_h_ += by.T_h;
      time_ += by.T;
      const Scalar gain = h_ / Scalar(4);
      add_at(k, a, gain * by.J1, by.T1);
      add_at(k, b, gain * by.J2, by.T2);
    }
  }
  /// The jump at a boundary, passed upwards or downwards.
  void add_jump(std::size_t boundary, bool is_up) {
    const std::size_t below = boundary - 1;
    if (!calculus_.is_jump(below, boundary)) return;
    Pair& by = out_.boundaries[boundary - out_.first];
    by.M += calculus_.change(below, boundary, is_up);
    by.phi += calculus_.slowness(below, pieces_.high[below], is_up) -
              calculus_.slowness(boundary, pieces_.low[boundary], is_up);
  }
  /// Of the boundaries between two heights, `from` and `to` left out.
  void add_jumps(const Scalar& from, const Scalar& to) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to);
    for (std::size_t k = pieces_.piece_at(lo) + 1; k < pieces_.size() && pieces_.boundaries[k] < hi; ++k)
      if (pieces_.boundaries[k] > lo) add_jump(k, from < to);
  }
  void add_jump_at(const Scalar& z, bool is_up) {
    const std::size_t k = pieces_.piece_at(z);
    if (k > 0 && pieces_.boundaries[k] == z) add_jump(k, is_up);
  }

  /// The turn in piece j, beyond the height `from`.
  void add_turn(std::size_t j, const Scalar& from) {
    const TurnParts<Scalar> by = calculus_.turn(j, is_set_up_, at(j, from), from);
    time_ += by.T;
    T_h_ += by.T_h;
    Pair &by_near = number(j, !is_set_up_), &by_far = number(j, is_set_up_);
    by_far.M += by.M_far;
    by_near.M += by.M_near;
    add_at(j, from, Scalar(0), by.T_A);
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
    const Scalar by = calculus_.slowness(end_, at(end_, z_), path_.upward) / Scalar(-4);
    return path_.upward ? by : Scalar(-by);
  }
  [[nodiscard]] Scalar phi_by_rate() const { return -phi_by_h() * (h_ / at(end_, z_)); }

  void phi_of_fan() {
    const Scalar by_h = phi_by_h(), turn = -by_h / T_h_;  // dh = -dT / T_h
    for (Pair& pair : out_.pieces) pair.phi *= turn;
    for (Pair& pair : out_.boundaries) pair.phi *= turn;
    const Scalar slowness = calculus_.slowness(start_, at(start_, path_.foot), is_set_up_);
    out_.phi_start = turn * (is_set_up_ ? Scalar(-slowness) : slowness);
    out_.phi_log_scale = by_h * t_ / T_h_;
    add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// h = 4 g r(y) and T(y, h) = t with y free.
  void phi_of_state() {
    const Scalar &p0 = cells_.phi[path_.source], one(1), G = calculus_.height(start_, p0);
    const Scalar r = at(start_, path_.foot), speed = one / calculus_.slowness(start_, r, is_set_up_);
    const Scalar slope = slope_at(pieces_.form[start_], pieces_.bend[start_], r);
    const Scalar b = is_set_up_ ? slope : Scalar(-slope);
    const Scalar all = one - G * b * (speed * T_h_), by_h = phi_by_h();
    const Scalar turn = by_h * G * b * speed / all;
    for (Pair& pair : out_.pieces) pair.phi *= turn;
    for (Pair& pair : out_.boundaries) pair.phi *= turn;
    add_at(start_, path_.foot, Scalar(0), by_h * G / all);
    out_.phi_state = by_h * r * calculus_.height_slope(start_, p0, is_set_up_) / all;
    out_.phi_log_scale = -turn * t_;
    add_at(end_, z_, Scalar(0), phi_by_rate());
  }

  /// A state that has not left its piece: of a linear one with the slope b int dp / G rises by b t / 4, of an exponential one with
  /// r' / r = k, p by k r(z) G(p) t / 4.
  void phi_of_state_inside() {
    for (Pair& pair : out_.pieces) pair.phi = Scalar(0);
    for (Pair& pair : out_.boundaries) pair.phi = Scalar(0);
    const Scalar &p0 = cells_.phi[path_.source], &bend = pieces_.bend[end_], one(1),
                 width = pieces_.width(end_);
    const Scalar r = at(end_, z_), G = h_ / r, unit = t_ / Scalar(4);
    if (pieces_.form[end_] == RateForm::linear) {
      const Scalar G0 = calculus_.height(start_, p0);
      out_.phi_state = G0 > 0 ? Scalar(G / G0) : Scalar(r / at(end_, path_.foot));
      out_.phi_log_scale = unit * bend * G;
      number(end_, true).phi += unit * G / width;
      number(end_, false).phi -= unit * G / width;
      return;
    }
    const Scalar slope = calculus_.height_slope(end_, path_.p, path_.upward),
                 all = one / (one - unit * bend * r * slope), by_rate = unit * bend * G * all;
    out_.phi_state = all;
    out_.phi_log_scale = by_rate * r;
    add_at(end_, z_, Scalar(0), by_rate);
    // k = log(r_high / r_low) / width.
    const Scalar by_bend = unit * r * G * all / width;
    number(end_, true).phi += by_bend / pieces_.high[end_];
    number(end_, false).phi -= by_bend / pieces_.low[end_];
  }

  /// H is the least capacity on the way, where a path through a flux with a kink spends the time that is left.
  void rest_on_the_way() {
    for (Pair& pair : out_.pieces) pair.phi = Scalar(0);
    for (Pair& pair : out_.boundaries) pair.phi = Scalar(0);
    add_at(end_, z_, Scalar(0), phi_by_rate());
    const std::size_t lowest = std::min(start_, end_), highest = std::max(start_, end_);
    for (std::size_t k = lowest; k <= highest; ++k)
      for (const bool is_high : {false, true}) {
        if ((is_high ? pieces_.high[k] : pieces_.low[k]) != path_.r_reference) continue;
        number(k, is_high).M += (t_ - time_) / Scalar(4);
        number(k, is_high).phi += phi_by_h();
        return;
      }
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
    // H = r(y) g is conserved.
    out_.phi_state = at(start_, path_.foot) / at(end_, z_) * calculus_.pure_ratio(start_, end_, path_.upward);
    return std::move(out_);
  }

  /// A jump or a state at the peak in a flat piece, seen from its place: the path rests there.
  PathGradient<Scalar> at_its_place(bool is_state) {
    add_at(end_, z_, is_state ? Scalar(path_.H * t_ / at(end_, z_)) : Scalar(t_ / Scalar(4)), Scalar(0));
    if (is_state && start_ == end_)
      phi_of_state_inside();
    else if (is_state)
      out_.phi_state = Scalar(1);
    else
      out_.phi_start = calculus_.at_source(end_) / (at(end_, z_) * t_);
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
    add_run(path_.foot, z_w);
    add_jumps(path_.foot, z_w);
    add_run(z_w, z_);
    add_jumps(z_w, z_);
    for (Pair& pair : out_.pieces) pair.phi = Scalar(0);
    for (Pair& pair : out_.boundaries) pair.phi = Scalar(0);
    const bool is_still = calculus_.is_at_peak(end_, at(end_, z_), path_.upward);  // at the place of rest
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

  const Calculus& calculus_;
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
