// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/sloped_starts.hpp"

namespace shearfront::exact {

/// The best path to (z, t), heights of the view, among those that set out upwards in the view, and those inside one piece.
template <Real Scalar, class Candidates>
class SlopedSearch : private Candidates {
 public:
  using Candidates::Candidates, Candidates::start_between;

  void run() {
    if constexpr (Candidates::kKnowsPieces) {
      for (const std::size_t cell : {below_, above_}) {
        inside(cell);
        if (is_of_piece(above_, below_)) break;
      }
    }
    from_below();
    from_above();
  }

  /// The same among fans of one node of the view that go straight, or turn in cell j, with an h from h_least to h_most, of straight ones
  /// about `h`: these only where they are found at once.
  void run_between(std::size_t node, bool turned, std::size_t j, const Scalar& h, const Scalar& h_least,
                   const Scalar& h_most) {
    const bool is_below = node <= below_;
    if (turned ? j < std::max(node, above_) : !is_below) return;
    Route way(false);
    if (is_below) {
      way.add(view_, below_, down_, Passes::upwards, false);
      for (std::size_t k = below_; k-- > node;) way.add(view_, k, view_.downwards[k], Passes::upwards, false);
    } else {
      for (std::size_t k = above_; k < node; ++k) {
        way.add(view_, k, k == above_ ? up_ : view_.upwards[k], Passes::downwards, true);
      }
    }
    Scalar top = z_, least = h_least, most = h_most;
    if (turned) {
      const Entrance from = node > above_ ? at_node(node) : at_z();
      way.twice.cell = from.cell;
      way.twice.n_cells = j - from.cell;
      way.twice.first = &from.run;
      way.least = std::min(way.least, from.run.r1);
      for (std::size_t k = from.cell; k < j; ++k)
        way.least = std::min({way.least, view_.high[k], view_.low[k + 1]});
      top = j == from.cell ? from.z : view_.x[j];
      way.turn_form = view_.form[j];
      way.turn_cell = j;
      way.turn_bend = -view_.bend[j];
      way.turn_rate = j == from.cell ? from.run.r1 : view_.low[j];
      least = std::max(least, view_.high[j]);
    }
    most = std::min(most, way.least);
    if (!(least < most)) return;
    if (turned)
      turned_fan(way, node, j, least, most, top);
    else
      this->fan_near(way, node, std::clamp(h, least, most), least, most);
  }

 private:
  using Base = Candidates;
  using Base::above_, Base::below_, Base::best_, Base::down_, Base::late_, Base::moving_only_, Base::n_,
      Base::rate_above_, Base::up_, Base::rate_below_, Base::slack_, Base::back_above_, Base::t_,
      Base::time_above_, Base::time_below_, Base::view_, Base::z_;
  using Base::flat_state, Base::gained, Base::least_start_, Base::limit, Base::may_start_at,
      Base::may_start_in, Base::most_start_, Base::offer, Base::range_of, Base::search_state,
      Base::straight_fan, Base::turned_fan;
  using typename Base::Leaves;
  using typename Base::Range;
  using typename Base::Route;

  [[nodiscard]] bool is_of_piece(std::size_t cell, std::size_t other) const {
    return view_.piece[cell] == view_.piece[other];
  }
  /// Whether what starts in one and ends in the other without leaving the piece is known without a search.
  [[nodiscard]] bool is_known(std::size_t cell, std::size_t other) const {
    return Candidates::kKnowsPieces && is_of_piece(cell, other);
  }

