// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/riemann/in_layer.hpp"
#include "shearfront/riemann/interface.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/track/event_queue.hpp"
#include "shearfront/track/observers.hpp"

namespace shearfront {

/// One piece of a piecewise constant state of the bed: from the top of the piece before it up to `top`,
/// inside `layer`.
template <Real Scalar>
struct Piece {
  std::size_t layer;
  Scalar top;
  State state;
};

/// What may stop a run before its end.
struct RunLimits {
  std::uint64_t max_collisions = UINT64_MAX;
  /// Called now and then with (a time in the run, collisions so far); false stops with Status::interrupted.
  std::function<bool(double, std::uint64_t)> keep_going;
};

/// Event-driven front tracking: the exact solution of the problem whose fluxes are the polygons of a
/// StateGrid.
///
/// Between events the solution is a list of fronts ordered in z, each with constant speed between constant
/// states; interfaces and walls rest in the same list. At an event every front that meets in the point is
/// taken out, the Riemann problem of the outermost states is solved, and the outgoing fronts are put in
/// (Dafermos 1972; Holden, Holden & Hoegh-Krohn 1988: finitely many events up to t = infinity, hence
/// "hyperfast").
///
/// Guaranteed:
///   (1) which waves leave a point, and whether two fronts of a convex layer ever meet, is decided on
///       integers; rounding moves fronts, it never changes states;
///   (2) mass is conserved at every event to a few units in the last place of the largest height, however
///   many events:
///       positions are unevaluated sums of two numbers and a front leaves from the point that conserves mass;
///   (3) fronts never cross; phi never leaves the range of the grid;
///   (4) equal input gives bitwise equal output; advance_to(t1), advance_to(t2) equals advance_to(t2), and so
///   does a copy; (5) observers cannot steer.
/// A Tracker is a value: copy it to keep a state to return to.
/// Cost: O(log n) per event for n fronts that are about to meet; memory 64 bytes per front (double).
template <StateGrid Grid, class Observer = NoObserver>
class Tracker {
 public:
  using Scalar = typename Grid::Scalar;

  /// `pieces` fill the domain from bottom to top; every interface must be the top of a piece. The state is
  /// taken at time 0. `grid` must outlive the tracker.
  Tracker(const Grid& grid, const std::vector<Piece<Scalar>>& pieces, Observer observer = {})
      : grid_(&grid), observer_(std::move(observer)) {
    start(pieces);
  }

  /// Runs to time t, events at t included. Precondition: t >= time().
  /// Returns ok, or steady if nothing will ever happen again. After budget_reached or interrupted the fronts
  /// are not all at one time: only the counters may be read.
  Status advance_to(const Scalar& t, const RunLimits& limits = {}) {
    SHEARFRONT_EXPECTS(t >= now_, "a time that is not past");
    // In the order of t + skew z. A meeting can only influence another one that waves of speed <= fastest()
    // can reach from it, and that one has a greater key; so this order respects every influence, like that of
    // t. It sweeps through the bed instead of jumping about in it, and what it touches is in the cache.
    // Denormal speeds have no finite skew; then in the order of t.
    const Scalar skew = Scalar(1) / (Scalar(2) * grid_->fastest());
    collect(t, is_finite(skew) ? skew : Scalar(0));
    while (!queue_.empty()) {
      const Meeting<Scalar> next = queue_.first();
      queue_.pop();
      if (is_stale(next)) continue;
      if (collisions_ >= limits.max_collisions) {
        queue_.push(next);
        return Status::budget_reached;
      }
      now_ = nodes_[next.id].meets;
      collide(next.id);
      if (queue_.size() + waiting_.size() > 2 * n_pending_ + kCompactFrom) compact();
      if (collisions_ % kCollisionsPerReport == 0 && limits.keep_going &&
          !limits.keep_going(to_double(now_), collisions_))
        return Status::interrupted;
    }
    now_ = is_finite(t) ? t : last_collision_;
    return is_steady() ? Status::steady : Status::ok;
  }
  /// Runs until nothing will ever happen again; time() is then that of the last collision.
  Status run_to_steady(const RunLimits& limits = {}) { return advance_to(infinity<Scalar>(), limits); }

  /// Handles the next collision in time; false if there is none.
  bool step() {
    collect(infinity<Scalar>(), Scalar(0));
    while (!queue_.empty()) {
      const Meeting<Scalar> next = queue_.first();
      queue_.pop();
      if (is_stale(next)) continue;
      now_ = nodes_[next.id].meets;
      collide(next.id);
      return true;
    }
    return false;
  }

