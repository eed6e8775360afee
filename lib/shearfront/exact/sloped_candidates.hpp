// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_route.hpp"

namespace shearfront::exact {

/// The paths to (z, t), heights of the view, along a given route: those of a fan or of a constant state that take the time t.
template <Real Scalar>
class SlopedCandidates {
 public:
  SlopedCandidates(const SlopedView<Scalar>& view, const SlopedPlace<Scalar>& place, const Scalar& t,
                   const Scalar& upper, bool moving_only, Path<Scalar>& best)
      : view_(view),
        z_(place.z),
        t_(t),
        upper_(upper),
        moving_only_(moving_only),
        best_(best),
        n_(view.n_cells()),
        below_(place.below),
        above_(place.above),
        rate_below_(place.rate_below),
        rate_above_(place.rate_above) {
    slack_ = Scalar(64) * unit_roundoff<Scalar>() * (view.x.back() - view.x.front());
    const Scalar from = z_ - view.x[below_];
    pure_z_ = from > 0
                  ? Scalar(view.pure[below_] + Crossing<Scalar>(view.form[below_], from, view.low[below_],
                                                                Scalar(1), rate_below_, Scalar(1), Scalar(0))
                                                   .T)
                  : view.pure[below_];
    late_ = t * (Scalar(1) + Scalar(256) * unit_roundoff<Scalar>());
  }

 protected:
  using Route = SlopedRoute<Scalar>;
  using Sample = SlopedSample<Scalar>;

  [[nodiscard]] Scalar limit() const { return std::min(upper_, best_.value) + slack_; }
  [[nodiscard]] std::size_t true_cell(std::size_t cell) const {
    return view_.is_mirror ? n_ - 1 - cell : cell;
  }
  [[nodiscard]] std::size_t true_node(std::size_t node) const { return view_.is_mirror ? n_ - node : node; }

  /// Height gained, in the true orientation, from y up to `turn` and down to z (turn = z: straight to z > y).
  [[nodiscard]] Scalar gained(const Scalar& y, const Scalar& turn) const {
    return view_.is_mirror ? Scalar(turn - z_) : Scalar(turn - y);
  }

  void offer(const Scalar& value, const Scalar& h, PathKind kind, bool rises, bool turned, std::size_t source,
             const Scalar& y, std::size_t turn, const Scalar& least, const Scalar& qm) {
    if (!(value <= best_.value)) return;
    Path<Scalar> path;
    path.value = value;
    path.H = h / Scalar(4);
    path.kind = kind;
    path.upward = rises != view_.is_mirror;
    path.turned = turned;
    path.source = kind == PathKind::constant ? true_cell(source) : true_node(source);
    path.foot = view_.is_mirror ? Scalar(-y) : y;
    path.interface = turned ? true_cell(turn) : 0;
    path.r_reference = least;
    path.x = qm;
    path.p = Scalar(path.upward ? 1 : 0);  // settled by the medium
    if (path.better_than(best_)) best_ = path;
  }

  // Fans: h = 4 least w / (1 + w)^2, q_m = (1 - w) / (1 + w).
  [[nodiscard]] static Sample fan_sample(const Route& route, const Scalar& w) {
    const Scalar one(1), more = one + w;
    Sample s;
    s.v = w;
    s.qm = (one - w) / more;
    s.qm2 = s.qm * s.qm;
    s.h = Scalar(4) * route.least * w / (more * more);
    add_route(route, s);
    return s;
  }
  [[nodiscard]] static Scalar w_of(const Scalar& h, const Scalar& least) {
    using std::sqrt;
    if (!(h < least)) return Scalar(1);
    const Scalar more = Scalar(1) + sqrt(Scalar((least - h) / least));
    return h / (least * more * more);
  }
  [[nodiscard]] static Scalar fan_slope(const Route& route, const Sample& s) {
    const Scalar more = Scalar(1) + s.v;
    return s.F() * Scalar(4) * route.least / (more * more);
  }

