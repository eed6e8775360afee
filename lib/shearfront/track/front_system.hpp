// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/riemann/in_layer.hpp"
#include "shearfront/riemann/interface.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/track/agenda.hpp"
#include "shearfront/track/front_list.hpp"
#include "shearfront/track/meeting_point.hpp"
#include "shearfront/track/observers.hpp"
#include "shearfront/track/pieces.hpp"

namespace shearfront {

/// The fronts of a bed, when they meet, and what happens when they do. A Tracker decides up to which time.
template <StateGrid Grid, class Observer>
class FrontSystem {
 public:
  using Scalar = typename Grid::Scalar;

  /// Times of the first and last wave at a boundary.
  struct Waves {
    std::optional<Scalar> first, last;
    std::optional<Scalar> first_edge;  ///< the first, or if that is the edge of a fan its characteristic
  };

  /// With more than `max_fronts` in the initial state there are none: has_too_many_fronts(), and nothing else may be asked. No
  /// memory is spent then: a budget of gigabytes would be used up before it is known that it does not suffice.
  FrontSystem(const Grid& grid, const std::vector<Piece<Scalar>>& pieces, const Ends<Scalar>& ends,
              Observer observer, std::size_t max_fronts)
      : grid_(&grid),
        max_fronts_(max_fronts),
        observer_(std::move(observer)),
        n_fronts_max_(count_fronts(grid, pieces, max_fronts)),
        fronts_(grid, has_too_many_fronts() ? 0 : n_fronts_max_),
        outside_(ends.outside),
        is_periodic_(ends.is_periodic) {
    if (!has_too_many_fronts()) start(pieces);
  }

  [[nodiscard]] const Grid& grid() const { return *grid_; }
  [[nodiscard]] Observer& observer() { return observer_; }
  [[nodiscard]] const Observer& observer() const { return observer_; }
  [[nodiscard]] const FrontList<Scalar>& fronts() const { return fronts_; }
  [[nodiscard]] Agenda<Grid>& agenda() { return agenda_; }
  [[nodiscard]] const Agenda<Grid>& agenda() const { return agenda_; }
  [[nodiscard]] const Waves& waves(std::size_t boundary) const { return waves_[boundary]; }
  /// State beyond the bottom (0) or the top (1) of the bed; none at a wall.
  [[nodiscard]] const std::optional<State>& outside(std::size_t end) const { return outside_[end]; }
  [[nodiscard]] bool is_periodic() const { return is_periodic_; }
  [[nodiscard]] const Scalar& time() const { return now_; }
  void set_time(const Scalar& t) { now_ = t; }
  [[nodiscard]] const Scalar& last_collision() const { return last_collision_; }
  [[nodiscard]] std::uint64_t n_collisions() const { return collisions_; }
  [[nodiscard]] std::size_t n_fronts() const { return fronts_.n_fronts(); }
  [[nodiscard]] std::size_t n_fronts_max() const { return n_fronts_max_; }
  [[nodiscard]] bool has_too_many_fronts() const { return n_fronts_max_ > max_fronts_; }

  /// Handles the meeting of node i with its upper neighbour, and of all others that meet in the same point,
  /// at the time predicted for it.
  void collide(FrontIndex i) {
    now_ = fronts_[i].meets;
    FrontIndex a = i, b = fronts_[i].next;
    while (fronts_[a].prev != kNoFront && !(fronts_[fronts_[a].prev].meets > now_)) a = fronts_[a].prev;
    while (!(fronts_[b].meets > now_)) b = fronts_[b].next;
    ++collisions_;
    last_collision_ = std::max(last_collision_, now_);
    const State l = fronts_[a].below, r = fronts_[b].above;
    FrontIndex boundary = kNoFront;
    for (FrontIndex k = a;; k = fronts_[k].next) {
      if (fronts_.is_boundary(k)) boundary = k;
      if (k == b) break;
    }
    if (boundary == kNoFront) {
      if (fronts_[a].next == b && is_one_shock(*grid_, fronts_[a].layer, l, r)) return merge(a, b, l, r);
      collide_in_layer(a, b, l, r);
    } else {
      collide_at_boundary(a, b, boundary, l, r);
    }
    n_fronts_max_ = std::max(n_fronts_max_, n_fronts());
  }