  [[nodiscard]] const Grid& grid() const { return *grid_; }
  [[nodiscard]] const Observer& observer() const { return observer_; }
  [[nodiscard]] const Scalar& time() const { return now_; }
  /// Whether nothing will ever happen again.
  [[nodiscard]] bool is_steady() const { return n_pending_ == 0 && n_unreachable_ == 0; }
  /// Time of the last collision so far; 0 if there was none.
  [[nodiscard]] const Scalar& last_collision() const { return last_collision_; }
  [[nodiscard]] std::uint64_t n_collisions() const { return collisions_; }
  [[nodiscard]] std::size_t n_fronts() const { return n_fronts_; }
  [[nodiscard]] std::size_t n_fronts_max() const { return n_fronts_max_; }
  /// Fronts that would meet only after the largest representable time.
  [[nodiscard]] std::size_t n_unreachable() const { return n_unreachable_; }

  /// First and last time at which a wave met boundary k (0 the bottom wall, n_layers the top wall); waves
  /// that leave it at time 0 count as met at 0.
  [[nodiscard]] const std::optional<Scalar>& first_wave(std::size_t k) const { return waves_[k].first; }
  [[nodiscard]] const std::optional<Scalar>& last_wave(std::size_t k) const { return waves_[k].last; }

  /// Fronts and boundaries at the current time from bottom to top: visit(is_boundary, view, z).
  /// For a boundary view.layer is its index, view.below and view.above the states on its two sides (0 outside
  /// the walls).
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    for (Index i = 0; i != kNone; i = nodes_[i].next) {
      const Node& node = nodes_[i];
      visit(is_boundary(i), view_of(i), position(node, now_));
    }
  }

  /// Heights of all fronts and boundaries at the current time, ascending (rounding may not reverse them),
  /// with the state above each but the last.
  struct Snapshot {
    std::vector<Scalar> z;
    std::vector<std::size_t> layer;  ///< of the piece above z[i]
    std::vector<State> state;        ///< of the piece above z[i]; one less than z
    std::vector<bool> is_fan;        ///< whether z[i] is a step of a fan
    std::vector<Scalar> age;         ///< time since the front at z[i] was born, 0 for boundaries
  };
  [[nodiscard]] Snapshot snapshot() const {
    Snapshot s;
    const std::size_t n = n_fronts_ + n_boundaries();
    s.z.reserve(n), s.layer.reserve(n), s.state.reserve(n), s.is_fan.reserve(n), s.age.reserve(n);
    for (Index i = 0; i != kNone; i = nodes_[i].next) {
      const Node& node = nodes_[i];
      Scalar z = position(node, now_);
      if (!is_boundary(i)) {
        // A front may stick out of its layer, or over its neighbour, by rounding: never by more.
        z = std::min(z, grid_->boundary(node.layer + 1));
        if (z < s.z.back()) z = s.z.back();
      }
      s.z.push_back(std::move(z));
      if (node.next == kNone) break;
      s.state.push_back(node.above);
      s.layer.push_back(node.layer);
      s.is_fan.push_back(!is_boundary(i) && grid_->is_fan_step(node.layer, node.below, node.above));
      s.age.push_back(is_boundary(i) ? Scalar(0) : now_ - node.t);
    }
    s.is_fan.push_back(false);
    s.age.push_back(Scalar(0));
    return s;
  }
  /// The piecewise constant solution at the current time. Cost: O(fronts).
  [[nodiscard]] Profile<Scalar> profile() const {
    Snapshot s = snapshot();
    std::vector<Scalar> phi(s.state.size());
    for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = grid_->phi(s.layer[i], s.state[i]);
    return {std::move(s.z), phi, phi};
  }
  /// Mass at the current time from the unrounded positions.
  [[nodiscard]] Scalar mass() const {
    // Abel summation: sum over jumps of z (phi_below - phi_above), positions as unevaluated sums.
    CompensatedSum<Scalar> sum;
    for (Index i = 0; i != kNone; i = nodes_[i].next) {
      const Node& node = nodes_[i];
      const Scalar phi_below = i == 0 ? Scalar(0) : phi_under(i),
                   phi_above = node.next == kNone ? Scalar(0) : phi_over(i);
      const Scalar jump = phi_below - phi_above;
      sum += node.z * jump;
      sum += (node.z_low + node.speed * (now_ - node.t)) * jump;
    }
    return sum.value();
  }