  void finish_fan(const Route& route, std::size_t node, const Scalar& base, const Sample& s,
                  const Scalar& step, bool turned, std::size_t turn) {
    const Scalar one(1), w = std::clamp(Scalar(s.v + step), Scalar(0), one), more = one + w;
    const Scalar h = Scalar(4) * route.least * w / (more * more);
    const Scalar gap = t_ - s.T;
    const Scalar value = base + s.X + (s.h + (h - s.h) / Scalar(2)) / Scalar(4) * gap;
    offer(value, h, PathKind::fan, !turned, turned, node, view_.x[node], turn, route.least, (one - w) / more);
  }

  void straight_fan(const Route& route, std::size_t node) {
    const Scalar base = view_.M[node] + gained(view_.x[node], z_);
    if (base > limit()) return;  // L >= max(0, v)
    const Sample top = fan_sample(route, Scalar(1));
    if (is_finite(top.T)) {
      // Later it rests at the least rate on its way. Right then both are the path, and rounding must not drop both.
      if (top.T < t_ - Scalar(256) * unit_roundoff<Scalar>() * t_) return;
      if (base + top.X + top.h / Scalar(4) * (t_ - top.T) > limit()) return;
    }
    Sample zero;
    zero.T = pure_z_ - view_.pure[node];
    if (zero.T > late_) return;
    const auto at = [&](const Scalar& w) { return fan_sample(route, w); };
    const auto slope = [&](const Sample& s) { return fan_slope(route, s); };
    const auto found = [&](const Sample& s, const Scalar& step) {
      finish_fan(route, node, base, s, step, false, 0);
    };
    if (zero.T >= t_) {
      if (moving_only_) return;
      zero = at(Scalar(0));
      return finish_fan(route, node, base, zero, Scalar(0), false, 0);
    }
    SlopedRootSearch<Scalar, decltype(at), decltype(slope), decltype(found)>(t_, 1, at, slope, found)
        .solve(zero, top);
  }

  void turned_fan(const Route& route, std::size_t node, std::size_t j, const Scalar& lo, const Scalar& hi,
                  const Scalar& top) {
    const Scalar base = view_.M[node] + gained(view_.x[node], top);
    if (base > limit()) return;
    const auto at = [&](const Scalar& w) { return fan_sample(route, w); };
    const Sample a = at(w_of(lo, route.least));
    if (bound(base, a) > limit()) return;
    const Sample b = at(w_of(hi, route.least));
    const auto slope = [&](const Sample& s) { return fan_slope(route, s); };
    const auto found = [&](const Sample& s, const Scalar& step) {
      finish_fan(route, node, base, s, step, true, j);
    };
    SlopedRootSearch<Scalar, decltype(at), decltype(slope), decltype(found)>(t_, -1, at, slope, found)
        .run(a, b);
  }
  /// No path along the route with h above that of the sample costs less: H' t + int p dz at a smaller H'.
  [[nodiscard]] Scalar bound(const Scalar& base, const Sample& s) const {
    return base + (s.X - s.X_falling) + s.h / Scalar(4) * (t_ - (s.T - s.T_falling));
  }

  // States: h = 4 g r(y); the search runs over what r has lost since the end of its range where h is largest, or over its root
  // where h is the least rate there.
  enum class Leaves { upwards, downwards };
  struct StateRange {
    std::size_t cell;
    Leaves leaves;
    Scalar anchor, most_lost, qa2, kappa, rate;  ///< rate of r at the anchor
    bool is_capped, is_empty;
  };

  /// The height of a cell where r is `rate`, `lost` less than at the anchor.
  [[nodiscard]] Scalar start_of(const StateRange& range, const Scalar& lost) const {
    const std::size_t k = range.cell;
    return range.anchor + distance_of(view_.form[k], view_.bend[k], range.rate, Scalar(-lost));
  }