  /// Now another state lies beyond an open end. Precondition: what meets at this time has met.
  void change_outside(std::size_t end, State state) {
    outside_[end] = state;
    last_collision_ = std::max(last_collision_, now_);
    const FrontIndex b = end == 0 ? 0 : static_cast<FrontIndex>(grid_->n_layers());
    collide_at_boundary(b, b, b, fronts_[b].below, fronts_[b].above);
    n_fronts_max_ = std::max(n_fronts_max_, n_fronts());
  }

 private:
  using Node = FrontNode<Scalar>;
  void schedule(FrontIndex i) { agenda_.schedule(*grid_, fronts_, i, now_); }

  /// Fronts of the initial state, but those that leave the ends of the bed. No further than just beyond `most`.
  [[nodiscard]] static std::size_t count_fronts(const Grid& grid, const std::vector<Piece<Scalar>>& pieces,
                                                std::size_t most) {
    std::size_t count = 0;
    const auto count_in_layer = [&](std::size_t layer, State l, State r) {
      solve_in_layer(grid, layer, l, r, [&](State, State) { ++count; });
    };
    for (std::size_t i = 0; i + 1 < pieces.size() && count <= most; ++i) {
      const Piece<Scalar>&below = pieces[i], &above = pieces[i + 1];
      if (below.layer == above.layer) {
        count_in_layer(below.layer, below.state, above.state);
      } else {
        const StatePair at_rest = solve_interface(grid, below.layer, below.state, above.state);
        count_in_layer(below.layer, below.state, at_rest.below);
        count_in_layer(above.layer, at_rest.above, above.state);
      }
    }
    return count;
  }

  void start(const std::vector<Piece<Scalar>>& pieces) {
    const std::size_t n = fronts_.n_boundaries();
    SHEARFRONT_EXPECTS(!pieces.empty() && pieces.back().layer + 2 == n, "pieces fill the stack of layers");
    waves_.resize(n);
    const auto start_boundary = [&](std::size_t k, State l, State r) {
      const std::size_t before = n_fronts();
      const auto boundary = static_cast<FrontIndex>(k);
      begin_view(fronts_[boundary].z, k);
      emit_at_boundary(boundary, l, r);
      if (n_fronts() > before) waves_[k] = {now_, now_, now_};
      end_view();
    };
    if (is_periodic_)
      fronts_[0].above = pieces.front().state;  // solved with the top
    else
      start_boundary(0, 0, pieces.front().state);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      n_fronts_max_ = n_fronts();
      if (has_too_many_fronts()) return;
      const Piece<Scalar>& piece = pieces[i];
      if (i + 1 == pieces.size()) {
        start_boundary(n - 1, piece.state, 0);
      } else if (pieces[i + 1].layer != piece.layer) {
        start_boundary(piece.layer + 1, piece.state, pieces[i + 1].state);
      } else {
        begin_view(piece.top, CollisionView<Scalar>::kNoBoundary);
        const auto top_of_layer = static_cast<FrontIndex>(piece.layer + 1);
        emit_in_layer(fronts_[top_of_layer].prev, piece.layer, piece.state, pieces[i + 1].state, piece.top,
                      Scalar(0));
        end_view();
      }
    }
    n_fronts_max_ = n_fronts();
    for (FrontIndex i = 0; i != kNoFront; i = fronts_[i].next) schedule(i);
  }