  /// Ends the record of an observer at the current time: fronts still alive are handed to observer.end_of().
  void close_record() {
    if constexpr (Observer::kActive) {
      for (Index i = 0; i != kNone; i = nodes_[i].next)
        if (!is_boundary(i)) observer_.end_of(*grid_, view_of(i), now_, position(nodes_[i], now_));
      observer_.close();
    }
  }

 private:
  using Index = std::uint32_t;
  static constexpr Index kNone = UINT32_MAX;
  static constexpr std::size_t kCompactFrom = 1024;
  static constexpr std::uint64_t kCollisionsPerReport = 1 << 14;

  // A cache line of its own for every front of doubles.
  struct alignas(std::same_as<Scalar, double> ? 64 : alignof(Scalar)) Node {
    Scalar z{0}, z_low{0}, t{0};  // passes z + z_low at time t
    Scalar speed{0};
    Scalar meets{0};  // when it meets its upper neighbour; infinity if never
    State below = 0, above = 0;
    Index prev = kNone, next = kNone;
    std::uint32_t layer = 0;  // of a front; of a boundary the layer above it
    std::uint32_t stamp = 0;
  };
  struct Waves {
    std::optional<Scalar> first, last;
  };

  // Nodes 0 .. n_layers are the boundaries, all others fronts.
  [[nodiscard]] std::size_t n_boundaries() const { return grid_->n_layers() + 1; }
  [[nodiscard]] bool is_boundary(Index i) const { return i < n_boundaries(); }
  [[nodiscard]] static Scalar position(const Node& n, const Scalar& t) {
    return n.z + (n.z_low + n.speed * (t - n.t));
  }
  [[nodiscard]] FrontView<Scalar> view_of(Index i) const {
    const Node& n = nodes_[i];
    return {is_boundary(i) ? static_cast<std::size_t>(i) : n.layer, n.t, n.z, n.speed, n.below, n.above};
  }
  [[nodiscard]] Scalar phi_under(Index i) const {
    return grid_->phi(is_boundary(i) ? std::size_t{i} - 1 : nodes_[i].layer, nodes_[i].below);
  }
  [[nodiscard]] Scalar phi_over(Index i) const { return grid_->phi(nodes_[i].layer, nodes_[i].above); }

  Index allocate() {
    if (!free_.empty()) {
      const Index i = free_.back();
      free_.pop_back();
      return i;
    }
    nodes_.emplace_back();
    return static_cast<Index>(nodes_.size() - 1);
  }

  /// Takes the prediction of node i out of the queue (its entry becomes stale).
  void unschedule(Node& n) {
    ++n.stamp;
    if (n.meets < infinity<Scalar>()) --n_pending_;
    n.meets = infinity<Scalar>();
  }

  /// Speed at which the nodes i and j = next(i) approach; not positive if they never meet. Two fronts of a
  /// convex layer meet if and only if the state below both exceeds the state above both (neither does in one
  /// chord of the polygon), and where their speeds nearly cancel the difference comes from these states.
  [[nodiscard]] Scalar closing_speed(Index i, Index j) const {
    const Node &a = nodes_[i], &b = nodes_[j];
    const Scalar closing = a.speed - b.speed;
    if constexpr (Grid::kUnimodalConvex) {
      if (!is_boundary(i) && !is_boundary(j)) {
        if (!(a.below > b.above)) return Scalar(0);
        constexpr int kCancelling = 64;
        if (Scalar(kCancelling) * size(closing) < size(a.speed) + size(b.speed))
          return grid_->speed_drop(a.layer, a.below, a.above, b.above);
      }
    }
    return closing;
  }