  /// What does not leave the piece of a cell at z, in closed form: states (in the upright view only) and fans.
  void inside(std::size_t cell) {
    std::size_t first = cell, last = cell;
    while (first > 0 && is_of_piece(first - 1, cell)) --first;
    while (last + 1 < n_ && is_of_piece(last + 1, cell)) ++last;
    const auto state = [&](std::size_t k) {
      const bool is_pure = !view_.is_curved(k) && (view_.p[k] == 0 || view_.missing[k] == 0);
      if (view_.is_mirror || (moving_only_ && is_pure) || !may_start_in(k)) return;
      // A pure state of the cell of z comes from its end at the latest.
      if (is_pure && k == cell) {
        const Scalar& from_end = view_.missing[k] == 0 ? (cell == below_ ? time_below_ : view_.pure_time[k])
                                                       : (cell == above_ ? time_above_ : view_.pure_time[k]);
        if (from_end < t_ - (late_ - t_)) return;
      }
      state_inside(cell, k, first, last);
    };
    const auto fan = [&](std::size_t k) {
      if (k > 0 && view_.emits[k] && may_start_at(k)) fan_inside(cell, k, first, last);
    };
    // Outwards from z, as far as pure states come.
    state(cell);
    Scalar time = cell == below_ ? time_below_ : Scalar(0);
    for (std::size_t k = cell; !(time > late_); time += view_.pure_time[k]) {
      fan(k);
      if (k == first) break;
      state(--k);
    }
    time = cell == above_ ? time_above_ : Scalar(0);
    for (std::size_t k = cell + 1; k <= last && !(time > late_); time += view_.pure_time[k], ++k) {
      fan(k);
      state(k);
    }
  }
  [[nodiscard]] const Scalar& rate_beside(std::size_t cell) const {
    return cell == below_ ? rate_below_ : rate_above_;
  }
  /// From cell k; `first` and `last` are the outermost cells of the piece.
  void state_inside(std::size_t cell, std::size_t k, std::size_t first, std::size_t last) {
    if (view_.is_curved(k)) return curved_inside(cell, k, first, last);
    // In terms of the cell: where r is steep, heights that differ by rounding have other H.
    const Scalar width = view_.x[k + 1] - view_.x[k];
    const Scalar rounding = std::min(slack_, Scalar(width / Scalar(1 << 20)));
    const auto arc = arc_from_state(view_.form[cell], view_.bend[cell], t_, view_.p[k], view_.missing[k],
                                    rate_beside(cell), Ways::up,
                                    {(z_ - view_.x[k + 1]) - rounding, (z_ - view_.x[k]) + rounding});
    if (!arc.exists) return;
    const Scalar y = z_ - arc.rise;
    accept(cell, arc, std::clamp(y, view_.x[k], view_.x[k + 1]), PathKind::constant, k, view_.amount(k, y),
           first, last);
  }
  /// From the height of a curved cell whose state comes to z.
  void curved_inside(std::size_t cell, std::size_t k, std::size_t first, std::size_t last) {
    const auto arc_from = [&](const Scalar& y) {
      const auto state = view_.state_at(k, y);
      return arc_from_state(view_.form[cell], view_.bend[cell], t_, state.p, state.missing,
                            rate_beside(cell));
    };
    const auto gap = [&](const Scalar& y) -> std::optional<Scalar> {
      const auto arc = arc_from(y);
      return arc.exists ? std::optional(Scalar(y + arc.rise - z_)) : std::nullopt;
    };
    sign_changes<Scalar>(gap, view_.x[k], view_.x[k + 1], [&](const Scalar& y) {
      const auto arc = arc_from(y);
      if (moving_only_ && (arc.p == 0 || arc.missing == 0)) return;
      // Of the start that leads to z to the last digit, which may lie between two doubles.
      const Scalar beside = (z_ - arc.rise) - y;
      accept(cell, arc, y, PathKind::constant, k, view_.amount(k, y) + view_.state_at(k, y).p * beside, first,
             last);
    });
  }
  /// From the lower node of cell k.
  void fan_inside(std::size_t cell, std::size_t k, std::size_t first, std::size_t last) {
    const auto arc = arc_from_point(view_.form[cell], view_.bend[cell], t_, Scalar(z_ - view_.x[k]),
                                    view_.low[k], rate_beside(cell), view_.is_mirror ? Ways::down : Ways::up);
    const Scalar one(1), edge = one / Scalar(1 << 20);
    if (arc.exists && arc.start_odds >= one - edge)
      accept(cell, arc, view_.x[k], PathKind::fan, k, view_.M[k], first, last);
  }
  void accept(std::size_t cell, const Arc<Scalar>& arc, const Scalar& y, PathKind kind, std::size_t source,
              const Scalar& M0, std::size_t first, std::size_t last) {
    const Scalar& r = rate_beside(cell);
    const Scalar h = Scalar(4) * r * arc.p * arc.missing;
    // Nothing turns in a flat piece: at its own source a fan stands still at 1/2.
    const bool is_fan = kind == PathKind::fan, is_flat = view_.bend[cell] == 0;
    const bool ends_up = arc.p > Scalar(0.5) || (is_fan && is_flat);
    const bool starts_up = is_fan || arc.start_odds > Scalar(1),
               starts_down = !is_fan && arc.start_odds < Scalar(1);
    const Scalar q = ends_up ? Scalar(arc.p - arc.missing) : Scalar(arc.missing - arc.p);
    const auto turns_beyond = [&](const Scalar& end, const Scalar& end_rate) {
      return stays_above<Scalar>(view_.form[cell], view_.bend[cell], r, q, h, end - z_, end_rate);
    };
    if (starts_up && !ends_up && turns_beyond(view_.x[last + 1], view_.high[last])) return;
    if (starts_down && ends_up && turns_beyond(view_.x[first], view_.low[first])) return;
    const bool turned = h > 0 && !is_flat && (ends_up ? starts_down : starts_up);
    offer(M0 + arc.gain, h, kind, ends_up, turned, source, y, cell, r, q);
  }

