// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/track/event_queue.hpp"
#include "shearfront/track/front_list.hpp"

namespace shearfront {

/// Predicted events of the nodes of a FrontList, at most one for each, and the order in which they are handled.
///
/// Cost: O(log n) per event. The list is handed in: copies of a tracker copy both.
template <class FrontListType>
class EventAgenda {
 public:
  using Fronts = FrontListType;
  using Scalar = typename Fronts::Scalar;
  using Node = typename Fronts::Node;

  /// Events that will come, and those that would come after the largest representable time.
  [[nodiscard]] std::size_t n_pending() const { return n_pending_; }
  [[nodiscard]] std::size_t n_unreachable() const { return n_unreachable_; }

  /// Takes the prediction of a node out (its entry becomes stale).
  void unschedule(Node& n) {
    ++n.stamp;
    if (n.meets < infinity<Scalar>()) --n_pending_;
    n.meets = infinity<Scalar>();
  }
  /// Enters node i with its next event at `t`, or now if that is past. Precondition: it is unscheduled.
  void enter(Fronts& fronts, FrontIndex i, const Scalar& t, const Scalar& now) {
    if (!(t < infinity<Scalar>())) {
      ++n_unreachable_;
      return;
    }
    fronts[i].meets = t > now ? t : now;
    ++n_pending_;
    enqueue(fronts, i);
  }

  /// Makes every meeting up to `horizon` ready, in the order of t + skew z.
  void collect(const Fronts& fronts, const Scalar& horizon, const Scalar& skew) {
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
      if (!is_stale(fronts, m)) enqueue(fronts, m.id);
  }
  /// Takes out the next meeting that is ready; none if there is none.
  [[nodiscard]] std::optional<Meeting<Scalar>> take(const Fronts& fronts) {
    while (!queue_.empty()) {
      const Meeting<Scalar> next = queue_.first();
      queue_.pop();
      if (!is_stale(fronts, next)) return next;
    }
    return std::nullopt;
  }
  void put_back(const Meeting<Scalar>& meeting) { queue_.push(meeting); }
  /// Forgets stale entries once they are the majority.
  void tidy(const Fronts& fronts) {
    if (queue_.size() + waiting_.size() <= 2 * n_pending_ + kCompactFrom) return;
    queue_.compact([&](const Meeting<Scalar>& m) { return !is_stale(fronts, m); });
    waiting_.erase(
        std::remove_if(waiting_.begin(), waiting_.end(), [&](const auto& m) { return is_stale(fronts, m); }),
        waiting_.end());
  }

 private:
  static constexpr std::size_t kCompactFrom = 1024;

  [[nodiscard]] static bool is_stale(const Fronts& fronts, const Meeting<Scalar>& m) {
    return fronts[m.id].stamp != m.stamp;
  }
  void enqueue(const Fronts& fronts, FrontIndex i) {
    const Node& n = fronts[i];
    if (n.meets > horizon_) {
      waiting_.push_back({n.meets, i, n.stamp});
    } else {
      queue_.push({n.meets + skew_ * (n.position(n.meets) - fronts[0].z), i, n.stamp});
    }
  }

  EventQueue<Scalar> queue_;              // meetings up to horizon_, by t + skew_ z
  std::vector<Meeting<Scalar>> waiting_;  // later meetings, in no order
  Scalar horizon_{-1}, skew_{0};
  std::size_t n_pending_ = 0, n_unreachable_ = 0;
};

/// Which neighbours of a FrontList of straight fronts meet when.
///
/// Guaranteed: whether two fronts of a convex layer ever meet is decided on their states; the time of a
/// meeting is that of the two positions as stored, to a few roundings of the time and of the way since the
/// last collision divided by the closing speed.
template <StateGrid Grid>
class Agenda : public EventAgenda<FrontList<typename Grid::Scalar>> {
 public:
  using Scalar = typename Grid::Scalar;
  using Fronts = FrontList<Scalar>;
  using Node = FrontNode<Scalar>;

  /// Predicts the meeting of node i with its upper neighbour.
  void schedule(const Grid& grid, Fronts& fronts, FrontIndex i, const Scalar& now) {
    Node& a = fronts[i];
    this->unschedule(a);
    const FrontIndex j = a.next;
    if (j == kNoFront) return;
    const Scalar closing = closing_speed(grid, fronts, i, j);
    if (!(closing > 0)) return;
    const Node& b = fronts[j];
    const Scalar& base = std::max(a.t, b.t);
    // Anchors first: they are close when the fronts are, and then their difference is exact.
    const Scalar gap = (b.z - a.z) + (b.moved(base) - a.moved(base));
    this->enter(fronts, i, gap > 0 ? base + gap / closing : base, now);
  }

 private:
  [[nodiscard]] static Scalar size(const Scalar& x) { return x < 0 ? -x : x; }
  /// Speed at which the nodes i and j = next(i) approach; not positive if they never meet. Two fronts of a
  /// convex layer meet if and only if the state below both exceeds the state above both (neither does in one
  /// chord of the polygon), and where their speeds nearly cancel the difference comes from these states.
  [[nodiscard]] static Scalar closing_speed(const Grid& grid, const Fronts& fronts, FrontIndex i,
                                            FrontIndex j) {
    const Node &a = fronts[i], &b = fronts[j];
    const Scalar closing = a.speed - b.speed;
    if (fronts.is_boundary(i) || fronts.is_boundary(j)) return closing;
    const auto [least, most] = std::minmax({a.below, a.above, b.above});
    switch (grid.bend(a.layer, least, most)) {
      case Bend::mixed:
        return closing;
      case Bend::concave:
        return a.below < b.above ? closing : Scalar(0);
      case Bend::convex:
        break;
    }
    if (!(a.below > b.above)) return Scalar(0);
    if constexpr (requires { grid.speed_drop(a.layer, a.below, a.above, b.above, closing); }) {
      constexpr int kCancelling = 32;
      if (Scalar(kCancelling) * closing < size(a.speed))
        return grid.speed_drop(a.layer, a.below, a.above, b.above, closing);
    }
    return closing;
  }
};

}  // namespace shearfront
