// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_system.hpp"

#include <algorithm>
#include <utility>

#include "shearfront/track/curved_meeting.hpp"
#include "shearfront/track/curved_riemann.hpp"

namespace shearfront {

template <class Observer>
CurvedSystem<Observer>::CurvedSystem(const LevelCurves& grid, const CurvedProblem& problem, Observer observer,
                                     std::size_t max_fronts)
    : grid_(&grid),
      max_fronts_(max_fronts),
      observer_(std::move(observer)),
      fronts_(grid, std::min(4 * grid.n_levels(), max_fronts)),
      waves_(grid.n_layers() + 1),
      is_periodic_(problem.ends.is_periodic) {
  for (std::size_t end = 0; end < 2; ++end)
    if (!problem.ends.states[end].empty())
      outside_[end] = outside_state(grid, end, problem.ends.states[end].front());
  for (std::size_t b = 0; b <= grid.n_layers(); ++b)
    continues_.push_back(b > 0 && b < grid.n_layers() && problem.continues(b));
  start(problem.start);
}

template <class Observer>
void CurvedSystem<Observer>::start(const std::vector<StartSegment>& segments) {
  State last = outside_[0].value_or(grid_->high(0));
  const State beyond = outside_[1].value_or(grid_->low(0));
  for (std::size_t i = 0; i <= segments.size(); ++i) {
    const bool is_end = i == segments.size();
    StartSegmentLevels levels =
        is_end ? StartSegmentLevels{beyond, beyond, {}} : in_levels(*grid_, segments[i]);
    const std::size_t piece = is_end ? grid_->n_layers() : segments[i].piece;
    State at_low = levels.at_low;
    if (i > 0 && !is_end && segments[i - 1].piece == piece) {
      emit_inside(fronts_[static_cast<FrontIndex>(piece + 1)].prev, piece, last, at_low, segments[i].z_low);
    } else {
      const std::size_t before = n_fronts();
      if (is_periodic_ && i == 0)
        fronts_[0].above = at_low;  // solved with the top
      else
        emit_at_boundary(static_cast<FrontIndex>(piece), last, levels.at_low, now_);
      // A state that is not pure changes at once where the rate varies.
      const auto changes = [&](std::size_t p, State state) {
        return grid_->level(state) > 0 && !grid_->piece(p).is_constant();
      };
      const bool is_inner = i > 0 && !is_end;
      if (n_fronts() > before || (is_inner && (changes(piece - 1, last) || changes(piece, at_low))))
        waves_[piece] = {now_, now_, now_};
    }
    (levels.steps.empty() ? levels.at_high : levels.steps.front().below) = at_low;
    for (const StartSegmentLevels::Step& step : levels.steps)
      emit(fronts_[static_cast<FrontIndex>(piece + 1)].prev, piece, step.below, step.above, step.z);
    last = levels.at_high;
    n_fronts_max_ = n_fronts();
    if (has_too_many_fronts()) return;
  }
  for (FrontIndex i = 0; i != kNoFront; i = fronts_[i].next) schedule(i);
}

/// Predicts the next event of node i: that with its upper neighbour, or its turn.
template <class Observer>
void CurvedSystem<Observer>::schedule(FrontIndex i) {
  Node& f = fronts_[i];
  agenda_.unschedule(f);
  std::optional<CurvedMeeting> next;
  if (f.next != kNoFront) next = CurvedMeetings(*grid_, f, fronts_[f.next]).find();
  f.turns_next = false;
  if (f.turns) {
    if (!next || f.end_t < next->t) {
      next = CurvedMeeting{f.end_t, f.end};
      f.turns_next = true;
    }
  }
  if (!next) return;
  f.meeting_z = next->z;
  agenda_.enter(fronts_, i, next->t, now_);
}

/// A new front from (z, now) on, above node `under`.
template <class Observer>
FrontIndex CurvedSystem<Observer>::emit(FrontIndex under, std::size_t piece, State l, State r, double z) {
  const FrontIndex i = fronts_.insert_above(under);
  Node& n = fronts_[i];
  n.below = l;
  n.above = r;
  n.layer = static_cast<std::uint32_t>(piece);
  n.meets = infinity<double>();
  n.turned = Node::kNever;
  n.is_edge = false;
  const Node& other = fronts_[under];
  const bool is_next_in_fan = !is_boundary(under) && other.z == z && other.layer == piece && other.above == l;
  set_course(*grid_, n, z, now_, is_next_in_fan ? &other : nullptr);
  const std::size_t j = grid_->level(l), k = grid_->level(r);
  const bool are_neighbours = j + 1 == k || k + 1 == j;
  if (are_neighbours && !((j < k ? n.q_below : n.q_above) > 0)) n.turned = now_;
  return i;
}

/// Front i, put in now, is the edge of a fan next to a state that was there before, whose characteristic left its place at t.
template <class Observer>
void CurvedSystem<Observer>::set_edge(FrontIndex i, double t) {
  Node& n = fronts_[i];
  n.is_edge = n.direction != 0 && (n.direction > 0 ? n.q_above : n.q_below) > 0;
  n.edge_t = t;
}
/// When the characteristic of the state ahead of an edge reaches z.
template <class Observer>
double CurvedSystem<Observer>::arrival_of_edge(const Node& f, double z) const {
  return f.edge_t + grid_->characteristic_time(f.layer, f.direction > 0 ? f.above : f.below, f.z, z);
}

/// The waves that go down from z where the flux has become that of `level`; `at` is the state left there.
template <class Observer>
FrontIndex CurvedSystem<Observer>::emit_left(FrontIndex under, std::size_t piece, State l, std::size_t level,
                                             double z, State& at, double edge_t) {
  at = curved_riemann::waves_down(*grid_, l, level, [&](State below, State above, bool is_edge) {
    under = emit(under, piece, below, above, z);
    if (is_edge) set_edge(under, edge_t);
  });
  return under;
}
/// The waves that go up.
template <class Observer>
FrontIndex CurvedSystem<Observer>::emit_right(FrontIndex under, std::size_t piece, State r, std::size_t level,
                                              double z, State& at, double edge_t) {
  at = curved_riemann::waves_up(*grid_, r, level, [&](State below, State above, bool is_edge) {
    under = emit(under, piece, below, above, z);
    if (is_edge) set_edge(under, edge_t);
  });
  return under;
}

/// The Riemann problem of l | r at a height inside a piece, at the start. Returns the topmost new node; r is another name of
/// the same state where its level has turned.
template <class Observer>
FrontIndex CurvedSystem<Observer>::emit_inside(FrontIndex under, std::size_t piece, State l, State& r,
                                               double z) {
  if (l == r) return under;
  const double rate = grid_->piece(piece).rate(z);
  const std::size_t cap = grid_->cap(rate), level = curved_riemann::flux_level(*grid_, l, r, cap, cap);
  State below, above;
  const FrontIndex left = emit_left(under, piece, l, level, z, below, now_);
  const bool is_dead = !(grid_->q(piece, level, z, rate) > 0);
  FrontIndex middle = left;
  const bool stands = !is_dead && below != (r == grid_->low(level) ? r : grid_->high(level));
  if (stands) middle = emit(left, piece, below, r == grid_->low(level) ? r : grid_->high(level), z);
  const FrontIndex right = emit_right(middle, piece, r, level, z, above, now_);
  if (!is_dead || below == above) return right;
  const State label = curved_riemann::dead_label(*grid_, piece, l, r, level);
  fronts_[left].above = label;
  if (right != left)
    fronts_[fronts_[left].next].below = label;
  else
    r = label;
  return right;
}

/// Solves the Riemann problem at boundary b. Returns the topmost new node, or b.
template <class Observer>
FrontIndex CurvedSystem<Observer>::emit_at_boundary(FrontIndex b, State l, State r, double edge_t) {
  const std::size_t n = grid_->n_layers();
  if (is_periodic_ && (b == 0 || b == n)) return emit_at_seam(b, l, r, edge_t);
  const double z = fronts_[b].z;
  // Nothing passes a wall; beyond an open end the rate is that at the end.
  std::size_t cap_below = 0, cap_above = 0;
  if (b > 0 || outside_[0]) cap_below = b > 0 ? grid_->cap_high(b - 1) : grid_->cap_low(0);
  if (b < n || outside_[1]) cap_above = b < n ? grid_->cap_low(b) : grid_->cap_high(n - 1);
  const std::size_t level = curved_riemann::flux_level(*grid_, l, r, cap_below, cap_above);
  State below = l, above = r;
  if (b > 0) emit_left(fronts_[b].prev, b - 1, l, level, z, below, edge_t);
  FrontIndex top = b;
  if (b < n) top = emit_right(b, b, r, level, z, above, edge_t);
  fronts_[b].below = below;
  fronts_[b].above = above;
  return top;
}

/// Both ends of a periodic bed are one interface; what is new at the other end is scheduled here.
template <class Observer>
FrontIndex CurvedSystem<Observer>::emit_at_seam(FrontIndex b, State l, State r, double edge_t) {
  const std::size_t last = grid_->n_layers() - 1;
  const auto top = static_cast<FrontIndex>(last + 1);
  if (b == 0)
    l = fronts_[top].below;
  else
    r = fronts_[0].above;
  const std::size_t level =
      curved_riemann::flux_level(*grid_, l, r, grid_->cap_high(last), grid_->cap_low(0));
  const FrontIndex under = fronts_[top].prev;
  const double z_top = fronts_[top].z, z_bottom = fronts_[0].z;
  State below, above;
  emit_left(under, last, l, level, z_top, below, edge_t);
  const FrontIndex uppermost = emit_right(0, 0, r, level, z_bottom, above, edge_t);
  fronts_[top].below = below;
  fronts_[0].above = above;
  if (b == 0)
    schedule_all(under, top);
  else
    schedule_all(0, uppermost);
  return b == 0 ? uppermost : b;
}

template <class Observer>
void CurvedSystem<Observer>::collide(FrontIndex i) {
  now_ = fronts_[i].meets;
  ++collisions_;
  last_collision_ = std::max(last_collision_, now_);
  const FrontIndex j = fronts_[i].next;
  if (fronts_[i].turns_next)
    turn(i);
  else if (is_boundary(i))
    reach_boundary(j, i);
  else if (is_boundary(j))
    reach_boundary(i, j);
  else
    merge(i, j);
  n_fronts_max_ = std::max(n_fronts_max_, n_fronts());
}

template <class Observer>
void CurvedSystem<Observer>::schedule_all(FrontIndex from, FrontIndex to) {
  for (FrontIndex i = from; i != kNoFront; i = fronts_[i].next) {
    schedule(i);
    if (i == to) break;
  }
}

/// Tells the observer that a front goes, or goes on in another way, at (now, z).
template <class Observer>
void CurvedSystem<Observer>::end_course(const Node& f, double z) {
  if constexpr (Observer::kActive) observer_.ended(f, now_, z);
}
template <class Observer>
void CurvedSystem<Observer>::note(double z, std::size_t boundary, std::size_t incoming,
                                  std::size_t outgoing) {
  if constexpr (Observer::kActive) {
    Collision event{now_, z, boundary, incoming, outgoing};
    if (boundary == CollisionView<double>::kNoBoundary) event.boundary.reset();
    observer_.met(event);
  }
}

template <class Observer>
void CurvedSystem<Observer>::remove(FrontIndex i) {
  agenda_.unschedule(fronts_[i]);
  fronts_.remove(i);
}

template <class Observer>
void CurvedSystem<Observer>::reach_boundary(FrontIndex mover, FrontIndex b) {
  const bool is_from_below = fronts_[mover].next == b;
  const State l = is_from_below ? fronts_[mover].below : fronts_[b].below,
              r = is_from_below ? fronts_[b].above : fronts_[mover].above;
  const double edge_t = fronts_[mover].is_edge ? arrival_of_edge(fronts_[mover], fronts_[b].z) : now_;
  end_course(fronts_[mover], fronts_[b].z);
  const bool has_turned = fronts_[mover].turned != Node::kNever;
  const State below = fronts_[mover].below, above = fronts_[mover].above;
  remove(mover);
  solve_boundary(b, l, r, edge_t, 1);
  if (!has_turned || !continues_[b]) return;
  const FrontIndex beyond = is_from_below ? fronts_[b].next : fronts_[b].prev;
  Node& n = fronts_[beyond];
  if (!is_boundary(beyond) && n.t == now_ && n.below == below && n.above == above) n.turned = Node::kEarlier;
}

/// The Riemann problem at boundary b at any time after the start.
template <class Observer>
void CurvedSystem<Observer>::solve_boundary(FrontIndex b, State l, State r, double edge_t,
                                            std::size_t incoming) {
  const FrontIndex under = fronts_[b].prev;
  const std::size_t before = n_fronts();
  const FrontIndex top = emit_at_boundary(b, l, r, edge_t);
  note(fronts_[b].z, b, incoming, n_fronts() - before);
  Waves& waves = waves_[b];
  if (!waves.first) waves.first = now_;
  waves.first_edge = waves.first_edge ? std::min(*waves.first_edge, edge_t) : edge_t;
  waves.last = now_;
  schedule_all(under == kNoFront ? b : under, top);
}

template <class Observer>
void CurvedSystem<Observer>::change_outside(std::size_t end, State state) {
  outside_[end] = state;
  last_collision_ = std::max(last_collision_, now_);
  const FrontIndex b = end == 0 ? 0 : static_cast<FrontIndex>(grid_->n_layers());
  solve_boundary(b, end == 0 ? state : fronts_[b].below, end == 0 ? fronts_[b].above : state, now_, 0);
  n_fronts_max_ = std::max(n_fronts_max_, n_fronts());
}

/// Fronts f and g of one piece become one.
template <class Observer>
void CurvedSystem<Observer>::merge(FrontIndex f, FrontIndex g) {
  const FrontIndex under = fronts_[f].prev;
  const State l = fronts_[f].below, r = fronts_[g].above;
  const std::size_t piece = fronts_[f].layer;
  const double z = fronts_[f].meeting_z;
  end_course(fronts_[f], z);
  end_course(fronts_[g], z);
  remove(g);
  const std::size_t level = grid_->level(l);
  const bool is_dead = level == grid_->level(r) && !(grid_->q(piece, level, z) > 0);
  if (l == r || is_dead) {
    const FrontIndex over = fronts_[f].next;
    remove(f);
    if (l != r) {
      const State label = curved_riemann::dead_label(*grid_, piece, l, r, level);
      if (label != l) set_above(under, label);
      if (label != r) set_below(over, label);
      if (label != l && fronts_[under].prev != kNoFront) schedule(fronts_[under].prev);
      schedule(over);
    }
    schedule(under);
    note(z, CollisionView<double>::kNoBoundary, 2, 0);
    return;
  }
  note(z, CollisionView<double>::kNoBoundary, 2, 1);
  Node& n = fronts_[f];
  agenda_.unschedule(n);
  n.above = r;
  n.turned = Node::kNever;
  n.is_edge = false;
  set_course(*grid_, n, z, now_);
  schedule(under);
  schedule(f);
}

/// A front f whose level behind has reached the turning height of the next lower one, beyond which it may not be.
template <class Observer>
void CurvedSystem<Observer>::turn(FrontIndex f) {
  const bool rises = fronts_[f].direction > 0;
  const double z = fronts_[f].end;
  const std::size_t piece = fronts_[f].layer;
  const State behind = rises ? fronts_[f].below : fronts_[f].above,
              ahead = rises ? fronts_[f].above : fronts_[f].below;
  const std::size_t level = grid_->level(behind) - 1;
  const State label = rises ? grid_->low(level) : grid_->high(level);
  const FrontIndex under = fronts_[f].prev, over = fronts_[f].next;
  end_course(fronts_[f], z);
  note(z, CollisionView<double>::kNoBoundary, 1, grid_->level(ahead) == level ? 1 : 2);
  const auto set_turned = [&](FrontIndex i) {
    Node& n = fronts_[i];
    agenda_.unschedule(n);
    (rises ? n.above : n.below) = label;
    set_course(*grid_, n, z, now_);
    n.turned = now_;
    n.is_edge = false;
  };
  if (grid_->level(ahead) == level) {
    set_turned(f);
    rises ? set_below(over, label) : set_above(under, label);
    schedule(under);
    schedule(f);
    // What the front ahead meets on its far side is as before if it leaves, with its new label dead for good, and does not run in
    // parallel now.
    const FrontIndex front = rises ? over : under, beyond = rises ? over : fronts_[under].prev;
    const bool comes_back = fronts_[front].direction == (rises ? -1 : 1);
    if (beyond == kNoFront || fronts_[beyond].next == kNoFront) return;
    if (comes_back || fronts_[beyond].below == fronts_[fronts_[beyond].next].above) schedule(beyond);
    return;
  }
  if (rises) {
    set_turned(f);
    const FrontIndex further = emit(f, piece, label, ahead, z);
    schedule_all(under, further);
  } else {
    set_turned(f);
    const FrontIndex further = emit(under, piece, ahead, label, z);
    schedule(under);
    schedule(further);
    schedule(f);
  }
}

/// Before the label of a level changes of a front that has passed its turning height, its path begins anew there: on the live
/// side it was that of the old label.
template <class Observer>
void CurvedSystem<Observer>::anchor_beyond(Node& f, std::size_t level) {
  const std::size_t piece = f.layer;
  if (level == 0 || f.direction == 0 || !(grid_->q(piece, level, f.z, f.rate) > 0)) return;
  const double z = grid_->turning_height(piece, level);
  if (f.direction > 0 ? !(z > f.z && z < f.end) : !(z < f.z && z > f.end)) return;
  const double t = passage(*grid_, f, z).t;
  f.is_edge = false;
  if constexpr (Observer::kActive) observer_.ended(f, t, z);
  set_origin(*grid_, f, z, t);
}

template <class Observer>
void CurvedSystem<Observer>::set_below(FrontIndex i, State state) {
  if (!is_boundary(i)) anchor_beyond(fronts_[i], grid_->level(state));
  fronts_[i].below = state;
}
template <class Observer>
void CurvedSystem<Observer>::set_above(FrontIndex i, State state) {
  if (!is_boundary(i)) anchor_beyond(fronts_[i], grid_->level(state));
  fronts_[i].above = state;
}

template class CurvedSystem<NoObserver>;
template class CurvedSystem<CurvedRecord>;

}  // namespace shearfront
