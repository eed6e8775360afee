// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/exact/law_run.hpp"
#include "shearfront/exact/law_times.hpp"

namespace shearfront::exact {

/// As SlopedCandidates, for any flux with one extremum: no path is known without a search, so z has to be a node of the view.
///
/// Along a route T is a sum of what rises with h, the runs and starts where r falls along the way, and of what falls, turns and
/// other starts. So an interval of h is dropped only where T cannot be t; the others are halved, and one whose ends enclose t the
/// way a minimising path asks for is trusted to have one root once it is narrow, or once all samples are spent.
template <Real Scalar>
class LawCandidates : protected LawTimes<Scalar> {
 public:
  static constexpr bool kKnowsPieces = false;

  using LawTimes<Scalar>::LawTimes;

  [[nodiscard]] static bool has_bounds(std::size_t n_pieces) { return n_pieces >= kFew; }

 protected:
  using Base = LawTimes<Scalar>;
  using Base::gained, Base::initial_state, Base::late_, Base::limit, Base::moving_only_, Base::offer,
      Base::size_of_bend, Base::search_curved_cell, Base::slack_, Base::start_at, Base::state_at, Base::t_,
      Base::view_, Base::z_;
  using typename Base::CellState;
  using typename Base::Leaves;
  using typename Base::Range;
  using typename Base::Route;
  using typename Base::Sample;
  using typename Base::Start;
  using typename Base::State;
  using typename Base::StateRange;

  /// Adds all runs and the turn of a route to a sample that has h and lost.
  void add_law_route(const Route& route, Sample& s) const {
    // Where two runs meet at one rate in one flux they share the state.
    struct {
      Scalar r{-1};
      State state{Scalar(0), Scalar(0)};
      const InverseFlux<Scalar>* flux = nullptr;
    } last[2];
    route.for_each_run(view_, [&](const auto& leg, std::size_t cell, const RunEnds<Scalar>& run) {
      const Scalar bend = leg.is_upwards ? view_.bend[cell] : Scalar(-view_.bend[cell]);
      const InverseFlux<Scalar>* flux = &view_.fluxes->flux(view_.piece[cell]);
      for (const bool is_up : {true, false}) {
        if (leg.passes == (is_up ? Passes::downwards : Passes::upwards)) continue;
        auto& [r, state, of] = last[is_up];
        const State begin =
            r == run.r1 && of == flux ? state : state_at(cell, is_up, run.r1, route.least, s.lost, s.h);
        r = run.r2;
        state = state_at(cell, is_up, run.r2, route.least, s.lost, s.h);
        of = flux;
        const LawRun<Scalar> law(view_.side(cell, is_up), run.form, bend, run.d, run.r1, begin, run.r2, state,
                                 s.h);
        s.T_rising += law.T;
        s.X += law.X;
      }
    });
    if (route.turn_bend > 0) {
      const std::size_t j = route.turn_cell;
      const Scalar& r = route.turn_rate;
      const LawTurn<Scalar> turn(view_.side(j, true), view_.side(j, false), route.turn_form, route.turn_bend,
                                 r, state_at(j, true, r, route.least, s.lost, s.h),
                                 state_at(j, false, r, route.least, s.lost, s.h), s.h);
      s.T_falling += turn.T;
      s.X += turn.X;
      s.X_falling += turn.X;
    }
    s.T = s.T_rising + s.T_falling;
  }

