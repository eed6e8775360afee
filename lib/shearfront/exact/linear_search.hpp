// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/linear_bed.hpp"
#include "shearfront/exact/linear_route.hpp"
#include "shearfront/exact/path.hpp"

namespace shearfront::exact {

/// The best path to (z, t), heights of the view, among those that set out upwards in the view and leave their first cell,
/// and those inside one cell.
template <Real Scalar>
class LinearSearch {
 public:
  LinearSearch(const LinearView<Scalar>& view, const Scalar& z, const Scalar& t, const Scalar& upper,
               bool moving_only, Path<Scalar>& best)
      : view_(view), z_(z), t_(t), upper_(upper), moving_only_(moving_only), best_(best), n_(view.n_cells()) {
    const auto it = std::upper_bound(view.x.begin() + 1, view.x.end() - 1, z);
    above_ = static_cast<std::size_t>(it - view.x.begin()) - 1;
    below_ = above_ > 0 && z == view.x[above_] ? above_ - 1 : above_;
    rate_below_ = view.rate(below_, z);
    rate_above_ = view.rate(above_, z);
    slack_ = Scalar(64) * unit_roundoff<Scalar>() * (view.x.back() - view.x.front());
    const Scalar from = z - view.x[below_];
    pure_z_ =
        from > 0
            ? Scalar(view.pure[below_] +
                     Crossing<Scalar>(from, view.low[below_], Scalar(1), rate_below_, Scalar(1), Scalar(0)).T)
            : view.pure[below_];
    late_ = t * (Scalar(1) + Scalar(256) * unit_roundoff<Scalar>());
  }

  void run() {
    for (const std::size_t cell : {below_, above_}) {
      inside(cell);
      if (below_ == above_) break;
    }
    from_below();
    from_above();
  }

 private:
  using Route = LinearRoute<Scalar>;
  using Sample = LinearSample<Scalar>;

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

  /// In closed form: the state of a cell (in the upright view only), the fan of its lower node.
  void inside(std::size_t cell) {
    const Scalar& r = cell == below_ ? rate_below_ : rate_above_;
    const LinearDrift<Scalar> drift(view_.slope[cell], t_);
    if (!(drift.B > 0)) return;
    const Scalar half(0.5), tolerance = slack_;
    const auto accept = [&](const LinearArc<Scalar>& arc, const Scalar& y, PathKind kind, std::size_t source,
                            const Scalar& M0) {
      const Scalar h = Scalar(4) * r * arc.p * arc.missing;
      const bool is_fan = kind == PathKind::fan, ends_up = arc.p > half;
      const bool starts_up = is_fan || arc.start_odds > Scalar(1),
                 starts_down = !is_fan && arc.start_odds < Scalar(1);
      if (starts_up && !ends_up && h < view_.high[cell]) return;
      if (starts_down && ends_up && h < view_.low[cell]) return;
      const bool turned = h > 0 && (ends_up ? starts_down : starts_up);
      const Scalar q = ends_up ? Scalar(arc.p - arc.missing) : Scalar(arc.missing - arc.p);
      offer(M0 + (view_.is_mirror ? arc.down : arc.up), h, kind, ends_up, turned, source, y, cell, r, q);
    };
    if (!view_.is_mirror && !(moving_only_ && (view_.p[cell] == 0 || view_.missing[cell] == 0))) {
      const auto arc = LinearArc<Scalar>::from_state(drift, view_.p[cell], view_.missing[cell], r);
      const Scalar y = z_ - (arc.up - arc.down);
      if (is_finite(y) && y >= view_.x[cell] - tolerance && y <= view_.x[cell + 1] + tolerance) {
        const Scalar kept = std::clamp(y, view_.x[cell], view_.x[cell + 1]);
        accept(arc, kept, PathKind::constant, cell, view_.amount(cell, y));
      }
    }
    if (cell > 0 && view_.emits[cell]) {
      const auto arc = LinearArc<Scalar>::from_point(drift, z_ - view_.x[cell], view_.low[cell], r);
      const Scalar one(1), edge = one / Scalar(1 << 20);
      if (arc.p >= 0 && arc.missing >= 0 && arc.start_odds >= one - edge)
        accept(arc, view_.x[cell], PathKind::fan, cell, view_.M[cell]);
    }
  }

  /// Everything that starts below z and leaves its cell at the top.
  void from_below() {
    Route route;
    if (below_ != above_) turned_states(route, below_, z_, above_, rate_above_);
    route.add(z_ - view_.x[below_], rate_below_, view_.low[below_], false);
    for (std::size_t k = below_; k-- > 0;) {
      // Node k + 1, and the state of the cell below it.
      const std::size_t node = k + 1;
      if (pure_z_ - view_.pure[node] > late_) return;
      if (view_.emits[node]) {
        const bool is_own = node == below_;  // no farther than its cell: in closed form
        if (!is_own) straight_fan(route, node);
        turned_fans(route, node, z_, above_, rate_above_, is_own && below_ == above_);
      }
      state(route, k);
      turned_states(route, k, z_, above_, rate_above_);
      route.add(view_.x[node] - view_.x[k], view_.high[k], view_.low[k], false);
    }
  }

