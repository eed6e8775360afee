// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/sloped_starts.hpp"

namespace shearfront::exact {

/// The paths to (z, t), heights of the view, along a given route: those of a fan or of a constant state that take the time t. For
/// parabolas.
template <Real Scalar>
class SlopedCandidates : protected SlopedStarts<Scalar> {
 public:
  /// Paths inside one piece have closed forms.
  static constexpr bool kKnowsPieces = true;

  using SlopedStarts<Scalar>::SlopedStarts;

  [[nodiscard]] static bool has_bounds(std::size_t n_pieces) {
    return n_pieces >= SlopedStretches<Scalar>::kFew;
  }

 protected:
  using Base = SlopedStarts<Scalar>;
  using Base::above_, Base::gained, Base::late_, Base::limit, Base::moving_only_, Base::offer,
      Base::search_curved_cell, Base::size_of_bend, Base::slack_, Base::slope_of_start, Base::start_at,
      Base::t_, Base::view_, Base::w_of, Base::z_;
  using typename Base::CellState;
  using typename Base::Leaves;
  using typename Base::Range;
  using typename Base::Route;
  using typename Base::Sample;
  using typename Base::Start;
  using typename Base::StateRange;

  [[nodiscard]] Sample fan_sample(const Route& route, const Scalar& w) const {
    const Scalar one(1), more = one + w;
    Sample s;
    s.v = w;
    s.qm = (one - w) / more;
    s.lost = route.least * s.qm * s.qm;
    s.h = Scalar(4) * route.least * w / (more * more);
    add_route(view_, route, s);
    return s;
  }
  /// Of an h to the bit: next to where a path turns right at a node, rounding of h is 1e-8 in q.
  [[nodiscard]] Sample fan_sample_of(const Route& route, const Scalar& h) const {
    Sample s = this->fan_of(route, h);
    add_route(view_, route, s);
    return s;
  }
  [[nodiscard]] Scalar rounding(const Route& route, const Sample& s, bool is_state = false) const {
    const Scalar turn =
        route.turn_bend > 0
            ? Scalar(Scalar(4) / route.turn_bend / (route.turn_form == RateForm::linear ? Scalar(1) : s.h))
            : Scalar(0);
    return this->rounding_at_place(route, s, is_state, turn,
                                   [&](const auto& leg, const Scalar& q1, const Scalar& q2) {
                                     return Crossing<Scalar>(*leg.first, q1, q2, s.h).T;
                                   });
  }
  template <class At, class Slope, class Found>
  [[nodiscard]] auto search(int sign, const At& at, const Slope& slope, const Found& found,
                            const Route& route, bool is_state = false) const {
    const auto of = [this, &route, is_state](const Sample& s) { return rounding(route, s, is_state); };
    return SlopedRootSearch<Scalar, At, Slope, Found, decltype(of)>(t_, sign, at, slope, found, of);
  }
  /// t dw/dT.
  [[nodiscard]] Scalar fan_slope(const Sample& s) const { return t_ / s.F() * s.v; }

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
      // Later it rests at the least rate on its way. Right then both are the path, of the same cost, and rounding must not drop both.
      if (!is_within_rounding(Scalar(t_ - top.T), t_, [&] { return rounding(route, top); })) return;
      if (base + top.X + top.h / Scalar(4) * (t_ - top.T) > limit()) return;
    }
    Sample zero;
    zero.T = time;
    if (zero.T > late_) return;
    const auto at = [&](const Scalar& w) { return fan_sample(route, w); };
    const auto slope = [&](const Sample& s) { return fan_slope(s); };
    const auto found = [&](const Sample& s, const Scalar& by) {
      finish_fan(route, node, base, s, by, false, 0);
    };
    if (zero.T >= t_) {
      if (moving_only_) return;
      zero = at(Scalar(0));
      return finish_fan(route, node, base, zero, Scalar(0), false, 0);
    }
    search(1, at, slope, found, route).solve(zero, top);
  }

  void turned_fan(const Route& route, std::size_t node, std::size_t j, const Scalar& lo, const Scalar& hi,
                  const Scalar& top) {
    const Scalar base = view_.M[node] + gained(view_.x[node], top);
    if (base + view_.turn_times.least_cost(t_, node, above_, j, lo) > limit()) return;
    const auto at = [&](const Scalar& w) { return fan_sample(route, w); };
    const Sample a = fan_sample_of(route, lo);
    if (bound(base, a) > limit()) return;
    const Sample b = fan_sample_of(route, hi);
    const auto slope = [&](const Sample& s) { return fan_slope(s); };
    const auto found = [&](const Sample& s, const Scalar& by) {
      finish_fan(route, node, base, s, by, true, j);
    };
    search(-1, at, slope, found, route).run(a, b);
  }
  /// No path along the route with h above that of the sample costs less: H' t + int p dz at a smaller H'.
  [[nodiscard]] Scalar bound(const Scalar& base, const Sample& s) const {
    return base + (s.X - s.X_falling) + s.h / Scalar(4) * (t_ - s.T_rising);
  }

  /// The straight path of one fan along a route, from what its h is about, if Newton finds it at once between h_least and h_most: T
  /// rises with h, so there is no other.
  void fan_near(const Route& route, std::size_t node, const Scalar& h, const Scalar& h_least,
                const Scalar& h_most) {
    using std::sqrt;
    const Scalar close = sqrt(unit_roundoff<Scalar>()), most = w_of(h_most, route.least),
                 least = w_of(h_least, route.least);
    Scalar w = w_of(h, route.least);
    constexpr int kMost = 5;
    for (int n = 0; n < kMost; ++n) {
      if (!(w > 0 && w < Scalar(1))) return;
      const Sample s = fan_sample(route, w);
      if (!is_finite(s.T) || !(s.F() > 0)) return;
      const Scalar step = fan_slope(s) * ((t_ - s.T) / t_);
      if (!(w + step >= least && w + step <= most)) return;
      if ((step < 0 ? Scalar(-step) : step) > close * w) {
        w += step;
        continue;
      }
      return finish_fan(route, node, view_.M[node] + gained(view_.x[node], z_), s, step, false, 0);
    }
  }

  // Whether a time along a route may be t.
  using Stretches = SlopedStretches<Scalar>;
  [[nodiscard]] typename Stretches::Times turn_times(const Route& way, std::size_t j, const Range& h) const {
    return way.stretches.times_with_turn(h.least, h.most, way.turn_rate, view_.bends[j]);
  }
  [[nodiscard]] bool may_turn(const Route& way, std::size_t node, std::size_t j, const Range& h) const {
    return view_.turn_times.may_take(t_, node, above_, j, h.most, view_.low[j], false) &&
           turn_times(way, j, h).may_be(t_);
  }
  [[nodiscard]] bool may_turn_from_state(const Route& way, std::size_t j, std::size_t k,
                                         const Range& h) const {
    if (!view_.turn_times.may_take(t_, k + 1, above_, j, h.most, view_.low[j], true)) return false;
    auto times = turn_times(way, j, h);
    times.most += most_from_state(k, h);
    return times.may_be(t_);
  }
  [[nodiscard]] bool may_come_from_state(const Route& route, std::size_t k, const Range& h) const {
    auto times = route.stretches.times(h.least, h.most);
    times.most += most_from_state(k, h);
    return times.may_be(t_);
  }
  [[nodiscard]] bool may_turn_at_once(const Route& route, std::size_t k, const Range& h) const {
    auto times = route.stretches.times(h.least, h.most);
    times.most += Stretches::most_in_turn(h.least, view_.low[k], view_.bends[k]);
    return times.may_be(t_);
  }
  /// Most time from a start in cell k to its upper end.
  [[nodiscard]] Scalar most_from_state(std::size_t k, const Range& h) const {
    if (view_.is_curved(k))
      return Stretches::most_through(h.least, h.most, Scalar(view_.x[k + 1] - view_.x[k]),
                                     std::min(view_.low[k], view_.high[k]),
                                     std::max(view_.low[k], view_.high[k]), view_.bends[k]);
    if (view_.bend[k] == 0) return (view_.x[k + 1] - view_.x[k]) / (view_.low[k] * view_.q0[k]);
    return Stretches::most_from_state(h.least, h.most, view_.q0[k], view_.high[k], view_.bends[k]);
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
    const Scalar qm2 = range.qa2 + range.kappa * start.lost;
    s.qm = sqrt(qm2);
    s.lost = route.least * qm2;
    add_route(view_, route, s);
    const bool up = range.leaves == Leaves::upwards;
    const Scalar& exit = up ? view_.high[k] : view_.low[k];
    const Scalar q = exit == route.least ? s.qm : q_at(exit, route.least, s.lost);
    const Crossing<Scalar> c(view_.form[k], start.d, s.rate, view_.q0[k], exit, q, s.h);
    s.T += c.T;
    s.X += c.X;
    const bool is_rising_h = up && view_.bend[k] < 0;
    add_start(route, k, q, is_rising_h, !up, s);
    (is_rising_h ? s.T_rising : s.T_falling) += c.T;
    if (!up) {
      const Turn<Scalar> turn(view_.form[k], size_of_bend(k), s.rate, view_.q0[k], s.h);
      s.T += turn.T;
      s.T_falling += turn.T;
      s.X += turn.X;
    }
    return s;
  }

  /// h dT/dh at fixed q0 of the way from the start to the end of its cell where q is `q`. Linear: T = +-(2 / b) (artanh q -+ artanh
  /// q0). Exponential: T = +-(2 / (k h)) (q -+ q0), in parts that are monotone.
  void add_start(const Route& route, std::size_t k, const Scalar& q, bool is_rising, bool turns,
                 Sample& s) const {
    const Scalar& exit = turns ? view_.low[k] : view_.high[k];
    const Scalar ratio = exit == route.least || !(q > 0) ? Scalar(1) : Scalar(s.qm / q);
    if (view_.form[k] == RateForm::linear) {
      (is_rising ? s.up : s.down) += ratio / size_of_bend(k);
      return;
    }
    const Scalar unit = Scalar(1) / s.h / size_of_bend(k);
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
      return Scalar(-t_ / (s.F() * (slope_of_start(range, s) / s.rate)));
    };
    const auto found = [&](const Sample& s, const Scalar& by) {
      const Start start = start_at(range, std::clamp(Scalar(s.v + by), Scalar(0), Scalar(1)));
      const Scalar height = range.leaves == Leaves::downwards ? s.y : top;
      const Scalar value = view_.amount(k, s.y) + gained(s.y, height) + s.X +
                           (s.h + (start.h - s.h) / Scalar(2)) / Scalar(4) * (t_ - s.T);
      offer(value, start.h, PathKind::constant, !turned, turned, k, start.y, turn, route.least,
            sqrt(Scalar(range.qa2 + range.kappa * start.lost)));
    };
    const Sample b = at(Scalar(0)), a = at(Scalar(1));
    search(sign, at, slope, found, route, true).run(a, b);
  }

  /// Where r is constant in cell k: h is given and the time linear in the start.
  void flat_state(Route& route, std::size_t k, const Scalar& top, bool turned, std::size_t turn,
                  const Scalar& h_low) {
    const Scalar &r = view_.low[k], &q0 = view_.q0[k];
    Sample s;
    s.h = view_.h(k, r);
    if (!(q0 > 0) || s.h < h_low) return;
    s.lost = (route.least - r) + r * q0 * q0;
    if (s.lost < 0) return;
    using std::sqrt;
    s.qm = sqrt(Scalar(s.lost / route.least));
    add_route(view_, route, s);
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

  void search_curved(const Route& route, std::size_t k, bool leaves_up, const Scalar& h_low,
                     const Scalar& top, bool turned, std::size_t turn) {
    search_curved_cell(route, k, leaves_up, h_low, top, turned, turn, [&](const CellState& from, Sample& s) {
      add_route(view_, route, s);
      const Scalar& exit = leaves_up ? view_.high[k] : view_.low[k];
      const Scalar d = leaves_up ? view_.x[k + 1] - s.y : s.y - view_.x[k];
      const Scalar q = exit == route.least ? s.qm : q_at(exit, route.least, s.lost);
      if (d > 0) {
        const Crossing<Scalar> c(view_.form[k], d, s.rate, from.q0, exit, q, s.h);
        s.T += c.T;
        s.X += c.X;
      }
      if (leaves_up) return;
      const Turn<Scalar> turned_here(view_.form[k], size_of_bend(k), s.rate, from.q0, s.h);
      s.T += turned_here.T;
      s.X += turned_here.X;
    });
  }
};

}  // namespace shearfront::exact