  [[nodiscard]] StateRange range_of(const Route& route, std::size_t k, Leaves leaves,
                                    const Scalar& h_low) const {
    const Scalar four_g = Scalar(4) * view_.p[k] * view_.missing[k], q2 = view_.q0[k] * view_.q0[k];
    const bool is_rising = view_.bend[k] > 0;
    const Scalar &most = is_rising ? view_.high[k] : view_.low[k],  // rate at the end with the largest h
        &end = is_rising ? view_.x[k + 1] : view_.x[k];
    // What r has lost where h is met: r - h / (4 g), and 4 g r - h = (r - h) - r q0^2 where g has lost what 1 - 4 g keeps.
    const auto lost_at = [&](const Scalar& h) {
      return q2 > Scalar(0.5) ? Scalar(most - h / four_g) : Scalar(((most - h) - most * q2) / four_g);
    };
    const Scalar first = lost_at(route.least);
    StateRange range{k, leaves, end, Scalar(0), Scalar(0), four_g / route.least, most, first >= 0, false};
    // By the bend: the rates at the ends of a part of a piece that is almost flat may be the same.
    const Scalar width = view_.x[k + 1] - view_.x[k];
    const Scalar over = -rise_of(view_.form[k], view_.bend[k], most, is_rising ? Scalar(-width) : width);
    const Scalar skip = std::max(Scalar(0), first), last = std::min(over, lost_at(h_low));
    range.is_empty = !(skip <= last);
    if (range.is_empty) return range;
    if (skip > 0) range.anchor = start_of(range, skip);
    range.rate = most - skip;
    range.most_lost = last - skip;
    if (!range.is_capped)
      range.qa2 = std::max(Scalar(0), Scalar(((route.least - most) + most * q2) / route.least));
    return range;
  }

  [[nodiscard]] Sample state_sample(const Route& route, const StateRange& range, const Scalar& v) const {
    using std::sqrt;
    const std::size_t k = range.cell;
    const Scalar lost = range.is_capped ? Scalar(v * v) : v;
    Sample s;
    s.v = v;
    s.y = start_of(range, lost);
    const Scalar r = range.rate - lost;
    s.h = Scalar(4) * view_.p[k] * view_.missing[k] * r;
    s.qm2 = range.qa2 + range.kappa * lost;
    s.qm = sqrt(s.qm2);
    add_route(route, s);
    const bool up = range.leaves == Leaves::upwards;
    const Scalar& exit = up ? view_.high[k] : view_.low[k];
    const Scalar d = up ? view_.x[k + 1] - s.y : s.y - view_.x[k];
    const Scalar q = exit == route.least ? s.qm : q_at(exit, route.least, s.qm2);
    const Crossing<Scalar> c(view_.form[k], std::max(Scalar(0), d), r, view_.q0[k], exit, q, s.h);
    s.T += c.T;
    s.X += c.X;
    const bool is_rising_h = up && view_.bend[k] < 0;
    add_start(route, k, q, is_rising_h, !up, s);
    if (!is_rising_h) s.T_falling += c.T;
    if (!up) {
      const Turn<Scalar> turn(view_.form[k], size_of_bend(k), r, view_.q0[k], s.h);
      s.T += turn.T;
      s.T_falling += turn.T;
      s.X += turn.X;
    }
    return s;
  }

  [[nodiscard]] Scalar size_of_bend(std::size_t k) const {
    return view_.bend[k] < 0 ? Scalar(-view_.bend[k]) : view_.bend[k];
  }

  /// dT/dh at fixed q0 of the way from the start to the end of its cell where q is `q`. Linear: T = +-(2 / b) (artanh q -+ artanh
  /// q0). Exponential: T = +-(2 / (k h)) (q -+ q0), in parts that are monotone.
  void add_start(const Route& route, std::size_t k, const Scalar& q, bool is_rising, bool turns,
                 Sample& s) const {
    const Scalar& exit = turns ? view_.low[k] : view_.high[k];
    const Scalar ratio = exit == route.least || !(q > 0) ? Scalar(1) : Scalar(s.qm / q);
    if (view_.form[k] == RateForm::linear) {
      (is_rising ? s.up : s.down) += ratio / (size_of_bend(k) * s.h);
      return;
    }
    const Scalar unit = Scalar(1) / (size_of_bend(k) * s.h * s.h);
    const Scalar of_end = ratio * (Scalar(1) + q * q) * unit,
                 of_start = Scalar(2) * view_.q0[k] * s.qm * unit;
    (is_rising ? s.up : s.down) += of_end;
    (is_rising || turns ? s.down : s.up) += of_start;
  }

