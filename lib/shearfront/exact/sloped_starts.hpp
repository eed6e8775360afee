// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_curved.hpp"
#include "shearfront/exact/sloped_place.hpp"
#include "shearfront/exact/sloped_route.hpp"

namespace shearfront::exact {

/// What the search for paths to (z, t), heights of the view, knows of their starts, whatever the flux: where in its cell a state
/// has which h, and which path is the best so far.
template <Real Scalar>
class SlopedStarts {
 public:
  SlopedStarts(const SlopedView<Scalar>& view, const SlopedPlace<Scalar>& place, const Scalar& t,
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
        rate_above_(place.rate_above),
        down_(place.down),
        up_(place.up),
        time_below_(place.time_below),
        time_above_(place.time_above),
        back_above_(place.back_above) {
    slack_ = Scalar(64) * unit_roundoff<Scalar>() * (view.x.back() - view.x.front());
    late_ = t * (Scalar(1) + Scalar(256) * unit_roundoff<Scalar>());
  }
  /// Only paths that start from `least` to `most`, heights of the view.
  void start_between(const Scalar& least, const Scalar& most) {
    least_start_ = least;
    most_start_ = most;
  }

 protected:
  using Route = SlopedRoute<Scalar>;
  using Sample = SlopedSample<Scalar>;

  [[nodiscard]] Scalar limit() const { return std::min(upper_, best_.value) + slack_; }
  [[nodiscard]] bool may_start_at(std::size_t node) const {
    return !(view_.x[node] < least_start_) && !(view_.x[node] > most_start_);
  }
  [[nodiscard]] bool may_start_in(std::size_t cell) const {
    return !(view_.x[cell + 1] < least_start_) && !(view_.x[cell] > most_start_);
  }
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
    if (!(value <= best_.value) || !is_finite(value)) return;  // not from a time that is none
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

  /// What rounding of z and of the rate there makes of the time of a route, whose runs from z `time_of` gives and whose turn there is
  /// `turn` times a change of q: T is that of a change of q over the sum of both q, and 1 / (r q) for each height. The h of a
  /// state is known to rounding, that of a fan exactly.
  template <class TimeOf>
  [[nodiscard]] Scalar rounding_at_place(const Route& route, const Sample& s, bool is_state,
                                         const Scalar& turn, const TimeOf& time_of) const {
    using std::sqrt;
    const Scalar few = Scalar(128) * unit_roundoff<Scalar>();
    const auto change = [&](const Scalar& q) { return q * q > few ? Scalar(few / q) : Scalar(sqrt(few)); };
    const Scalar& rate = std::min(rate_below_, rate_above_);
    const Scalar q_here = std::max(q_at(rate, route.least, s.lost), Scalar(sqrt(few)));
    Scalar all = few * (z_ < 0 ? Scalar(-z_) : z_) / (rate * q_here);
    if (is_state && is_finite(s.T)) {
      const Scalar q = std::min(q_here, std::max(s.qm, Scalar(sqrt(few))));
      all += Scalar(2) * s.T * change(q) / q;
    }
    for (const auto* leg : {&route.once, &route.twice}) {
      if (leg->n_cells == 0 || (leg->first != &up_ && leg->first != &down_)) continue;
      const Scalar q1 = q_at(leg->first->r1, route.least, s.lost),
                   q2 = q_at(leg->first->r2, route.least, s.lost);
      if (q1 + q2 > 0) all += Scalar(2) * time_of(*leg, q1, q2) * change(q1) / (q1 + q2);
    }
    if (route.turn_bend > 0 && route.twice.n_cells == 0 && route.twice.first == &up_)
      all += turn * change(q_at(route.turn_rate, route.least, s.lost));
    return all;
  }

  // Fans: h = 4 least w / (1 + w)^2, q_m = (1 - w) / (1 + w).
  [[nodiscard]] static Scalar w_of(const Scalar& h, const Scalar& least) {
    using std::sqrt;
    if (!(h < least)) return Scalar(1);
    const Scalar more = Scalar(1) + sqrt(Scalar((least - h) / least));
    return h / (least * more * more);
  }
  /// What a sample of a fan has before its route is added.
  [[nodiscard]] static Sample fan_of(const Route& route, const Scalar& h) {
    using std::sqrt;
    Sample s;
    s.v = w_of(h, route.least);
    s.h = h;
    s.lost = std::max(Scalar(0), Scalar(route.least - h));
    s.qm = sqrt(Scalar(s.lost / route.least));
    return s;
  }
  struct Range {
    Scalar least, most;
  };

  /// H = 0: the time from the start is int dz / r, over the speed of the pure state at the rate 1.
  void pure_state(std::size_t k, const Scalar& time) {
    using std::expm1;
    using std::log1p;
    if (moving_only_) return;
    // By time, as the cells beside this one: in a thin cell heights within rounding may be far away in time.
    if (time > late_ || (t_ - time) - view_.pure_time[k] > late_ - t_) return;
    Scalar left = t_ - time;
    if (view_.fluxes) {
      const LawSide<Scalar> side = view_.side(k, true);
      left *= side.slope({side.reach(), Scalar(0)}) / Scalar(4);
    }
    const Scalar &b = view_.bend[k], x = -b * left, way = view_.high[k] * left;
    Scalar d = way;
    if (view_.form[k] == RateForm::exponential) {
      const Scalar lost = b * way;
      d = lost > Scalar(-1) ? Scalar(log1p(lost) / b) : infinity<Scalar>();
    } else if (x != 0) {
      d = way * (expm1(x) / x);
    }
    const Scalar width = view_.x[k + 1] - view_.x[k];
    const Scalar y = view_.x[k + 1] - std::clamp(d, Scalar(0), width);
    offer(view_.amount(k, y) + gained(y, z_), Scalar(0), PathKind::constant, true, false, k, y, 0,
          view_.high[k], Scalar(1));
  }

  // States: h = G r(y); the search runs over the part of the way from the end of its range where h is largest, or over its root
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
    return {h / view_.G0[k], std::max(zero, Scalar(width - d)), d, false};
  }
  /// What r has to gain from where it is `rate` for the state of cell k to have h: h / G - r, and G r - h = (r - h) - r (1 - G) where G
  /// has lost what 1 - G keeps.
  [[nodiscard]] Scalar gain_at(std::size_t k, const Scalar& rate, const Scalar& h) const {
    const Scalar& q2 = view_.e0[k];
    return q2 > Scalar(0.5) ? Scalar(h / view_.G0[k] - rate) : Scalar(((h - rate) + rate * q2) / view_.G0[k]);
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
                     view_.G0[k] / route.least,
                     first >= 0,
                     last < 0};
    if (range.is_empty) return range;
    if (first > 0) range.begin = place_of(k, route.least, first);
    if (gain_at(k, least, h_low) > 0) range.end = place_of(k, h_low, last);
    narrow(range);
    if (range.begin.is_near_most == range.end.is_near_most)
      range.span = range.begin.is_near_most ? Scalar(range.end.from_most - range.begin.from_most)
                                            : Scalar(range.begin.from_least - range.end.from_least);
    else
      range.span = width - range.begin.from_most - range.end.from_least;
    range.is_empty = range.begin.from_most > width || range.begin.from_least < 0 || range.span < 0;
    using std::log1p;
    range.log_span = size_of_bend(k) * range.span;
    if (view_.form[k] == RateForm::linear) range.log_span = log1p(Scalar(range.log_span / range.end.rate));
    if (!range.is_capped) {
      const Scalar& rate = range.begin.rate;
      range.qa2 = std::max(zero, Scalar(((route.least - rate) + rate * view_.e0[k]) / route.least));
    }
    return range;
  }
  /// To the starts that are asked for.
  void narrow(StateRange& range) const {
    const std::size_t k = range.cell;
    const Scalar &bottom = view_.x[k], &top = view_.x[k + 1];
    if (!(least_start_ > bottom) && !(most_start_ < top)) return;
    const bool is_rising = view_.bend[k] > 0;
    const Scalar &most = is_rising ? view_.high[k] : view_.low[k],
                 &least = is_rising ? view_.low[k] : view_.high[k];
    const Scalar width = top - bottom, bend = size_of_bend(k);
    const auto place = [&](const Scalar& from_most, const Scalar& from_least) -> Place {
      return from_most < from_least ? Place{rate_beyond(view_.form[k], Scalar(-bend), most, from_most),
                                            from_most, Scalar(width - from_most), true}
                                    : Place{rate_beyond(view_.form[k], bend, least, from_least),
                                            Scalar(width - from_least), from_least, false};
    };
    const Scalar below = least_start_ - bottom, above = top - most_start_;  // what is left out on both sides
    const Scalar &from_most = is_rising ? above : below, &from_least = is_rising ? below : above;
    if (from_most > range.begin.from_most) {
      range.begin = place(from_most, Scalar(width - from_most));
      range.is_capped = false;
    }
    if (from_least > range.end.from_least) range.end = place(Scalar(width - from_least), from_least);
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
    start.h = view_.G0[k] * start.rate;
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

  // Cells of a smooth start.
  using CellState = typename SlopedView<Scalar>::State;
  [[nodiscard]] Range h_of_curved(std::size_t k) const {
    const Scalar &least = std::min(view_.low[k], view_.high[k]),
                 &most = std::max(view_.low[k], view_.high[k]);
    const CellState a = view_.state_of(k, view_.p[k], view_.missing[k]),
                    b = view_.state_of(k, view_.p_high[k], Scalar(Scalar(1) - view_.p_high[k]));
    const bool has_peak = (a.q0 < 0) != (b.q0 < 0);
    return {std::min(a.G, b.G) * least, (has_peak ? Scalar(1) : std::max(a.G, b.G)) * most};
  }
  /// From the heights of curved cell k whose paths come along the route at the time t and have an h of at least `h_low`. `add_way`
  /// adds to a sample, given the state at its start, the route and the way in the cell: to its top, or turning and to its bottom.
  template <class AddWay>
  void search_curved_cell(const Route& route, std::size_t k, bool leaves_up, const Scalar& h_low,
                          const Scalar& top, bool turned, std::size_t turn, const AddWay& add_way) {
    const auto at = [&](const Scalar& y) { return view_.state_at(k, y); };
    const auto h = [&](const Scalar& y) { return Scalar(at(y).G * view_.rate(k, y)); };
    // Empty where the state moves the other way, or its h does not fit.
    const auto from = [&](const Scalar& y) -> std::optional<Sample> {
      using std::sqrt;
      const CellState state = at(y);
      Sample s;
      s.y = y;
      s.rate = view_.rate(k, y);
      s.h = state.G * s.rate;
      if (state.q0 < 0 || s.h > route.least || s.h < h_low) return std::nullopt;
      if (s.h == 0 && (!leaves_up || route.turn_bend > 0)) {  // a pure state does not turn
        s.T = infinity<Scalar>();
        return s;
      }
      s.lost = std::max(Scalar(0), Scalar((route.least - s.rate) + s.rate * state.lack));
      s.qm = sqrt(Scalar(s.lost / route.least));
      add_way(state, s);
      return s;
    };
    const auto late = [&](const Scalar& y) -> std::optional<Scalar> {
      const auto s = from(y);
      return s ? std::optional(Scalar(s->T - t_)) : std::nullopt;
    };
    const auto found = [&](const Scalar& y) {
      const auto s = from(y);
      if (!s || !is_finite(s->T) || (moving_only_ && s->h == 0)) return;
      const Scalar value =
          view_.amount(k, y) + gained(y, leaves_up ? top : y) + s->X + s->h / Scalar(4) * (t_ - s->T);
      offer(value, s->h, PathKind::constant, !turned, turned, k, y, turn, route.least, s->qm);
    };
    // On both sides of its crest h is monotone.
    const auto search = [&](Scalar lo, Scalar hi) {
      if (lo < hi && keep_where<Scalar>([&](const Scalar& y) { return at(y).q0; }, lo, hi) &&
          keep_where<Scalar>([&](const Scalar& y) { return Scalar(route.least - h(y)); }, lo, hi) &&
          keep_where<Scalar>([&](const Scalar& y) { return Scalar(h(y) - h_low); }, lo, hi))
        sign_changes<Scalar>(late, lo, hi, found);
    };
    const Scalar least = std::max(view_.x[k], least_start_), most = std::min(view_.x[k + 1], most_start_);
    search(least, std::min(view_.crest[k], most));
    search(std::max(view_.crest[k], least), most);
  }

  [[nodiscard]] Scalar size_of_bend(std::size_t k) const {
    return view_.bend[k] < 0 ? Scalar(-view_.bend[k]) : view_.bend[k];
  }

  const SlopedView<Scalar>& view_;
  Scalar z_, t_, upper_;
  bool moving_only_;
  Path<Scalar>& best_;
  std::size_t n_, below_, above_;
  Scalar rate_below_, rate_above_;
  RunEnds<Scalar> down_, up_;                    ///< from z to the ends of its cells
  Scalar time_below_, time_above_, back_above_;  ///< of pure states from z to the ends of its cells
  Scalar slack_{0}, late_{0};
  Scalar least_start_ = -infinity<Scalar>(), most_start_ = infinity<Scalar>();
};

}  // namespace shearfront::exact