  /// Everything that starts at or above z, sets out upwards and turns.
  void from_above() {
    Route route;
    if (z_ == view_.x[above_] && above_ > 0 && view_.emits[above_])
      turned_fans(route, above_, z_, above_, rate_above_, true);
    for (std::size_t k = above_; k < n_; ++k) {
      // Cell k: its state turns in it and leaves it at the bottom, or leaves it at the top; then its upper node.
      if (k > above_ || z_ == view_.x[k]) state_that_turns_at_once(route, k);
      if (k == above_)
        route.add(view_.x[k + 1] - z_, rate_above_, view_.high[k], false);
      else
        route.add(view_.x[k + 1] - view_.x[k], view_.low[k], view_.high[k], false);
      const std::size_t node = k + 1;
      if (node == n_ || view_.pure[node] - pure_z_ > late_) return;
      turned_states(route, k, view_.x[node], node, view_.low[node]);
      if (view_.emits[node]) turned_fans(route, node, view_.x[node], node, view_.low[node], false);
    }
  }

  [[nodiscard]] bool has_moving_state(std::size_t k) const {
    return view_.p[k] > 0 && view_.missing[k] > 0 &&
           (view_.q0[k] > 0 || (view_.q0[k] == 0 && view_.slope[k] > 0));
  }

  void turned_fans(const Route& once, std::size_t node, const Scalar& from, std::size_t first,
                   const Scalar& rate, bool skip_first) {
    turns(once, view_.M[node], node, from, first, rate, skip_first,
          [&](Route& way, std::size_t j, const Scalar& lo, const Scalar& hi, const Scalar& top) {
            turned_fan(way, node, j, lo, hi, top);
          });
  }
  void turned_states(const Route& once, std::size_t k, const Scalar& from, std::size_t first,
                     const Scalar& rate) {
    if (!has_moving_state(k)) return;
    turns(once, view_.least_amount(k), k + 1, from, first, rate, false,
          [&](Route& way, std::size_t j, const Scalar& lo, const Scalar& hi, const Scalar& top) {
            turned_state(way, k, j, lo, hi, top);
          });
  }

  /// Calls found(route, j, least h, largest h, height above which it turns) for every cell j, `first` and above, in which
  /// paths can turn that pass `node` upwards, with M0 at their start, and have `once` to pass besides.
  template <class Found>
  void turns(const Route& once, const Scalar& M0, std::size_t node, const Scalar& from, std::size_t first,
             const Scalar& rate, bool skip_first, const Found& found) {
    Route& way = scratch_;
    way.runs.assign(once.runs.begin(), once.runs.end());
    way.least = once.least;
    way.turn_slope = Scalar(0);
    for (std::size_t j = first; j < n_; ++j) {
      const Scalar &entry = j == first ? rate : view_.low[j], &height = j == first ? from : view_.x[j];
      // Out of reach, or dearer than what there is: the height is gained, on one of both ways.
      if (j > first && Scalar(2) * view_.pure[j] - view_.pure[node] - pure_z_ > late_) return;
      if (M0 + gained(view_.x[node], height) > limit()) return;
      const Scalar least = std::min(way.least, entry);
      if (view_.slope[j] < 0 && view_.high[j] < least && !(j == first && skip_first)) {
        const Scalar kept = way.least;
        way.least = least;
        way.turn_slope = -view_.slope[j];
        way.turn_rate = entry;
        found(way, j, view_.high[j], least, height);
        way.least = kept;
        way.turn_slope = Scalar(0);
      }
      way.add(view_.x[j + 1] - height, entry, view_.high[j], true);
      way.least = std::min({way.least, entry, view_.high[j]});
    }
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
      if (top.T < t_) return;
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
    LinearRootSearch<Scalar, decltype(at), decltype(slope), decltype(found)>(t_, 1, at, slope, found)
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
    LinearRootSearch<Scalar, decltype(at), decltype(slope), decltype(found)>(t_, -1, at, slope, found)
        .run(a, b);
  }
  /// No path along the route with h above that of the sample costs less: H' t + int p dz at a smaller H'.
  [[nodiscard]] Scalar bound(const Scalar& base, const Sample& s) const {
    return base + (s.X - s.X_falling) + s.h / Scalar(4) * (t_ - (s.T - s.T_falling));
  }