  // Fans.
  [[nodiscard]] Sample fan_sample(const Route& route, const Scalar& w) const {
    const Scalar one(1), more = one + w;
    Sample s;
    s.v = w;
    s.qm = (one - w) / more;
    s.lost = route.least * s.qm * s.qm;
    s.h = Scalar(4) * route.least * w / (more * more);
    add_law_route(route, s);
    return s;
  }
  /// Of an h to the bit, as SlopedCandidates.
  [[nodiscard]] Sample fan_sample_of(const Route& route, const Scalar& h) const {
    Sample s = this->fan_of(route, h);
    add_law_route(route, s);
    return s;
  }
  void offer_fan(const Route& route, std::size_t node, const Scalar& base, const Sample& s, bool turned,
                 std::size_t turn) {
    offer(base + s.X + s.h / Scalar(4) * (t_ - s.T), s.h, PathKind::fan, !turned, turned, node, view_.x[node],
          turn, route.least, s.qm);
  }
  /// Whether a path may pass the place with the least rate at less than its speed.
  [[nodiscard]] bool has_kink(const Route& route) const {
    bool has = false;
    route.for_each_run(view_, [&](const auto&, std::size_t cell, const RunEnds<Scalar>& run) {
      const LawSide<Scalar> side = view_.side(cell, true);
      has = has ||
            ((run.r1 == route.least || run.r2 == route.least) && side.slope({Scalar(0), side.reach()}) > 0);
    });
    return has;
  }
  void straight_fan(const Route& route, std::size_t node, const Scalar& time) {
    const Scalar base = view_.M[node] + gained(view_.x[node], z_);
    if (base > limit() || time > late_) return;  // L >= max(0, v)
    if (time >= t_) {
      if (!moving_only_) offer_fan(route, node, base, fan_sample(route, Scalar(0)), false, 0);
      return;
    }
    const Sample top = fan_sample(route, Scalar(1));
    // It comes too early: it dawdles where the rate is least, in a flux with a kink. Any other rests at a throat.
    if (top.T <= t_ && has_kink(route)) return offer_fan(route, node, base, top, false, 0);
    Sample zero;
    zero.T = time;
    const auto at = [&](const Scalar& w) { return fan_sample(route, w); };
    // Right then both are the path, of the same cost, and rounding must not drop both.
    if (top.T < t_ && !is_end_close(route, top, false)) return;
    roots(
        route, false, 1, zero, top, at, [&](const Sample& s) { offer_fan(route, node, base, s, false, 0); },
        kSure, never_dear);
  }
  void turned_fan(const Route& route, std::size_t node, std::size_t j, const Scalar& lo, const Scalar& hi,
                  const Scalar& top) {
    const Scalar base = view_.M[node] + gained(view_.x[node], top);
    if (base > limit()) return;
    const auto at = [&](const Scalar& w) { return fan_sample(route, w); };
    const Sample a = fan_sample_of(route, lo);
    // No path along the route with a larger h costs less: H' t + int p dz at a smaller H'.
    const auto is_dear = [&](const Sample& s) {
      return base + (s.X - s.X_falling) + s.h / Scalar(4) * (t_ - s.T_rising) > limit();
    };
    if (is_dear(a)) return;
    roots(
        route, false, -1, a, fan_sample_of(route, hi), at,
        [&](const Sample& s) { offer_fan(route, node, base, s, true, j); }, 0, is_dear);
  }