  /// Where a way begins at which a path turns: a height, its cell, the run from there to the end of the cell, and the times of pure
  /// states over it and back.
  struct Entrance {
    const Scalar& z;
    std::size_t cell;
    const RunEnds<Scalar>& run;
    const Scalar &time, &back;
  };
  [[nodiscard]] Entrance at_z() const { return {z_, above_, up_, time_above_, back_above_}; }
  [[nodiscard]] Entrance at_node(std::size_t node) const {
    return {view_.x[node], node, view_.upwards[node], view_.pure_time[node], view_.pure_back[node]};
  }

  /// Everything that starts below z and leaves its cell at the top.
  void from_below() {
    Route route(Candidates::has_bounds(n_));
    if (below_ != above_ && may_start_in(below_)) {
      if (!is_known(below_, below_)) state(route, below_, Scalar(0));
      if (view_.has_moving_state(below_)) turned_states(route, below_, Scalar(0), at_z());
    }
    route.add(view_, below_, down_, Passes::upwards, false);
    Scalar time = time_below_;
    for (std::size_t k = below_; k-- > view_.first_start; time += view_.pure_time[k]) {
      // Node k + 1, and the state of the cell below it.
      const std::size_t node = k + 1;
      if (time > late_ || view_.x[node] < least_start_) return;
      if (view_.emits[node] && may_start_at(node)) {
        if (!is_known(node, below_)) straight_fan(route, node, time);
        turned_fans(route, node, time, at_z());
      }
      if (may_start_in(k)) {
        if (!is_known(k, below_)) state(route, k, time);
        if (view_.has_moving_state(k)) turned_states(route, k, time, at_z());
      }
      route.add(view_, k, view_.downwards[k], Passes::upwards, false);
    }
  }

  /// Everything that starts at or above z, sets out upwards and turns.
  void from_above() {
    Route route(Candidates::has_bounds(n_));
    if (z_ == view_.x[above_] && above_ > 0 && view_.emits[above_] && may_start_at(above_))
      turned_fans(route, above_, Scalar(0), at_z());
    Scalar time(0);
    const std::size_t end = std::min(view_.end_of_starts, view_.end_of_falls);
    for (std::size_t k = above_; k < end && !(view_.x[k] > most_start_); ++k) {
      // Cell k: its state turns in it and leaves it at the bottom, or leaves it at the top; then its upper node.
      if (may_start_in(k) && !is_known(k, above_)) state_that_turns_at_once(route, k);
      const Entrance from = k == above_ ? at_z() : at_node(k);
      route.add(view_, k, from.run, Passes::downwards, true);
      time += from.back;
      const std::size_t node = k + 1;
      if (node == n_ || time > late_) return;
      if (view_.has_moving_state(k) && may_start_in(k)) turned_states(route, k, time, at_node(node));
      if (view_.emits[node] && may_start_at(node)) turned_fans(route, node, time, at_node(node));
    }
  }

  void turned_fans(const Route& once, std::size_t node, const Scalar& time, const Entrance& from) {
    turns(once, time, view_.M[node], node, node, from, {Scalar(0), infinity<Scalar>()},
          [&](Route& way, std::size_t j, const Scalar& lo, const Scalar& hi, const Scalar& top) {
            if (!this->may_turn(way, node, j, {lo, hi})) return;
            turned_fan(way, node, j, lo, hi, top);
          });
  }
  /// Precondition: cell k has a moving state.
  void turned_states(const Route& once, std::size_t k, const Scalar& time, const Entrance& from) {
    turns(once, time, view_.least_amount(k), k, k + 1, from, h_of_cell(k),
          [&](Route& way, std::size_t j, const Scalar& lo, const Scalar& hi, const Scalar& top) {
            const Range h = h_of_cell(k);
            if (!this->may_turn_from_state(way, j, k, {std::max(lo, h.least), std::min(hi, h.most)})) return;
            turned_state(way, k, j, lo, hi, top);
          });
  }

  /// h of the state of cell k.
  [[nodiscard]] Range h_of_cell(std::size_t k) const {
    if (view_.is_curved(k)) return this->h_of_curved(k);
    return {view_.h(k, std::min(view_.low[k], view_.high[k])),
            view_.h(k, std::max(view_.low[k], view_.high[k]))};
  }

