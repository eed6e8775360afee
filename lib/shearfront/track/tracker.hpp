// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/track/front_list.hpp"
#include "shearfront/track/front_system.hpp"
#include "shearfront/track/observers.hpp"
#include "shearfront/track/pieces.hpp"
#include "shearfront/track/snapshot.hpp"

namespace shearfront {

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
///   (2) mass is conserved at every event to a few units in the last place of the largest height, however many
///       events: positions are unevaluated sums of two numbers and a front leaves from the point that
///       conserves mass;
///   (3) fronts never cross; phi never leaves the range of the grid;
///   (4) equal input gives bitwise equal output; advance_to(t1), advance_to(t2) equals advance_to(t2), and so
///       does a copy;
///   (5) observers cannot steer.
/// What rounding costs in the worst cases: docs/evidence/stability.md.
/// A Tracker is a value: copy it to keep a state to return to.
/// Cost: O(log n) per event for n fronts that are about to meet; memory 64 bytes per front (double).
///
/// With a System of curved fronts (track/curved_system.hpp) of (1) to (5) hold (4), (5), and what that promises.
template <class Grid, class Observer = NoObserver, class System = FrontSystem<Grid, Observer>>
class Tracker {
 public:
  using Scalar = typename Grid::Scalar;

  /// `pieces` fill the domain from bottom to top; every interface must be the top of a piece. The state is
  /// taken at time 0. `grid` must outlive the tracker. A periodic bed has no steady state that rounding would not
  /// disturb: give it finite times. Where ends are not walls, mass is kept only between what comes in and goes out.
  /// With more than `max_fronts` alive it stops, and keeps no more than twice the memory of these.
  Tracker(const Grid& grid, const std::vector<Piece<Scalar>>& pieces, const Ends<Scalar>& ends,
          Observer observer = {}, std::size_t max_fronts = SIZE_MAX)
      : system_(grid, pieces, ends, std::move(observer), max_fronts), changes_(ends.changes) {}
  explicit Tracker(System system, std::vector<typename Ends<Scalar>::Change> changes = {})
      : system_(std::move(system)), changes_(std::move(changes)) {}
  /// What a TrackingSetup holds, which must outlive the tracker.
  template <class Setup>
  explicit Tracker(const Setup& setup, Observer observer = {}) requires requires {
    setup.ends;
  } : Tracker(setup.grid, setup.pieces, setup.ends, std::move(observer)) {
  }

  /// Runs to time t, events at t included. Precondition: t >= time().
  /// Returns ok, or steady if nothing will ever happen again. After budget_reached or interrupted the fronts
  /// are not all at one time: only the counters may be read.
  Status advance_to(const Scalar& t, const RunLimits& limits = {}) {
    SHEARFRONT_EXPECTS(t >= time(), "a time that is not past");
    while (n_changed_ < changes_.size() && !(changes_[n_changed_].t > t)) {
      const auto& change = changes_[n_changed_];
      const Status status = run_to(change.t, limits);
      if (status != Status::ok && status != Status::steady) return status;
      system_.change_outside(change.end, change.state);
      ++n_changed_;
    }
    return run_to(t, limits);
  }
  /// Runs until nothing will ever happen again; time() is then that of the last collision.
  Status run_to_steady(const RunLimits& limits = {}) { return advance_to(infinity<Scalar>(), limits); }

  /// Handles the next collision in time; false if there is none.
  bool step() {
    system_.agenda().collect(system_.fronts(), infinity<Scalar>(), Scalar(0));
    const auto next = system_.agenda().take(system_.fronts());
    if (!next) return false;
    system_.collide(next->id);
    return true;
  }

  [[nodiscard]] const System& system() const { return system_; }
  [[nodiscard]] const Grid& grid() const { return system_.grid(); }
  /// What it has seen so far, without the fronts alive.
  [[nodiscard]] const Observer& observer() const { return system_.observer(); }
  [[nodiscard]] const Scalar& time() const { return system_.time(); }
  /// Whether nothing will ever happen again.
  [[nodiscard]] bool is_steady() const {
    return system_.agenda().n_pending() == 0 && n_unreachable() == 0 && n_changed_ == changes_.size();
  }
  /// State beyond the bottom (0) or the top (1) of the bed; none at a wall.
  [[nodiscard]] const std::optional<State>& outside(std::size_t end) const { return system_.outside(end); }
  [[nodiscard]] bool is_periodic() const { return system_.is_periodic(); }
  /// Time of the last collision so far; 0 if there was none.
  [[nodiscard]] const Scalar& last_collision() const { return system_.last_collision(); }
  [[nodiscard]] std::uint64_t n_collisions() const { return system_.n_collisions(); }
  [[nodiscard]] std::size_t n_fronts() const { return system_.n_fronts(); }
  [[nodiscard]] std::size_t n_fronts_max() const { return system_.n_fronts_max(); }
  /// Whether budget_reached was that of the fronts.
  [[nodiscard]] bool has_too_many_fronts() const { return system_.has_too_many_fronts(); }
  /// Fronts that would meet only after the largest representable time.
  [[nodiscard]] std::size_t n_unreachable() const { return system_.agenda().n_unreachable(); }

