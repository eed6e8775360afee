// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/observers.hpp"
#include "shearfront/track/state_motion.hpp"

/// The order of the events of a run, and how far it stays as it is when numbers of the scene move.
///
/// Events that share a front or a boundary happen one after the other; all others commute, and which of them a run takes first does not
/// matter. So the order is which fronts meet in which point, and what left it: the graph of the fronts in the (t, z) plane.
namespace shearfront {

/// Counts where in a run another order of events would be as good as the one it took: more fronts in a point than it takes, or two events
/// at a boundary or in the life of a front, within 64 roundings of their time.
class OrderCheck {
 public:
  /// A point that takes so many fronts.
  void see(const CollisionView<double>& view, std::size_t n_needed) {
    constexpr double kRoundings = 64;
    const double soon = kRoundings * std::numeric_limits<double>::epsilon() * view.t;
    bool is_undecided = view.incoming.size() > n_needed;
    for (const FrontView<double>& f : view.incoming) is_undecided = is_undecided || view.t - f.t <= soon;
    if (view.boundary != CollisionView<double>::kNoBoundary && view.t > 0) {
      if (last_.size() <= view.boundary) last_.resize(view.boundary + 1, -1.0);
      double& last = last_[view.boundary];
      is_undecided = is_undecided || view.t - last <= soon;
      last = view.t;
    }
    if (is_undecided && n_undecided_++ == 0) first_ = {view.t, view.z};
  }
  [[nodiscard]] std::size_t n_undecided() const { return n_undecided_; }
  /// Why derivatives hold to one side at most; empty if they hold.
  [[nodiscard]] std::string remark() const {
    if (n_undecided_ == 0) return {};
    return "the order of events is not decided in " + std::to_string(n_undecided_) +
           " points, the first at t = " + number_text(first_.t) + ", z = " + number_text(first_.z) +
           ": derivatives hold to one side of the numbers at most";
  }

 private:
  std::size_t n_undecided_ = 0;
  Place first_;
  std::vector<double> last_;  // event at each boundary
};

/// A number of 64 bits for the order of events: that of a point is made from those of the fronts that met there, of the last point at its
/// boundary, and of the states that left it, and the points are added up, so that events that commute may come in any order.
///
/// Equal orders have equal numbers; different ones differ but for one chance in 2^64.
class OrderSignature {
 public:
  /// Both ends of a periodic bed are one boundary.
  OrderSignature(std::size_t n_layers, bool is_periodic)
      : boundaries_(n_layers + 1), n_layers_(is_periodic ? n_layers : 0) {}

  void see(const CollisionView<double>& view) {
    const bool is_in_layer = view.boundary == CollisionView<double>::kNoBoundary;
    std::uint64_t* const boundary =
        is_in_layer ? nullptr : &boundaries_[view.boundary == n_layers_ ? 0 : view.boundary];
    std::uint64_t point = joined(view.boundary, boundary ? *boundary : 0);
    if (view.incoming.empty()) point = joined(point, n_begun_++);
    for (const FrontView<double>& f : view.incoming) point = joined(point, fronts_[f.slot]);
    for (const FrontView<double>& f : view.outgoing)
      point = joined(joined(point, static_cast<std::uint64_t>(f.below)), static_cast<std::uint64_t>(f.above));
    std::uint64_t n = 0;
    for (const FrontView<double>& f : view.outgoing) {
      if (fronts_.size() <= f.slot) fronts_.resize(std::size_t{f.slot} + 1);
      fronts_[f.slot] = joined(point, ++n);
    }
    if (boundary) *boundary = joined(point, 0);
    sum_ += point;
  }
  /// With the number of levels in the grid, by which states are numbered, and that of each state of the scene that has a front (0: none).
  [[nodiscard]] std::uint64_t value(std::size_t n_levels, const std::vector<State>& states) const {
    std::uint64_t all = joined(sum_, n_levels);
    for (const State i : states) all = joined(all, static_cast<std::uint64_t>(i));
    return all;
  }

 private:
  /// Scrambled as in SplitMix64 (Steele, Lea & Flood 2014).
  [[nodiscard]] static std::uint64_t joined(std::uint64_t a, std::uint64_t b) {
    std::uint64_t x = a * 0x9e3779b97f4a7c15U + b + 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
  }

  std::vector<std::uint64_t> fronts_, boundaries_;  // fronts by slot
  std::size_t n_layers_;                            // where boundary is the first one; 0 if none is
  std::uint64_t n_begun_ = 0, sum_ = 0;
};

/// How far each entry may move alone while numbers that are positive stay so, to first order.
class OrderSteps {
 public:
  explicit OrderSteps(std::size_t n_columns) : least_(n_columns, 0.0), most_(n_columns, 0.0) {}

  /// A positive number that column j moves by by(j).
  template <class By>
  void keep_positive(double number, const By& by) {
    const double scale = 1 / std::max(number, std::numeric_limits<double>::min());
    double *const least = least_.data(), *const most = most_.data();
    const std::size_t n = least_.size();
    for (std::size_t j = 0; j < n; ++j) {
      const double x = by(j) * scale;
      least[j] = x < least[j] ? x : least[j];
      most[j] = x > most[j] ? x : most[j];
    }
  }
  /// States of a layer, moved by column j, stay as they follow each other beside those that have a front, and so do their fluxes.
  template <class Grid>
  void keep_states(const Grid& grid, const StateRows& rows, const std::vector<bool>& has_front, std::size_t j,
                   const StateTangent& states) {
    const auto keep = [&](double gap, double by) {
      if (gap == 0) return;
      least_[j] = std::min(least_[j], by / gap);
      most_[j] = std::max(most_[j], by / gap);
    };
    for (std::size_t k = 0; k < grid.n_layers(); ++k)
      for (State i = 0; i + 1 < grid.n_states(k); ++i) {
        const std::size_t row = rows(k, i);
        if (!has_front[row] && !has_front[row + 1]) continue;
        keep(grid.phi(k, i + 1) - grid.phi(k, i), states.phi[row + 1] - states.phi[row]);
        keep(grid.flux(k, i + 1) - grid.flux(k, i), states.flux[row + 1] - states.flux[row]);
      }
  }
  [[nodiscard]] StepRange range(std::size_t j) const {
    StepRange range;
    if (most_[j] > 0) range.down = 1 / most_[j];
    if (least_[j] < 0) range.up = -1 / least_[j];
    return range;
  }

 private:
  std::vector<double> least_, most_;  // of by(j) / number, and 0
};

}  // namespace shearfront