  /// A new front between states l and r at (z + z_low, now), inserted above node `under`.
  FrontIndex emit(FrontIndex under, std::size_t layer, State l, State r, const Scalar& z,
                  const Scalar& z_low) {
    const FrontIndex i = fronts_.insert_above(under);
    Node& n = fronts_[i];
    n.z = z;
    n.z_low = z_low;
    n.t = now_;
    n.speed = grid_->speed(layer, l, r);
    n.meets = infinity<Scalar>();
    n.below = l;
    n.above = r;
    n.layer = static_cast<std::uint32_t>(layer);
    if constexpr (Observer::kActive) view_.outgoing.push_back(fronts_.view_of(i));
    return i;
  }
  /// Solves the Riemann problem inside `layer` and inserts its fronts above `under`; the last node inserted.
  FrontIndex emit_in_layer(FrontIndex under, std::size_t layer, State l, State r, const Scalar& z,
                           const Scalar& z_low) {
    FrontIndex last = under;
    solve_in_layer(*grid_, layer, l, r, [&](State a, State b) { last = emit(last, layer, a, b, z, z_low); });
    return last;
  }
  /// Solves the Riemann problem at boundary b between the states l and r that meet there. Returns the topmost
  /// node at its height.
  FrontIndex emit_at_boundary(FrontIndex b, State l, State r) {
    const Scalar z = fronts_[b].z, zero(0);
    const std::size_t n_layers = grid_->n_layers();
    if (is_periodic_ && (b == 0 || b == n_layers)) return emit_at_seam(b, l, r);
    if (b == 0) {
      fronts_[b].above =
          outside_[0] ? solve_between(*grid_, 0, 0, *outside_[0], r).above : solve_bottom_wall(*grid_, r);
    } else if (b == n_layers) {
      fronts_[b].below = outside_[1]
                             ? solve_between(*grid_, n_layers - 1, n_layers - 1, l, *outside_[1]).below
                             : solve_top_wall(*grid_, l);
    } else {
      const StatePair at_rest = solve_interface(*grid_, b - 1, l, r);
      fronts_[b].below = at_rest.below;
      fronts_[b].above = at_rest.above;
    }
    if (b > 0) emit_in_layer(fronts_[b].prev, b - 1, l, fronts_[b].below, z, zero);
    return b < n_layers ? emit_in_layer(b, b, fronts_[b].above, r, z, zero) : b;
  }

  /// Both ends of a periodic bed are one interface. Returns the topmost node at the height of b.
  FrontIndex emit_at_seam(FrontIndex b, State l, State r) {
    const auto top = static_cast<FrontIndex>(grid_->n_layers());
    const std::size_t last = grid_->n_layers() - 1;
    // What arrives at one end meets the state at the other.
    if (b == 0) {
      l = fronts_[top].below;
    } else {
      r = fronts_[0].above;
    }
    const StatePair at_rest = solve_between(*grid_, last, 0, l, r);
    fronts_[top].below = at_rest.below;
    fronts_[0].above = at_rest.above;
    const FrontIndex old_top_neighbour = fronts_[top].prev;
    const Scalar zero(0);
    const Scalar z_top = fronts_[top].z, z_bottom = fronts_[0].z;  // copies: new fronts move the nodes
    emit_in_layer(old_top_neighbour, last, l, at_rest.below, z_top, zero);
    const FrontIndex uppermost = emit_in_layer(0, 0, at_rest.above, r, z_bottom, zero);
    // The caller schedules what is new at b; here the other end.
    if (b == 0) {
      schedule(old_top_neighbour);
      schedule(fronts_[top].prev);
    } else {
      schedule(0);
      schedule(uppermost);
    }
    return b == 0 ? uppermost : b;
  }

  /// The commonest event, two fronts of a layer that become one shock: node a is used again, node b
  /// goes.
  void merge(FrontIndex a, FrontIndex b, State l, State r) {
    Node &first = fronts_[a], &second = fronts_[b];
    const Scalar speed = grid_->speed(first.layer, l, r);
    const TwoSum<Scalar> z = merging_point(first, second, speed, now_);
    begin_view(z.high, CollisionView<Scalar>::kNoBoundary, first.prev, second.next);
    if constexpr (Observer::kActive) view_.incoming = {fronts_.view_of(a), fronts_.view_of(b)};
    remove(b);
    agenda_.unschedule(first);
    first.z = z.high;
    first.z_low = z.low;
    first.t = now_;
    first.speed = speed;
    first.above = r;
    if constexpr (Observer::kActive) view_.outgoing = {fronts_.view_of(a)};
    end_view();
    schedule(first.prev);
    schedule(a);
  }
  void collide_in_layer(FrontIndex a, FrontIndex b, State l, State r) {
    const TwoSum<Scalar> z = meeting_point(*grid_, fronts_, a, b, l, r, now_);
    const FrontIndex under = fronts_[a].prev;
    const std::size_t layer = fronts_[a].layer;
    begin_view(z.high, CollisionView<Scalar>::kNoBoundary, under, fronts_[b].next);
    remove_all(a, b, kNoFront);
    const FrontIndex top = emit_in_layer(under, layer, l, r, z.high, z.low);
    end_view();
    schedule(under);
    if (top != under) schedule(top);
  }
  void collide_at_boundary(FrontIndex a, FrontIndex b, FrontIndex boundary, State l, State r) {
    const FrontIndex under = fronts_[a].prev;
    Waves& waves = waves_[boundary];
    if (!waves.first) waves.first_edge = first_edge(boundary);
    begin_view(fronts_[boundary].z, boundary, under, fronts_[b].next);
    remove_all(a, b, boundary);
    const FrontIndex top = emit_at_boundary(boundary, l, r);
    end_view();
    waves.first = waves.first ? std::min(*waves.first, now_) : now_;
    waves.last = waves.last ? std::max(*waves.last, now_) : now_;
    // Fronts that leave one point separate: only the outermost pairs are new.
    if (under != kNoFront) schedule(under);
    schedule(top);
  }