  /// Calls found(route, j, least h, largest h, height above which it turns) for every cell j, that of `from` and above, in which
  /// paths from cell `start` can turn that pass `node` upwards with an h within `range` and M0 at their start, and have `once` to pass
  /// besides, which takes pure states the time `time`.
  template <class Found>
  void turns(const Route& once, Scalar time, const Scalar& M0, std::size_t start, std::size_t node,
             const Entrance& from, const Range& range, const Found& found) {
    Route& way = scratch_;
    const std::size_t first = from.cell;
    if (first >= view_.end_of_falls) return;
    way.once = once.once;
    way.twice.cell = first;
    way.twice.n_cells = 0;
    way.twice.first = &from.run;
    if (!once.stretches.is_off()) way.stretches = once.stretches;
    way.least = once.least;
    way.turn_bend = Scalar(0);
    const auto entry_of = [&](std::size_t j) -> const Scalar& {
      return j == first ? from.run.r1 : view_.low[j];
    };
    const auto height_of = [&](std::size_t j) -> const Scalar& { return j == first ? from.z : view_.x[j]; };
    for (std::size_t j = first; j < view_.end_of_falls; ++j) {
      const Scalar &entry = entry_of(j), &height = height_of(j);
      // Out of reach, or dearer than what there is: the height is gained, on one of both ways.
      if (time > late_) return;
      if (M0 + gained(view_.x[node], height) > limit()) return;
      const Scalar least = std::min(way.least, entry);
      if (least < range.least) return;
      if (view_.bend[j] < 0 && view_.high[j] < least && !(view_.high[j] > range.most) &&
          !(is_known(start, above_) && is_known(j, above_))) {
        const Scalar kept = way.least;
        way.least = least;
        way.turn_form = view_.form[j];
        way.turn_cell = j;
        way.turn_bend = -view_.bend[j];
        way.turn_rate = entry;
        way.twice.n_cells = j - first;
        found(way, j, view_.high[j], least, height);
        way.least = kept;
        way.turn_bend = Scalar(0);
      }
      way.add_bounds(view_, j, j == first ? from.run : view_.upwards[j], Passes::both);
      way.least = std::min(least, view_.high[j]);
      time += j == first ? Scalar(from.time + from.back) : Scalar(view_.pure_time[j] + view_.pure_back[j]);
    }
  }

  /// `time`: of pure states along the route.
  void state(Route& route, std::size_t k, const Scalar& time) {
    if (!view_.is_curved(k) && view_.missing[k] == 0) return this->pure_state(k, time);
    if (!view_.has_moving_state(k)) return;
    if (view_.least_amount(k) + (view_.is_mirror ? Scalar(0) : Scalar(z_ - view_.x[k + 1])) > limit()) return;
    const Range h = h_of_cell(k);
    if (h.least > route.least) return;
    if (!this->may_come_from_state(route, k, {h.least, std::min(h.most, route.least)})) return;
    const Scalar kept = route.least;
    route.least = std::min(route.least, view_.high[k]);
    if (view_.is_curved(k))
      this->search_curved(route, k, true, Scalar(0), z_, false, 0);
    else if (view_.bend[k] == 0)
      flat_state(route, k, z_, false, 0, Scalar(0));
    else
      search_state(route, range_of(route, k, Leaves::upwards, Scalar(0)), view_.bend[k] > 0 ? -1 : 1, z_,
                   false, 0);
    route.least = kept;
  }

  void turned_state(Route& route, std::size_t k, std::size_t j, const Scalar& lo, const Scalar& hi,
                    const Scalar& top) {
    if (view_.least_amount(k) + gained(view_.x[k + 1], top) > limit()) return;
    const Range h = h_of_cell(k);
    if (h.most < lo || h.least > hi) return;
    const Scalar kept = route.least;
    route.least = std::min(hi, view_.high[k]);
    if (view_.is_curved(k))
      this->search_curved(route, k, true, lo, top, true, j);
    else if (view_.bend[k] == 0)
      flat_state(route, k, top, true, j, lo);
    else
      search_state(route, range_of(route, k, Leaves::upwards, lo), view_.bend[k] > 0 ? 1 : -1, top, true, j);
    route.least = kept;
  }

  /// It turns in its own cell and leaves it at the bottom.
  void state_that_turns_at_once(Route& route, std::size_t k) {
    if (!view_.has_moving_state(k) || !(view_.bend[k] < 0)) return;
    const Range h = h_of_cell(k);
    if (h.most < view_.high[k]) return;
    if (view_.least_amount(k) + (view_.is_mirror ? Scalar(view_.x[k] - z_) : Scalar(0)) > limit()) return;
    const Scalar kept = route.least;
    route.least = std::min(route.least, view_.low[k]);
    if (!this->may_turn_at_once(route, k,
                                {std::max(h.least, view_.high[k]), std::min(h.most, route.least)})) {
      route.least = kept;
      return;
    }
    if (view_.is_curved(k))
      this->search_curved(route, k, false, view_.high[k], z_, true, k);
    else
      search_state(route, range_of(route, k, Leaves::downwards, view_.high[k]), -1, z_, true, k);
    route.least = kept;
  }

  Route scratch_{Candidates::has_bounds(n_)};
};

}  // namespace shearfront::exact