  /// Predicts the meeting of node i with its upper neighbour; true if there is one.
  bool predict(Index i) {
    Node& a = nodes_[i];
    unschedule(a);
    const Index j = a.next;
    if (j == kNone) return false;
    const Scalar closing = closing_speed(i, j);
    if (!(closing > 0)) return false;
    const Node& b = nodes_[j];
    const Scalar& base = std::max(a.t, b.t);
    // Anchors first: they are close when the fronts are, and then their difference is exact.
    const Scalar gap =
        (b.z - a.z) + ((b.z_low + b.speed * (base - b.t)) - (a.z_low + a.speed * (base - a.t)));
    const Scalar t = gap > 0 ? base + gap / closing : base;
    if (!(t < infinity<Scalar>())) {
      ++n_unreachable_;
      return false;
    }
    a.meets = t > now_ ? t : now_;
    ++n_pending_;
    return true;
  }
  void schedule(Index i) {
    if (predict(i)) enqueue(i);
  }
  void enqueue(Index i) {
    const Node& n = nodes_[i];
    if (n.meets > horizon_) {
      waiting_.push_back({n.meets, i, n.stamp});
    } else {
      queue_.push({n.meets + skew_ * (position(n, n.meets) - nodes_[0].z), i, n.stamp});
    }
  }
  [[nodiscard]] bool is_stale(const Meeting<Scalar>& m) const { return nodes_[m.id].stamp != m.stamp; }
  /// Puts every meeting up to `horizon` into the queue, in the order of t + skew z.
  void collect(const Scalar& horizon, const Scalar& skew) {
    if (skew != skew_ || horizon < horizon_) {
      queue_.drain([this](const Meeting<Scalar>& m) { waiting_.push_back(m); });
    } else if (waiting_.empty()) {
      horizon_ = horizon;
      return;
    }
    horizon_ = horizon;
    skew_ = skew;
    std::vector<Meeting<Scalar>> meetings;
    meetings.swap(waiting_);
    for (const Meeting<Scalar>& m : meetings)
      if (!is_stale(m)) enqueue(m.id);
  }
  void compact() {
    queue_.compact([this](const Meeting<Scalar>& m) { return !is_stale(m); });
    waiting_.erase(
        std::remove_if(waiting_.begin(), waiting_.end(), [this](const auto& m) { return is_stale(m); }),
        waiting_.end());
  }

  void insert_after(Index i, Index j) {
    nodes_[j].prev = i;
    nodes_[j].next = nodes_[i].next;
    if (nodes_[i].next != kNone) nodes_[nodes_[i].next].prev = j;
    nodes_[i].next = j;
  }
  void remove(Index i) {
    Node& n = nodes_[i];
    unschedule(n);
    nodes_[n.prev].next = n.next;
    nodes_[n.next].prev = n.prev;
    free_.push_back(i);
    --n_fronts_;
  }

  /// A new front between states l and r at (z + z_low, now), inserted above node `under`.
  Index emit(Index under, std::size_t layer, State l, State r, const Scalar& z, const Scalar& z_low) {
    const Index i = allocate();
    Node& n = nodes_[i];
    n.z = z;
    n.z_low = z_low;
    n.t = now_;
    n.speed = grid_->speed(layer, l, r);
    n.meets = infinity<Scalar>();
    n.below = l;
    n.above = r;
    n.layer = static_cast<std::uint32_t>(layer);
    ++n.stamp;
    insert_after(under, i);
    ++n_fronts_;
    if constexpr (Observer::kActive) view_.outgoing.push_back(view_of(i));
    return i;
  }

  /// Solves the Riemann problem inside `layer` and inserts its fronts above `under`; the last node inserted.
  Index emit_in_layer(Index under, std::size_t layer, State l, State r, const Scalar& z,
                      const Scalar& z_low) {
    Index last = under;
    solve_in_layer(*grid_, layer, l, r, [&](State a, State b) { last = emit(last, layer, a, b, z, z_low); });
    return last;
  }

  /// Solves the Riemann problem at boundary b between the states l and r that meet there. Returns the topmost
  /// node.
  Index emit_at_boundary(Index b, State l, State r) {
    const Scalar z = nodes_[b].z, zero(0);
    const std::size_t n_layers = grid_->n_layers();
    if (b == 0) {
      nodes_[b].above = solve_bottom_wall(*grid_, r);
    } else if (b == n_layers) {
      nodes_[b].below = solve_top_wall(*grid_, l);
    } else {
      const StatePair at_rest = solve_interface(*grid_, b - 1, l, r);
      nodes_[b].below = at_rest.below;
      nodes_[b].above = at_rest.above;
    }
    if (b > 0) emit_in_layer(nodes_[b].prev, b - 1, l, nodes_[b].below, z, zero);
    return b < n_layers ? emit_in_layer(b, b, nodes_[b].above, r, z, zero) : b;
  }