  /// When the first wave reaches a boundary, which is now in the polygon. The first front of a fan is slower than the
  /// characteristic of the state ahead of it, which was there before: while all that it has passed were boundaries that nothing
  /// had reached before, that is known.
  [[nodiscard]] Scalar first_edge(FrontIndex boundary) const {
    Scalar first = now_;
    if (is_periodic_) return first;
    const auto meet = [&](FrontIndex i, bool is_below) {
      if (i == kNoFront || fronts_.is_boundary(i)) return;
      const Node& f = fronts_[i];
      if (!grid_->is_fan_step(f.layer, f.below, f.above)) return;
      Scalar begun(0);
      if (f.t > 0) {
        const std::size_t from = is_below ? f.layer : f.layer + 1;
        const Node& origin = fronts_[static_cast<FrontIndex>(from)];
        const Waves& before = waves_[from];
        if (!before.first || !(f.t == *before.first && f.z == origin.z && f.z_low == 0)) return;
        begun = *before.first_edge;
      }
      const Scalar speed = grid_->edge_speed(f.layer, is_below ? f.above : f.below);
      const Scalar way = (fronts_[boundary].z - f.z) - f.z_low;
      if (is_below ? speed > 0 : speed < 0) first = std::min(first, Scalar(begun + way / speed));
    };
    const FrontIndex below = fronts_[boundary].prev;
    if (below != kNoFront && !(fronts_[below].meets > now_)) meet(below, true);
    if (!(fronts_[boundary].meets > now_)) meet(fronts_[boundary].next, false);
    return first;
  }

  void remove(FrontIndex i) {
    agenda_.unschedule(fronts_[i]);
    fronts_.remove(i);
  }
  void remove_all(FrontIndex a, FrontIndex b, FrontIndex keep) {
    for (FrontIndex k = a;;) {
      const FrontIndex next = fronts_[k].next;
      const bool last = k == b;
      if (k != keep) {
        if constexpr (Observer::kActive) view_.incoming.push_back(fronts_.view_of(k));
        remove(k);
      } else {
        agenda_.unschedule(fronts_[k]);
      }
      if (last) break;
      k = next;
    }
  }

  /// Of a point that has these nodes beside it; at an end of a periodic bed there is one at the other end.
  void begin_view(const Scalar& z, std::size_t boundary, FrontIndex under, FrontIndex over) {
    begin_view(z, boundary);
    if constexpr (Observer::kActive) {
      if (is_periodic_ && under == kNoFront) under = fronts_[static_cast<FrontIndex>(grid_->n_layers())].prev;
      if (is_periodic_ && over == kNoFront) over = fronts_[0].next;
      if (under != kNoFront) view_.under = fronts_.view_of(under);
      if (over != kNoFront) view_.over = fronts_.view_of(over);
    }
  }
  void begin_view(const Scalar& z, std::size_t boundary) {
    if constexpr (Observer::kActive) {
      view_.under.reset();
      view_.over.reset();
      view_.t = now_;
      view_.z = z;
      view_.boundary = boundary;
      view_.incoming.clear();
      view_.outgoing.clear();
    }
  }
  void end_view() {
    if constexpr (Observer::kActive) observer_.collision(*grid_, view_);
  }

  const Grid* grid_;
  std::size_t max_fronts_;
  Observer observer_;
  CollisionView<Scalar> view_{};
  std::size_t n_fronts_max_ = 0;
  FrontList<Scalar> fronts_;
  Agenda<Grid> agenda_;
  std::vector<Waves> waves_;
  Scalar now_{0}, last_collision_{0};
  std::uint64_t collisions_ = 0;
  std::array<std::optional<State>, 2> outside_;
  bool is_periodic_;
};

}  // namespace shearfront
