// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shearfront/track/agenda.hpp"
#include "shearfront/track/curved_front.hpp"
#include "shearfront/track/curved_record.hpp"
#include "shearfront/track/curved_start.hpp"
#include "shearfront/track/observers.hpp"

namespace shearfront {

/// Fronts between levels in a bed whose rate varies, and what happens when they meet, reach a boundary or turn.
/// A Tracker decides up to which time.
///
/// Where fronts of a piece meet one front leaves; at walls, jumps and kinks the flux is the least of what both sides can send
/// and take, each no more than its capacity. A front turns where the level next to its higher one turns: beyond there the
/// higher one may not be.
template <class Observer = NoObserver>
class CurvedSystem {
 public:
  using Scalar = double;
  using Fronts = FrontList<double, CurvedNode>;

  struct Waves {
    std::optional<double> first, last;
    std::optional<double>
        first_edge;  ///< the first, where it is the edge of a fan that of its characteristic
  };

  CurvedSystem(const LevelCurves& grid, const CurvedProblem& problem, Observer observer,
               std::size_t max_fronts);

  [[nodiscard]] const LevelCurves& grid() const { return *grid_; }
  [[nodiscard]] Observer& observer() { return observer_; }
  [[nodiscard]] const Observer& observer() const { return observer_; }
  [[nodiscard]] const Fronts& fronts() const { return fronts_; }
  [[nodiscard]] EventAgenda<Fronts>& agenda() { return agenda_; }
  [[nodiscard]] const EventAgenda<Fronts>& agenda() const { return agenda_; }
  [[nodiscard]] const Waves& waves(std::size_t boundary) const { return waves_[boundary]; }
  [[nodiscard]] const double& time() const { return now_; }
  void set_time(double t) { now_ = t; }
  [[nodiscard]] const double& last_collision() const { return last_collision_; }
  [[nodiscard]] std::uint64_t n_collisions() const { return collisions_; }
  [[nodiscard]] std::size_t n_fronts() const { return fronts_.n_fronts(); }
  [[nodiscard]] std::size_t n_fronts_max() const { return n_fronts_max_; }
  [[nodiscard]] bool has_too_many_fronts() const { return n_fronts_max_ > max_fronts_; }
  [[nodiscard]] bool is_periodic() const { return is_periodic_; }
  /// State beyond the bottom (0) or the top (1) of the bed; none at a wall.
  [[nodiscard]] const std::optional<State>& outside(std::size_t end) const { return outside_[end]; }
  /// Now another state lies beyond an open end. Precondition: what meets at this time has met.
  void change_outside(std::size_t end, State state);

  /// Handles the next event of node i: it turns, or meets its upper neighbour.
  void collide(FrontIndex i);

 private:
  using Node = CurvedNode;

  void start(const std::vector<StartSegment>& segments);
  void schedule(FrontIndex i);
  FrontIndex emit(FrontIndex under, std::size_t piece, State l, State r, double z);
  FrontIndex emit_left(FrontIndex under, std::size_t piece, State l, std::size_t level, double z, State& at,
                       double edge_t);
  FrontIndex emit_right(FrontIndex under, std::size_t piece, State r, std::size_t level, double z, State& at,
                        double edge_t);
  FrontIndex emit_inside(FrontIndex under, std::size_t piece, State l, State& r, double z);
  FrontIndex emit_at_boundary(FrontIndex b, State l, State r, double edge_t);
  FrontIndex emit_at_seam(FrontIndex b, State l, State r, double edge_t);
  void solve_boundary(FrontIndex b, State l, State r, double edge_t, std::size_t incoming);
  void reach_boundary(FrontIndex mover, FrontIndex b);
  void merge(FrontIndex f, FrontIndex g);
  void turn(FrontIndex f);
  void set_below(FrontIndex i, State state);
  void set_above(FrontIndex i, State state);
  void anchor_beyond(Node& f, std::size_t level);
  void end_course(const Node& f, double z);
  void note(double z, std::size_t boundary, std::size_t incoming, std::size_t outgoing);
  void set_edge(FrontIndex i, double t);
  [[nodiscard]] double arrival_of_edge(const Node& f, double z) const;
  void schedule_all(FrontIndex from, FrontIndex to);
  void remove(FrontIndex i);
  [[nodiscard]] bool is_boundary(FrontIndex i) const { return fronts_.is_boundary(i); }

  const LevelCurves* grid_;
  std::size_t max_fronts_;
  Observer observer_;
  Fronts fronts_;
  EventAgenda<Fronts> agenda_;
  std::vector<Waves> waves_;
  std::array<std::optional<State>, 2> outside_;
  std::vector<bool> continues_;  ///< whether a boundary is between parts of a rate that goes on
  bool is_periodic_;
  double now_ = 0, last_collision_ = 0;
  std::size_t n_fronts_max_ = 0;
  std::uint64_t collisions_ = 0;
};

extern template class CurvedSystem<NoObserver>;
extern template class CurvedSystem<CurvedRecord>;

}  // namespace shearfront