  // States.
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
    add_law_route(route, s);
    add_way(route, k, range.leaves == Leaves::upwards, start.d, initial_state(k), view_.e0[k], view_.G0[k],
            s);
    return s;
  }
  /// The way in the cell of its start, `d` from where it leaves it.
  void add_way(const Route& route, std::size_t k, bool leaves_up, const Scalar& d, const State& from,
               const Scalar& lack, const Scalar& G, Sample& s) const {
    const Scalar& exit = leaves_up ? view_.high[k] : view_.low[k];
    const auto at_exit = [&](const State& at_start) {
      // Next to the peak rates that are the same still have states that differ, by what the start has lost.
      const bool is_there = !(d > 0) || view_.bend[k] == 0;
      return is_there ? at_start : state_at(k, leaves_up, exit, route.least, s.lost, s.h);
    };
    if (leaves_up) {
      const LawRun<Scalar> run(view_.side(k, true), view_.form[k], view_.bend[k], d, s.rate, from, exit,
                               at_exit(from), s.h);
      s.T += run.T;
      s.X += run.X;
      (view_.bend[k] < 0 ? s.T_rising : s.T_falling) += run.T;
      return;
    }
    // It turns, comes back to its start and goes on to the end below: all of that falls.
    const State back = view_.side(k, false).at(lack, G);
    const LawTurn<Scalar> turn(view_.side(k, true), view_.side(k, false), view_.form[k], size_of_bend(k),
                               s.rate, from, back, s.h);
    const LawRun<Scalar> run(view_.side(k, false), view_.form[k], Scalar(-view_.bend[k]), d, s.rate, back,
                             exit, at_exit(back), s.h);
    s.T += turn.T + run.T;
    s.T_falling += turn.T + run.T;
    s.X += turn.X + run.X;
  }
  void search_state(const Route& route, const StateRange& range, int sign, const Scalar& top, bool turned,
                    std::size_t turn) {
    if (range.is_empty) return;
    const std::size_t k = range.cell;
    const auto at = [&](const Scalar& v) { return state_sample(route, range, v); };
    const auto found = [&](const Sample& s) {
      const Scalar height = range.leaves == Leaves::downwards ? s.y : top;
      const Scalar value = view_.amount(k, s.y) + gained(s.y, height) + s.X + s.h / Scalar(4) * (t_ - s.T);
      offer(value, s.h, PathKind::constant, !turned, turned, k, s.y, turn, route.least, s.qm);
    };
    const Sample b = at(Scalar(0)), a = at(Scalar(1));
    roots(route, true, sign, a, b, at, found, 0, never_dear);
  }
  void search_curved(const Route& route, std::size_t k, bool leaves_up, const Scalar& h_low,
                     const Scalar& top, bool turned, std::size_t turn) {
    search_curved_cell(route, k, leaves_up, h_low, top, turned, turn, [&](const CellState& from, Sample& s) {
      add_law_route(route, s);
      const Scalar d = leaves_up ? view_.x[k + 1] - s.y : s.y - view_.x[k];
      add_way(route, k, leaves_up, d, initial_state(k, from.q0, from.missing), from.lack, from.G, s);
    });
  }
  /// Where r is constant in cell k: h is given and the time linear in the start.
  void flat_state(Route& route, std::size_t k, const Scalar& top, bool turned, std::size_t turn,
                  const Scalar& h_low) {
    using std::sqrt;
    const Scalar& r = view_.low[k];
    Sample s;
    s.h = view_.h(k, r);
    if (!(view_.q0[k] > 0) || s.h < h_low) return;
    s.lost = (route.least - r) + r * view_.e0[k];
    if (s.lost < 0) return;
    s.qm = sqrt(Scalar(s.lost / route.least));
    add_law_route(route, s);
    if (!(s.T <= late_)) return;
    const LawSide<Scalar> side = view_.side(k, true);
    const State from = initial_state(k);
    const Scalar left = std::max(Scalar(0), Scalar(t_ - s.T)), width = view_.x[k + 1] - view_.x[k];
    Scalar d = left * r * side.slope(from) / Scalar(4);
    if (d > width + slack_) return;
    d = std::min(d, width);
    const LawRun<Scalar> run(side, RateForm::linear, Scalar(0), d, r, from, r, from, s.h);
    const Scalar y = view_.x[k + 1] - d;
    const Scalar value =
        view_.amount(k, y) + gained(y, top) + (s.X + run.X) + s.h / Scalar(4) * (t_ - (s.T + run.T));
    offer(value, s.h, PathKind::constant, !turned, turned, k, y, turn, route.least, s.qm);
  }

 private:
  static constexpr std::size_t kFew = 6;
  /// Of a search for roots: where they meet in a stationary point of T intervals stay in doubt.
  static constexpr int kMostSamples = 200;
  static constexpr int kSure = 4;  ///< so many halvings make an interval narrow