  void search_state(const Route& route, const StateRange& range, int sign, const Scalar& top, bool turned,
                    std::size_t turn) {
    using std::sqrt;
    if (range.is_empty) return;
    const std::size_t k = range.cell;
    const auto at = [&](const Scalar& v) { return state_sample(route, range, v); };
    const auto slope = [&](const Sample& s) {
      const Scalar by = Scalar(-4) * view_.p[k] * view_.missing[k];
      return range.is_capped ? Scalar(s.F() * Scalar(2) * by / sqrt(range.kappa)) : Scalar(s.F() * by / s.qm);
    };
    const Scalar v_max = range.is_capped ? Scalar(sqrt(range.most_lost)) : range.most_lost;
    const auto found = [&](const Sample& s, const Scalar& step) {
      const Scalar v = std::clamp(Scalar(s.v + step), Scalar(0), v_max),
                   lost = range.is_capped ? Scalar(v * v) : v;
      const Scalar r = range.rate - lost, y = start_of(range, lost);
      const Scalar h = Scalar(4) * view_.p[k] * view_.missing[k] * r;
      const Scalar height = range.leaves == Leaves::downwards ? s.y : top;
      const Scalar value = view_.amount(k, s.y) + gained(s.y, height) + s.X +
                           (s.h + (h - s.h) / Scalar(2)) / Scalar(4) * (t_ - s.T);
      offer(value, h, PathKind::constant, !turned, turned, k, y, turn, route.least,
            sqrt(Scalar(range.qa2 + range.kappa * lost)));
    };
    const Sample b = at(Scalar(0)), a = at(v_max);
    SlopedRootSearch<Scalar, decltype(at), decltype(slope), decltype(found)>(t_, sign, at, slope, found)
        .run(a, b);
  }

  /// Where r is constant in cell k: h is given and the time linear in the start.
  void flat_state(Route& route, std::size_t k, const Scalar& top, bool turned, std::size_t turn,
                  const Scalar& h_low) {
    const Scalar &r = view_.low[k], &q0 = view_.q0[k];
    Sample s;
    s.h = view_.h(k, r);
    if (!(q0 > 0) || s.h < h_low) return;
    s.qm2 = ((route.least - r) + r * q0 * q0) / route.least;
    if (s.qm2 < 0) return;
    using std::sqrt;
    s.qm = sqrt(s.qm2);
    add_route(route, s);
    if (!(s.T <= late_)) return;
    const Scalar left = std::max(Scalar(0), Scalar(t_ - s.T)), speed = r * q0;
    Scalar d = left * speed;
    const Scalar width = view_.x[k + 1] - view_.x[k];
    if (d > width + slack_) return;
    d = std::min(d, width);
    const Crossing<Scalar> c(RateForm::linear, d, r, q0, r, q0, s.h);
    const Scalar y = view_.x[k + 1] - d;
    const Scalar value =
        view_.amount(k, y) + gained(y, top) + (s.X + c.X) + s.h / Scalar(4) * (t_ - (s.T + c.T));
    offer(value, s.h, PathKind::constant, !turned, turned, k, y, turn, route.least, s.qm);
  }

  const SlopedView<Scalar>& view_;
  Scalar z_, t_, upper_;
  bool moving_only_;
  Path<Scalar>& best_;
  std::size_t n_, below_, above_;
  Scalar rate_below_, rate_above_, slack_{0}, pure_z_{0}, late_{0};
};

}  // namespace shearfront::exact