  // States: h = 4 g r(y); the search runs over the distance e of the start from the end of its range where h is largest, or over
  // its root where h is the least rate there.
  enum class Leaves { upwards, downwards };
  struct StateRange {
    std::size_t cell;
    Leaves leaves;
    Scalar anchor, e_max, qa2, kappa, rate;  ///< rate of r at the anchor
    bool is_capped, is_empty;
  };

  [[nodiscard]] StateRange range_of(const Route& route, std::size_t k, Leaves leaves,
                                    const Scalar& h_low) const {
    const Scalar four_g = Scalar(4) * view_.p[k] * view_.missing[k], &b = view_.slope[k],
                 q2 = view_.q0[k] * view_.q0[k];
    const Scalar slope = b < 0 ? Scalar(-b) : b, width = view_.x[k + 1] - view_.x[k];
    const Scalar& most = b > 0 ? view_.high[k] : view_.low[k];  // rate at the end with the largest h
    // 4 g r - h = (r - h) - r q0^2, over the slope of 4 g r: where h is met.
    const auto place = [&](const Scalar& h) { return Scalar(((most - h) - most * q2) / (four_g * slope)); };
    const Scalar first = place(route.least);
    StateRange range{k,         leaves,     Scalar(0), Scalar(0), Scalar(0), four_g * slope / route.least,
                     Scalar(0), first >= 0, false};
    const Scalar skip = std::max(Scalar(0), first), last = std::min(width, place(h_low));
    range.is_empty = !(skip <= last);
    range.anchor = b > 0 ? Scalar(view_.x[k + 1] - skip) : Scalar(view_.x[k] + skip);
    range.rate = most - slope * skip;
    range.e_max = last - skip;
    if (!range.is_capped)
      range.qa2 = std::max(Scalar(0), Scalar(((route.least - most) + most * q2) / route.least));
    return range;
  }

  [[nodiscard]] Sample state_sample(const Route& route, const StateRange& range, const Scalar& v) const {
    using std::sqrt;
    const std::size_t k = range.cell;
    const Scalar& b = view_.slope[k];
    const Scalar slope = b < 0 ? Scalar(-b) : b, e = range.is_capped ? Scalar(v * v) : v;
    Sample s;
    s.v = v;
    s.y = b > 0 ? Scalar(range.anchor - e) : Scalar(range.anchor + e);
    const Scalar r = range.rate - slope * e;
    s.h = Scalar(4) * view_.p[k] * view_.missing[k] * r;
    s.qm2 = range.qa2 + range.kappa * e;
    s.qm = sqrt(s.qm2);
    add_route(route, s);
    const bool up = range.leaves == Leaves::upwards;
    const Scalar& exit = up ? view_.high[k] : view_.low[k];
    const Scalar d = up ? view_.x[k + 1] - s.y : s.y - view_.x[k];
    const Scalar q = exit == route.least ? s.qm : q_at(exit, route.least, s.qm2);
    const Crossing<Scalar> c(std::max(Scalar(0), d), r, view_.q0[k], exit, q, s.h);
    s.T += c.T;
    s.X += c.X;
    const Scalar by = (exit == route.least || !(q > 0) ? Scalar(1) : Scalar(s.qm / q)) / (slope * s.h);
    if (up && b < 0) {
      s.up += by;
    } else {
      s.down += by;
      s.T_falling += c.T;
    }
    if (!up) {
      const Scalar turn = Scalar(4) / slope * artanh_of(view_.q0[k], r, s.h);
      s.T += turn;
      s.T_falling += turn;
      s.X += r * view_.q0[k] / slope;
    }
    return s;
  }

