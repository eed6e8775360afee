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
    const auto time = [&](std::size_t cell, const Scalar& d, const Scalar& r1, const Scalar& r2) {
      return Crossing<Scalar>(view.form[cell], d, r1, Scalar(1), r2, Scalar(1), Scalar(0)).T;
    };
    time_below_ = time(below_, Scalar(z_ - view.x[below_]), view.low[below_], rate_below_);
    time_above_ = time(above_, Scalar(view.x[above_ + 1] - z_), rate_above_, view.high[above_]);
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

  /// `time`: of pure states along the route.
  void straight_fan(const Route& route, std::size_t node, const Scalar& time) {
    const Scalar base = view_.M[node] + gained(view_.x[node], z_);
    if (base > limit()) return;  // L >= max(0, v)
    const Sample top = fan_sample(route, Scalar(1));
    if (is_finite(top.T)) {
      if (top.T < t_) return;
      if (base + top.X + top.h / Scalar(4) * (t_ - top.T) > limit()) return;
    }
    Sample zero;
    zero.T = time;
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

  // States: h = 4 g r(y); the search runs over the part of the way from the end of its range where h is largest, or over its root
  // where h is the least rate there.
  enum class Leaves { upwards, downwards };

  /// A place in a cell by the rate there and the distances to the ends of the cell where r is largest and where it is least, of which
  /// the shorter in rate is what it is made of: where r is steep, one end knows nothing about the other.
  struct Place {
    Scalar rate, from_most, from_least;
    bool is_near_most;
  };
  struct StateRange {
    std::size_t cell;
    Leaves leaves;
    Place begin, end;                   ///< h is largest at the begin
    Scalar span, log_span, qa2, kappa;  ///< log_span: of r
    bool is_capped, is_empty;
  };

  /// Where in cell k a state has h, given what r has lost there since it is largest (at most half of it, or else not used).
  [[nodiscard]] Place place_of(std::size_t k, const Scalar& h, const Scalar& lost) const {
    const bool is_rising = view_.bend[k] > 0;
    const Scalar &most = is_rising ? view_.high[k] : view_.low[k],
                 &least = is_rising ? view_.low[k] : view_.high[k];
    const Scalar width = view_.x[k + 1] - view_.x[k], bend = size_of_bend(k), zero(0);
    if (lost + lost <= most) {
      const Scalar d = distance_of(view_.form[k], Scalar(-bend), most, Scalar(-lost));
      return {most - lost, d, std::max(zero, Scalar(width - d)), true};
    }
    const Scalar d = distance_of(view_.form[k], bend, least, gain_at(k, least, h));
    return {h / four_g(k), std::max(zero, Scalar(width - d)), d, false};
  }
  [[nodiscard]] Scalar four_g(std::size_t k) const { return Scalar(4) * view_.p[k] * view_.missing[k]; }
  /// What r has to gain from where it is `rate` for the state of cell k to have h: h / (4 g) - r, and 4 g r - h = (r - h) - r q0^2
  /// where g has lost what 1 - 4 g keeps.
  [[nodiscard]] Scalar gain_at(std::size_t k, const Scalar& rate, const Scalar& h) const {
    const Scalar q2 = view_.q0[k] * view_.q0[k];
    return q2 > Scalar(0.5) ? Scalar(h / four_g(k) - rate) : Scalar(((h - rate) + rate * q2) / four_g(k));
  }

  [[nodiscard]] StateRange range_of(const Route& route, std::size_t k, Leaves leaves,
                                    const Scalar& h_low) const {
    const bool is_rising = view_.bend[k] > 0;
    const Scalar &most = is_rising ? view_.high[k] : view_.low[k],
                 &least = is_rising ? view_.low[k] : view_.high[k];
    const Scalar width = view_.x[k + 1] - view_.x[k], zero(0);
    const Scalar first = -gain_at(k, most, route.least), last = -gain_at(k, most, h_low);
    StateRange range{k,
                     leaves,
                     {most, zero, width, true},
                     {least, width, zero, false},
                     width,
                     zero,
                     zero,
                     four_g(k) / route.least,
                     first >= 0,
                     last < 0};
    if (range.is_empty) return range;
    if (first > 0) range.begin = place_of(k, route.least, first);
    if (gain_at(k, least, h_low) > 0) range.end = place_of(k, h_low, last);
    if (range.begin.is_near_most == range.end.is_near_most)
      range.span = range.begin.is_near_most ? Scalar(range.end.from_most - range.begin.from_most)
                                            : Scalar(range.begin.from_least - range.end.from_least);
    else
      range.span = width - range.begin.from_most - range.end.from_least;
    range.is_empty = range.begin.from_most > width || range.begin.from_least < 0 || range.span < 0;
    using std::log1p;
    range.log_span = size_of_bend(k) * range.span;
    if (view_.form[k] == RateForm::linear) range.log_span = log1p(Scalar(range.log_span / range.end.rate));
    if (!range.is_capped)
      range.qa2 =
          std::max(zero, Scalar(((route.least - most) + most * view_.q0[k] * view_.q0[k]) / route.least));
    return range;
  }

  /// A start in a range, at the part v of it or v^2, by log r.
  struct Start {
    Scalar y, d, rate, h, lost;  ///< d: to where it leaves the cell; lost: what r is less than at the begin
  };
  [[nodiscard]] Start start_at(const StateRange& range, const Scalar& v) const {
    constexpr RateForm kLog = RateForm::exponential;
    const std::size_t k = range.cell;
    const Scalar one(1), part = range.is_capped ? Scalar(v * v) : v, rest = one - part;
    const Scalar from_begin = range.log_span * part, to_end = range.log_span * rest;
    const bool is_linear = view_.form[k] == RateForm::linear, is_up = range.leaves == Leaves::upwards,
               leaves_at_most = is_up == (view_.bend[k] > 0);
    Start start;
    start.lost = -rise_of(kLog, Scalar(-one), range.begin.rate, from_begin);
    start.rate = part < rest ? rate_beyond(kLog, Scalar(-one), range.begin.rate, from_begin)
                             : rate_beyond(kLog, one, range.end.rate, to_end);
    if (leaves_at_most)
      start.d = range.begin.from_most +
                (is_linear ? Scalar(start.lost / size_of_bend(k)) : Scalar(range.span * part));
    else
      start.d = range.end.from_least +
                (is_linear ? Scalar(rise_of(kLog, one, range.end.rate, to_end) / size_of_bend(k))
                           : Scalar(range.span * rest));
    start.h = four_g(k) * start.rate;
    start.y = std::clamp(is_up ? Scalar(view_.x[k + 1] - start.d) : Scalar(view_.x[k] + start.d), view_.x[k],
                         view_.x[k + 1]);
    return start;
  }
  /// d lost / dv of the same over q_m.
  [[nodiscard]] Scalar slope_of_start(const StateRange& range, const Sample& s) const {
    using std::sqrt;
    if (!range.is_capped) return s.rate * range.log_span / s.qm;
    const Scalar slope = (s.qm > 0 ? s.rate : range.begin.rate) * range.log_span;
    return Scalar(2) * slope *
           (s.qm > 0 ? Scalar(s.v / s.qm) : Scalar(Scalar(1) / sqrt(Scalar(range.kappa * slope))));
  }

  [[nodiscard]] Sample state_sample(const Route& route, const StateRange& range, const Scalar& v) const {
    using std::sqrt;
    const std::size_t k = range.cell;
    const Start start = start_at(range, v);
    Sample s;
    s.v = v;
    s.y = start.y;
    s.rate = start.rate;
    s.h = start.h;
    s.qm2 = range.qa2 + range.kappa * start.lost;
    s.qm = sqrt(s.qm2);
    add_route(route, s);
    const bool up = range.leaves == Leaves::upwards;
    const Scalar& exit = up ? view_.high[k] : view_.low[k];
    const Scalar q = exit == route.least ? s.qm : q_at(exit, route.least, s.qm2);
    const Crossing<Scalar> c(view_.form[k], start.d, s.rate, view_.q0[k], exit, q, s.h);
    s.T += c.T;
    s.X += c.X;
    const bool is_rising_h = up && view_.bend[k] < 0;
    add_start(route, k, q, is_rising_h, !up, s);
    if (!is_rising_h) s.T_falling += c.T;
    if (!up) {
      const Turn<Scalar> turn(view_.form[k], size_of_bend(k), s.rate, view_.q0[k], s.h);
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
    const auto slope = [&](const Sample& s) { return Scalar(-four_g(k) * s.F() * slope_of_start(range, s)); };
    const auto found = [&](const Sample& s, const Scalar& step) {
      const Start start = start_at(range, std::clamp(Scalar(s.v + step), Scalar(0), Scalar(1)));
      const Scalar height = range.leaves == Leaves::downwards ? s.y : top;
      const Scalar value = view_.amount(k, s.y) + gained(s.y, height) + s.X +
                           (s.h + (start.h - s.h) / Scalar(2)) / Scalar(4) * (t_ - s.T);
      offer(value, start.h, PathKind::constant, !turned, turned, k, start.y, turn, route.least,
            sqrt(Scalar(range.qa2 + range.kappa * start.lost)));
    };
    const Sample b = at(Scalar(0)), a = at(Scalar(1));
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
  Scalar rate_below_, rate_above_, slack_{0}, late_{0};
  Scalar time_below_, time_above_;  ///< of pure states from z to the ends of its cells
};

}  // namespace shearfront::exact