  /// Calls found() next to every root of T = t between samples a and b, a.h < b.h, where T rises with h for `sign` 1 and falls for -1.
  /// An interval is left out where its lower end says that it `is_dear`.
  template <class At, class Found, class IsDear>
  void roots(const Route& route, bool is_state, int sign, const Sample& a, const Sample& b, const At& at,
             const Found& found, int depth, const IsDear& is_dear) {
    int left = kMostSamples;
    const Scalar tolerance = Scalar(256) * unit_roundoff<Scalar>() * t_;
    for (const Sample* s : {&a, &b})
      if (is_end_close(route, *s, is_state)) found(*s);
    halve(sign, a, b, at, found, is_dear, tolerance, depth, left);
  }
  template <class At, class Found, class IsDear>
  void halve(int sign, const Sample& a, const Sample& b, const At& at, const Found& found,
             const IsDear& is_dear, const Scalar& tolerance, int depth, int& left) {
    if (a.T_rising + b.T_falling > t_ + tolerance) return;
    if (b.T_rising + a.T_falling < t_ - tolerance) return;
    // In a flux with straight branches T may be the same for all of them.
    if (is_close(a.T, tolerance) && is_close(b.T, tolerance)) return;
    if (is_dear(a)) return;
    const bool encloses = sign > 0 ? a.T < t_ && b.T > t_ : a.T > t_ && b.T < t_;
    if (encloses && (depth >= kSure || left <= 0)) return found(root(a, b, at));
    const Scalar middle = a.v + (b.v - a.v) / Scalar(2);
    if (left <= 0 || !(middle > std::min(a.v, b.v) && middle < std::max(a.v, b.v))) return;
    --left;
    const Sample m = at(middle);
    if (is_close(m.T, tolerance)) found(m);
    // First where T is nearer to t, lest all samples are spent elsewhere.
    const auto away = [&](const Sample& s) { return s.T < t_ ? Scalar(t_ - s.T) : Scalar(s.T - t_); };
    const bool is_a_nearer = away(a) < away(b);
    if (is_a_nearer) halve(sign, a, m, at, found, is_dear, tolerance, depth + 1, left);
    halve(sign, m, b, at, found, is_dear, tolerance, depth + 1, left);
    if (!is_a_nearer) halve(sign, a, m, at, found, is_dear, tolerance, depth + 1, left);
  }
  [[nodiscard]] bool is_end_close(const Route& route, const Sample& s, bool is_state) const {
    const Scalar gap = s.T < t_ ? Scalar(t_ - s.T) : Scalar(s.T - t_);
    return is_within_rounding(gap, t_, [&] { return rounding(route, s, is_state); });
  }
  /// Next to the peak distances from it go as q = the root of what is lacking.
  [[nodiscard]] Scalar rounding(const Route& route, const Sample& s, bool is_state) const {
    const auto state = [&](std::size_t cell, bool is_up, const Scalar& r) {
      return state_at(cell, is_up, r, route.least, s.lost, s.h);
    };
    Scalar turn(0);
    if (route.turn_bend > 0) {
      const std::size_t j = route.turn_cell;
      const Scalar& r = route.turn_rate;
      const Scalar q = q_at(r, route.least, s.lost),
                   least = Scalar(8) * unit_roundoff<Scalar>() * r;  // lacking: of a q that is not resolved
      const bool is_small = q * q * r < least;
      const Scalar lost = is_small ? Scalar(least - (r - route.least)) : s.lost,
                   h = is_small ? Scalar(r - least) : s.h;
      const LawTurn<Scalar> law(view_.side(j, true), view_.side(j, false), route.turn_form, route.turn_bend,
                                r, state_at(j, true, r, route.least, lost, h),
                                state_at(j, false, r, route.least, lost, h), h);
      using std::sqrt;
      turn = law.T / (is_small ? Scalar(sqrt(Scalar(least / r))) : q);
    }
    return this->rounding_at_place(
        route, s, is_state, turn, [&](const auto& leg, const Scalar&, const Scalar&) {
          const RunEnds<Scalar>& run = *leg.first;
          const Scalar bend = leg.is_upwards ? view_.bend[leg.cell] : Scalar(-view_.bend[leg.cell]);
          Scalar most(0);
          for (const bool is_up : {true, false})
            most = std::max(most, LawRun<Scalar>(view_.side(leg.cell, is_up), run.form, bend, run.d, run.r1,
                                                 state(leg.cell, is_up, run.r1), run.r2,
                                                 state(leg.cell, is_up, run.r2), s.h)
                                      .T);
          return most;
        });
  }
  [[nodiscard]] static bool never_dear(const Sample&) { return false; }
  [[nodiscard]] bool is_close(const Scalar& T, const Scalar& tolerance) const {
    return T - t_ <= tolerance && t_ - T <= tolerance;
  }
  /// Of T - t between two samples of which one is less than t and the other more: by the false position of 1 / T, in the form of
  /// Anderson and Bjorck.
  template <class At>
  [[nodiscard]] Sample root(const Sample& a, const Sample& b, const At& at) const {
    const auto f = [&](const Scalar& T) { return is_finite(T) ? Scalar((T - t_) / T) : Scalar(1); };
    Scalar x0 = a.v, f0 = a.T > 0 ? f(a.T) : Scalar(-1), x1 = b.v, f1 = b.T > 0 ? f(b.T) : Scalar(-1);
    Sample best = a;
    const Scalar u = unit_roundoff<Scalar>();
    for (int n = 0; n < 300; ++n) {
      Scalar x = x1 - f1 * ((x1 - x0) / (f1 - f0));
      const Scalar lo = std::min(x0, x1), hi = std::max(x0, x1);
      if (n % 8 == 7 || !(x > lo && x < hi)) x = lo + (hi - lo) / Scalar(2);
      if (!(x > lo && x < hi)) break;
      best = at(x);
      const Scalar fx = best.T > 0 ? f(best.T) : Scalar(-1), size = fx < 0 ? Scalar(-fx) : fx;
      if (size <= Scalar(4) * u || hi - lo <= Scalar(2) * u * hi) break;
      if ((fx > 0) != (f1 > 0)) {
        x0 = x1, f0 = f1;
      } else {
        const Scalar m = Scalar(1) - fx / f1;
        f0 *= m > 0 ? m : Scalar(0.5);
      }
      x1 = x, f1 = fx;
    }
    return best;
  }
};

}  // namespace shearfront::exact