  void search_state(const Route& route, const StateRange& range, int sign, const Scalar& top, bool turned,
                    std::size_t turn) {
    using std::sqrt;
    if (range.is_empty) return;
    const std::size_t k = range.cell;
    const auto at = [&](const Scalar& v) { return state_sample(route, range, v); };
    const auto slope = [&](const Sample& s) {
      const Scalar by = Scalar(-4) * view_.p[k] * view_.missing[k] *
                        (view_.slope[k] < 0 ? Scalar(-view_.slope[k]) : view_.slope[k]);
      return range.is_capped ? Scalar(s.F() * Scalar(2) * by / sqrt(range.kappa)) : Scalar(s.F() * by / s.qm);
    };
    const auto found = [&](const Sample& s, const Scalar& step) {
      const Scalar v_max = range.is_capped ? Scalar(sqrt(range.e_max)) : range.e_max;
      const Scalar v = std::clamp(Scalar(s.v + step), Scalar(0), v_max),
                   e = range.is_capped ? Scalar(v * v) : v;
      const Scalar& b = view_.slope[k];
      const Scalar r = range.rate - (b < 0 ? Scalar(-b) : b) * e;
      const Scalar y = b > 0 ? Scalar(range.anchor - e) : Scalar(range.anchor + e);
      const Scalar h = Scalar(4) * view_.p[k] * view_.missing[k] * r;
      const Scalar height = range.leaves == Leaves::downwards ? s.y : top;
      const Scalar value = view_.amount(k, s.y) + gained(s.y, height) + s.X +
                           (s.h + (h - s.h) / Scalar(2)) / Scalar(4) * (t_ - s.T);
      offer(value, h, PathKind::constant, !turned, turned, k, y, turn, route.least,
            sqrt(Scalar(range.qa2 + range.kappa * e)));
    };
    const Sample b = at(Scalar(0)), a = at(range.is_capped ? Scalar(sqrt(range.e_max)) : range.e_max);
    LinearRootSearch<Scalar, decltype(at), decltype(slope), decltype(found)>(t_, sign, at, slope, found)
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
    const Crossing<Scalar> c(d, r, q0, r, q0, s.h);
    const Scalar y = view_.x[k + 1] - d;
    const Scalar value =
        view_.amount(k, y) + gained(y, top) + (s.X + c.X) + s.h / Scalar(4) * (t_ - (s.T + c.T));
    offer(value, s.h, PathKind::constant, !turned, turned, k, y, turn, route.least, s.qm);
  }

  void state(Route& route, std::size_t k) {
    if (view_.missing[k] == 0) return pure_state(k);
    if (!has_moving_state(k)) return;
    if (view_.least_amount(k) + (view_.is_mirror ? Scalar(0) : Scalar(z_ - view_.x[k + 1])) > limit()) return;
    const Scalar kept = route.least;
    route.least = std::min(route.least, view_.high[k]);
    if (view_.slope[k] == 0)
      flat_state(route, k, z_, false, 0, Scalar(0));
    else
      search_state(route, range_of(route, k, Leaves::upwards, Scalar(0)), view_.slope[k] > 0 ? -1 : 1, z_,
                   false, 0);
    route.least = kept;
  }

  void turned_state(Route& route, std::size_t k, std::size_t j, const Scalar& lo, const Scalar& hi,
                    const Scalar& top) {
    if (view_.least_amount(k) + gained(view_.x[k + 1], top) > limit()) return;
    const Scalar four_g = Scalar(4) * view_.p[k] * view_.missing[k];
    if (four_g * std::max(view_.low[k], view_.high[k]) < lo ||
        four_g * std::min(view_.low[k], view_.high[k]) > hi)
      return;
    const Scalar kept = route.least;
    route.least = std::min(hi, view_.high[k]);
    if (view_.slope[k] == 0)
      flat_state(route, k, top, true, j, lo);
    else
      search_state(route, range_of(route, k, Leaves::upwards, lo), view_.slope[k] > 0 ? 1 : -1, top, true, j);
    route.least = kept;
  }

  /// It turns in its own cell and leaves it at the bottom.
  void state_that_turns_at_once(Route& route, std::size_t k) {
    if (!has_moving_state(k) || !(view_.slope[k] < 0)) return;
    const Scalar four_g = Scalar(4) * view_.p[k] * view_.missing[k];
    if (four_g * view_.low[k] < view_.high[k]) return;
    if (view_.least_amount(k) + (view_.is_mirror ? Scalar(view_.x[k] - z_) : Scalar(0)) > limit()) return;
    const Scalar kept = route.least;
    route.least = std::min(route.least, view_.low[k]);
    search_state(route, range_of(route, k, Leaves::downwards, view_.high[k]), -1, z_, true, k);
    route.least = kept;
  }

  /// H = 0: the time from the start is int dz / r.
  void pure_state(std::size_t k) {
    using std::expm1;
    if (moving_only_) return;
    const Scalar left = t_ - (pure_z_ - view_.pure[k + 1]);
    const Scalar &b = view_.slope[k], x = -b * left;
    if (left < t_ - late_) return;
    const Scalar d = x == 0 ? Scalar(view_.high[k] * left) : Scalar(view_.high[k] * left * (expm1(x) / x));
    const Scalar width = view_.x[k + 1] - view_.x[k];
    if (!(d <= width + slack_)) return;
    const Scalar y = view_.x[k + 1] - std::clamp(d, Scalar(0), width);
    offer(view_.amount(k, y) + gained(y, z_), Scalar(0), PathKind::constant, true, false, k, y, 0,
          view_.high[k], Scalar(1));
  }

  const LinearView<Scalar>& view_;
  Scalar z_, t_, upper_;
  bool moving_only_;
  Path<Scalar>& best_;
  std::size_t n_, below_ = 0, above_ = 0;
  Scalar rate_below_{0}, rate_above_{0}, slack_{0}, pure_z_{0}, late_{0};
  Route scratch_;
};

}  // namespace shearfront::exact