  /// First and last time at which a wave met boundary k (0 the bottom wall, n_layers the top wall); waves
  /// that leave it at time 0 count as met at 0.
  [[nodiscard]] const std::optional<Scalar>& first_wave(std::size_t k) const {
    return system_.waves(k).first;
  }
  /// The first one, where it is the edge of a fan the characteristic there, which is faster than any front.
  [[nodiscard]] const std::optional<Scalar>& first_edge(std::size_t k) const {
    return system_.waves(k).first_edge;
  }
  [[nodiscard]] const std::optional<Scalar>& last_wave(std::size_t k) const { return system_.waves(k).last; }

  /// Fronts and boundaries at the current time from bottom to top: visit(is_boundary, view, z).
  /// For a boundary view.layer is its index, view.below and view.above the states on its two sides (0 outside
  /// the walls).
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    const FrontList<Scalar>& fronts = system_.fronts();
    fronts.for_each([&](FrontIndex i, const auto& node) {
      visit(fronts.is_boundary(i), fronts.view_of(i), node.position(time()));
    });
  }
  [[nodiscard]] Snapshot<Scalar> snapshot() const { return snapshot_of(grid(), system_.fronts(), time()); }
  /// The piecewise constant solution at the current time. Cost: O(fronts).
  [[nodiscard]] Profile<Scalar> profile() const {
    Snapshot<Scalar> s = snapshot();
    std::vector<Scalar> phi(s.state.size());
    for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = grid().phi(s.layer[i], s.state[i]);
    return {std::move(s.z), phi, phi};
  }
  /// Mass at the current time from the unrounded positions.
  [[nodiscard]] Scalar mass() const { return mass_of(grid(), system_.fronts(), time()); }

  /// What the observer has seen, fronts still alive ended at the current time. Cost: a copy of the record,
  /// sorted.
  [[nodiscard]] Observer record() const requires(Observer::kActive) {
    Observer observer = system_.observer();
    const FrontList<Scalar>& fronts = system_.fronts();
    fronts.for_each([&](FrontIndex i, const auto& node) {
      if (!fronts.is_boundary(i)) observer.end_of(grid(), fronts.view_of(i), time(), node.position(time()));
    });
    observer.close();
    return observer;
  }

 private:
  static constexpr std::uint64_t kCollisionsPerReport = 1 << 14;

  /// Precondition: the state beyond the ends does not change before t.
  Status run_to(const Scalar& t, const RunLimits& limits) {
    // In the order of t + skew z. A meeting can only influence another one that waves of speed <= fastest()
    // can reach from it, and that one has a greater key; so this order respects every influence, like that of
    // t. It sweeps through the bed instead of jumping about in it, and what it touches is in the cache.
    // Denormal speeds have no finite skew; then in the order of t.
    Scalar skew(0);
    if constexpr (requires { grid().fastest(); }) skew = Scalar(1) / (Scalar(2) * grid().fastest());
    if (system_.has_too_many_fronts()) return Status::budget_reached;
    auto& agenda = system_.agenda();
    // In a periodic bed what happens at the top has its effect at the bottom.
    agenda.collect(system_.fronts(), t, is_finite(skew) && !system_.is_periodic() ? skew : Scalar(0));
    while (const auto next = agenda.take(system_.fronts())) {
      if (n_collisions() >= limits.max_collisions) {
        agenda.put_back(*next);
        return Status::budget_reached;
      }
      system_.collide(next->id);
      if (system_.has_too_many_fronts()) return Status::budget_reached;
      agenda.tidy(system_.fronts());
      if (n_collisions() % kCollisionsPerReport == 0 && limits.keep_going &&
          !limits.keep_going(to_double(time()), n_collisions()))
        return Status::interrupted;
    }
    system_.set_time(is_finite(t) ? t : last_collision());
    return is_steady() ? Status::steady : Status::ok;
  }

  System system_;
  std::vector<typename Ends<Scalar>::Change> changes_;
  std::size_t n_changed_ = 0;  ///< of the changes, those that have happened
};

}  // namespace shearfront