  /// Fronts that leave the jumps of the initial state; those of interfaces are fewer than the slack of a
  /// vector.
  [[nodiscard]] std::size_t count_fronts(const std::vector<Piece<Scalar>>& pieces) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
      if (pieces[i].layer == pieces[i + 1].layer)
        solve_in_layer(*grid_, pieces[i].layer, pieces[i].state, pieces[i + 1].state,
                       [&](State, State) { ++count; });
    return count;
  }

  void start(const std::vector<Piece<Scalar>>& pieces) {
    const std::size_t n = n_boundaries();
    SHEARFRONT_EXPECTS(!pieces.empty() && pieces.back().layer + 2 == n, "pieces fill the stack of layers");
    nodes_.reserve(n + count_fronts(pieces));
    nodes_.resize(n);
    waves_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      Node& b = nodes_[k];
      b.z = grid_->boundary(k);
      b.layer = static_cast<std::uint32_t>(k);
      b.meets = infinity<Scalar>();
      b.prev = k == 0 ? kNone : static_cast<Index>(k - 1);
      b.next = k + 1 == n ? kNone : static_cast<Index>(k + 1);
    }
    const auto start_boundary = [&](std::size_t k, State l, State r) {
      const std::size_t before = n_fronts_;
      begin_view(nodes_[k].z, k);
      emit_at_boundary(static_cast<Index>(k), l, r);
      if (n_fronts_ > before) waves_[k] = {now_, now_};
      end_view();
    };
    start_boundary(0, 0, pieces.front().state);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Piece<Scalar>& piece = pieces[i];
      if (i + 1 == pieces.size()) {
        start_boundary(n - 1, piece.state, 0);
      } else if (pieces[i + 1].layer != piece.layer) {
        start_boundary(piece.layer + 1, piece.state, pieces[i + 1].state);
      } else {
        begin_view(piece.top, CollisionView<Scalar>::kNoBoundary);
        emit_in_layer(nodes_[piece.layer + 1].prev, piece.layer, piece.state, pieces[i + 1].state, piece.top,
                      Scalar(0));
        end_view();
      }
    }
    n_fronts_max_ = n_fronts_;
    for (Index i = 0; i != kNone; i = nodes_[i].next) schedule(i);
  }

  [[nodiscard]] static Scalar size(const Scalar& x) { return x < 0 ? -x : x; }

  /// Where the fronts a .. b meet: the point from which one front l | r carries the mass they bring. Their
  /// positions at the computed time differ by rounding errors of that time; taking any one of them would lose
  /// mass at every event. Counted from the strongest front, which hardly moves: were it another one, the
  /// rounding of the distance between the two would go into the position at full weight, event after event.
  [[nodiscard]] TwoSum<Scalar> meeting_point(Index a, Index b, State l, State r) const {
    const std::size_t layer = nodes_[a].layer;
    const auto jump = [&](const Node& n) {
      return Scalar(grid_->phi(layer, n.below) - grid_->phi(layer, n.above));
    };
    Index strongest = a;
    for (Index i = a; i != b;) {
      i = nodes_[i].next;
      if (size(jump(nodes_[i])) > size(jump(nodes_[strongest]))) strongest = i;
    }
    const Node& anchor = nodes_[strongest];
    Scalar shift = anchor.z_low + anchor.speed * (now_ - anchor.t);
    CompensatedSum<Scalar> moment;
    Scalar widest(0);
    for (Index i = a;; i = nodes_[i].next) {
      const Node& n = nodes_[i];
      const Scalar offset = (n.z - anchor.z) + ((n.z_low + n.speed * (now_ - n.t)) - shift);
      moment += offset * jump(n);
      widest = std::max(widest, size(offset));
      if (i == b) break;
    }
    shift +=
        l == r ? Scalar(0) : bounded(moment.value() / (grid_->phi(layer, l) - grid_->phi(layer, r)), widest);
    return TwoSum<Scalar>(anchor.z, shift);
  }
  /// A weak outgoing front must not magnify rounding errors.
  [[nodiscard]] static Scalar bounded(const Scalar& correction, const Scalar& widest) {
    return size(correction) <= Scalar(2) * widest ? correction : Scalar(0);
  }

  /// The commonest event, two fronts of a convex layer that become one shock: node a is used again, node b
  /// goes.
  void merge(Index a, Index b, State l, State r) {
    Node &first = nodes_[a], &second = nodes_[b];
    const Scalar speed = grid_->speed(first.layer, l, r);
    // meeting_point() for two fronts: by Rankine-Hugoniot the weights of mass are those of speed.
    const Scalar moved_first = first.z_low + first.speed * (now_ - first.t);
    const Scalar moved_second = second.z_low + second.speed * (now_ - second.t);
    const Scalar offset = (second.z - first.z) + (moved_second - moved_first);
    const Scalar weight = (speed - first.speed) / (second.speed - first.speed);  // of the second front
    const bool from_second = weight + weight > Scalar(1);
    const Scalar correction =
        bounded(offset * (from_second ? weight - Scalar(1) : Scalar(weight)), size(offset));
    const TwoSum<Scalar> z(from_second ? second.z : first.z,
                           (from_second ? moved_second : moved_first) + correction);
    begin_view(z.high, CollisionView<Scalar>::kNoBoundary);
    if constexpr (Observer::kActive) view_.incoming = {view_of(a), view_of(b)};
    remove(b);
    unschedule(first);
    first.z = z.high;
    first.z_low = z.low;
    first.t = now_;
    first.speed = speed;
    first.above = r;
    if constexpr (Observer::kActive) view_.outgoing = {view_of(a)};
    end_view();
    schedule(first.prev);
    schedule(a);
  }

  /// Handles the meeting of node i with its upper neighbour, and of all others that meet in the same point.
  void collide(Index i) {
    Index a = i, b = nodes_[i].next;
    while (nodes_[a].prev != kNone && !(nodes_[nodes_[a].prev].meets > now_)) a = nodes_[a].prev;
    while (!(nodes_[b].meets > now_)) b = nodes_[b].next;
    ++collisions_;
    last_collision_ = std::max(last_collision_, now_);
    const State l = nodes_[a].below, r = nodes_[b].above;
    Index boundary = kNone;
    for (Index k = a;; k = nodes_[k].next) {
      if (is_boundary(k)) boundary = k;
      if (k == b) break;
    }
    if (boundary == kNone) {
      if constexpr (Grid::kUnimodalConvex)
        if (nodes_[a].next == b && l > r) return merge(a, b, l, r);
      collide_in_layer(a, b, l, r);
    } else {
      collide_at_boundary(a, b, boundary, l, r);
    }
    n_fronts_max_ = std::max(n_fronts_max_, n_fronts_);
  }
  void collide_in_layer(Index a, Index b, State l, State r) {
    const TwoSum<Scalar> z = meeting_point(a, b, l, r);
    const Index under = nodes_[a].prev;
    const std::size_t layer = nodes_[a].layer;
    begin_view(z.high, CollisionView<Scalar>::kNoBoundary);
    remove_all(a, b, kNone);
    const Index top = emit_in_layer(under, layer, l, r, z.high, z.low);
    end_view();
    schedule(under);
    if (top != under) schedule(top);
  }
  void collide_at_boundary(Index a, Index b, Index boundary, State l, State r) {
    const Index under = nodes_[a].prev;
    begin_view(nodes_[boundary].z, boundary);
    remove_all(a, b, boundary);
    const Index top = emit_at_boundary(boundary, l, r);
    end_view();
    Waves& waves = waves_[boundary];
    waves.first = waves.first ? std::min(*waves.first, now_) : now_;
    waves.last = waves.last ? std::max(*waves.last, now_) : now_;
    // Fronts that leave one point separate: only the outermost pairs are new.
    if (under != kNone) schedule(under);
    schedule(top);
  }

  void remove_all(Index a, Index b, Index keep) {
    for (Index k = a;;) {
      const Index next = nodes_[k].next;
      const bool last = k == b;
      if (k != keep) {
        if constexpr (Observer::kActive) view_.incoming.push_back(view_of(k));
        remove(k);
      } else {
        unschedule(nodes_[k]);
      }
      if (last) break;
      k = next;
    }
  }

  void begin_view(const Scalar& z, std::size_t boundary) {
    if constexpr (Observer::kActive) {
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
  Observer observer_;
  CollisionView<Scalar> view_{};
  std::vector<Node> nodes_;
  std::vector<Index> free_;
  EventQueue<Scalar> queue_;              // meetings up to horizon_, by t + skew_ z
  std::vector<Meeting<Scalar>> waiting_;  // later meetings, in no order
  Scalar horizon_{-1}, skew_{0};
  std::vector<Waves> waves_;
  Scalar now_{0}, last_collision_{0};
  std::size_t n_pending_ = 0, n_fronts_ = 0, n_fronts_max_ = 0, n_unreachable_ = 0;
  std::uint64_t collisions_ = 0;
};

}  // namespace shearfront
