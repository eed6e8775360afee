// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/law_run.hpp"
#include "shearfront/exact/sloped_starts.hpp"

namespace shearfront::exact {

/// States along a route for any flux with one extremum, and bounds of the times between them.
template <Real Scalar>
class LawTimes : protected SlopedStarts<Scalar> {
 public:
  using SlopedStarts<Scalar>::SlopedStarts;

 protected:
  using Base = SlopedStarts<Scalar>;
  using Base::t_, Base::view_;
  using typename Base::Range;
  using typename Base::Route;
  using State = LawState<Scalar>;

  // Whether a time along a route may be t, h within a range. Runs and starts from which r falls take longer with h, turns and other
  // starts less; all of them take (4 / (k h)) |change of p| with some k between the bounds of |r'| / r.
  using Times = typename SlopedStretches<Scalar>::Times;
  using Bends = RelativeBends<Scalar>;
  [[nodiscard]] Scalar from_peak(std::size_t cell, bool is_up, const Scalar& h, const Scalar& r) const {
    if (!(h < r)) return Scalar(0);
    return view_.side(cell, is_up).at(Scalar((r - h) / r), Scalar(h / r)).from_peak;
  }
  void add_stretch(const typename SlopedStretches<Scalar>::Stretch& s, const Range& h, Times& all) const {
    const Scalar four(4), slack(kSlack);
    const Scalar &most = std::max(s.begin, s.end), &least = std::min(s.begin, s.end);
    for (const bool is_up : {true, false}) {
      if (s.passes == (is_up ? Passes::downwards : Passes::upwards)) continue;
      const LawSide<Scalar> side = view_.side(s.cell, is_up);
      const auto slope = [&](const Scalar& at_h, const Scalar& r, const Scalar& farther) {
        const Scalar d =
            std::clamp(Scalar(from_peak(s.cell, is_up, at_h, r) + farther), Scalar(0), side.reach());
        return side.slope({d, side.reach() - d});
      };
      Scalar lower = four * s.flat / (most * slope(h.least, most, slack));
      const Scalar slow = least * slope(h.most, least, Scalar(-slack));
      Scalar upper = slow > 0 ? Scalar(four * s.flat / slow) : infinity<Scalar>();
      if (most - least > slack * most) {
        const auto change = [&](const Scalar& at_h) {
          const Scalar x = from_peak(s.cell, is_up, at_h, most) - from_peak(s.cell, is_up, at_h, least);
          return x < 0 ? Scalar(-x) : x;
        };
        if (h.least > 0)
          lower = std::max(lower, Scalar(four * (change(h.least) - slack) / (s.bends.most * h.least)));
        if (h.most < least)
          upper = std::min(upper, Scalar(four * (change(h.most) + slack) / (s.bends.least * h.most)));
      }
      all.least += lower;
      all.most += upper;
    }
  }
  [[nodiscard]] Times times(const Route& route, const Range& h) const {
    if (route.stretches.is_full()) return {Scalar(0), infinity<Scalar>()};
    Times all{Scalar(0), Scalar(0)};
    for (const auto& stretch : route.stretches.all()) add_stretch(stretch, h, all);
    return all;
  }
  [[nodiscard]] Times turn_times(const Route& way, std::size_t j, const Range& h) const {
    Times all = times(way, h);
    if (way.stretches.is_full()) return all;
    const Bends& bends = view_.bends[j];
    const auto change = [&](const Scalar& at_h) {
      return Scalar(from_peak(j, true, at_h, way.turn_rate) + from_peak(j, false, at_h, way.turn_rate));
    };
    const Scalar four(4), slack(kSlack);
    all.least += four * std::max(Scalar(0), Scalar(change(h.most) - slack)) / (bends.most * h.most);
    all.most +=
        h.least > 0 ? Scalar(four * (change(h.least) + slack) / (bends.least * h.least)) : infinity<Scalar>();
    return all;
  }
  /// Most time from a start in cell k to its upper end.
  [[nodiscard]] Scalar most_from_state(std::size_t k, const Range& h) const {
    if (view_.is_curved(k)) return most_through(k, h);
    const State from = initial_state(k);
    const LawSide<Scalar> side = view_.side(k, true);
    if (view_.bend[k] == 0)
      return Scalar(4) * (view_.x[k + 1] - view_.x[k]) / (view_.low[k] * side.slope(from));
    Scalar change(0);
    for (const Scalar* at_h : {&h.least, &h.most}) {
      const Scalar x = from_peak(k, true, *at_h, view_.high[k]) - from.from_peak;
      change = std::max(change, x < 0 ? Scalar(-x) : x);
    }
    return h.least > 0 ? Scalar(Scalar(4) * (change + Scalar(kSlack)) / (view_.bends[k].least * h.least))
                       : infinity<Scalar>();
  }
  /// The same of any state there.
  [[nodiscard]] Scalar most_through(std::size_t k, const Range& h) const {
    const Scalar four(4), slack(kSlack), &least = std::min(view_.low[k], view_.high[k]);
    const LawSide<Scalar> side = view_.side(k, true);
    const Scalar d = std::max(Scalar(0), Scalar(from_peak(k, true, h.most, least) - slack)),
                 slow = d > 0 ? Scalar(least * side.slope({d, side.reach() - d})) : Scalar(0);
    const Scalar by_speed =
        slow > 0 ? Scalar(four * (view_.x[k + 1] - view_.x[k]) / slow) : infinity<Scalar>();
    return std::min(by_speed, most_to_peak(k, true, h));
  }
  /// Most time between the peak and any state of a side in cell k.
  [[nodiscard]] Scalar most_to_peak(std::size_t k, bool is_up, const Range& h) const {
    const Scalar& least_bend = view_.bends[k].least;
    if (!(h.least > 0 && least_bend > 0)) return infinity<Scalar>();
    const Scalar d = from_peak(k, is_up, h.least, std::max(view_.low[k], view_.high[k]));
    return Scalar(4) * (d + Scalar(kSlack)) / (least_bend * h.least);
  }
  [[nodiscard]] bool may_turn_at_once(const Route& route, std::size_t k, const Range& h) const {
    Times all = times(route, h);
    if (is_finite(all.most)) all.most += most_to_peak(k, true, h) + most_to_peak(k, false, h);
    return all.may_be(t_);
  }
  [[nodiscard]] bool may_turn(const Route& way, std::size_t, std::size_t j, const Range& h) const {
    return turn_times(way, j, h).may_be(t_);
  }
  [[nodiscard]] bool may_turn_from_state(const Route& way, std::size_t j, std::size_t k,
                                         const Range& h) const {
    Times all = turn_times(way, j, h);
    if (is_finite(all.most)) all.most += most_from_state(k, h);
    return all.may_be(t_);
  }
  [[nodiscard]] bool may_come_from_state(const Route& route, std::size_t k, const Range& h) const {
    Times all = times(route, h);
    if (is_finite(all.most)) all.most += most_from_state(k, h);
    return all.may_be(t_);
  }

  /// The state at a rate r in a cell, on the way of a route on which h = least - lost.
  [[nodiscard]] State state_at(std::size_t cell, bool is_up, const Scalar& r, const Scalar& least,
                               const Scalar& lost, const Scalar& h) const {
    const Scalar e = ((r - least) + lost) / r;
    return view_.side(cell, is_up)
        .at(std::clamp(e, Scalar(0), Scalar(1)), std::min(Scalar(1), Scalar(h / r)));
  }
  [[nodiscard]] State initial_state(std::size_t k) const {
    return initial_state(k, view_.q0[k], view_.missing[k]);
  }
  [[nodiscard]] State initial_state(std::size_t k, const Scalar& q0, const Scalar& missing) const {
    return {std::max(Scalar(0), Scalar(q0 / Scalar(2))), std::min(missing, view_.side(k, true).reach())};
  }

 private:
  /// What a distance from the peak may be off by where r - h is all rounding.
  static constexpr double kSlack = 0x1p-20;
};

}  // namespace shearfront::exact
