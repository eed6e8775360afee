// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/observers.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

/// Rows of derivatives with respect to n_columns() entries: one row for every state, boundary, initial piece and change outside.
class TangentTable {
 public:
  TangentTable() = default;
  explicit TangentTable(const StateRows& rows, std::size_t n_columns) : rows_(rows), n_(n_columns) {
    phi_.assign(rows.n() * n_, 0.0), flux_.assign(rows.n() * n_, 0.0);
  }

  /// Columns `first` and the following ones; several at once are several times faster.
  struct Column {
    const SceneTangent* scene;
    const StateTangent* states;
  };
  void set(std::size_t first, const std::vector<Column>& columns) {
    const auto put = [&](std::vector<double>& table, const auto& of) {
      const std::size_t n_rows = of(columns.front()).size();
      table.resize(n_rows * n_);
      for (std::size_t i = 0; i < n_rows; ++i)
        for (std::size_t j = 0; j < columns.size(); ++j) table[i * n_ + first + j] = of(columns[j])[i];
    };
    using ByRow = const std::vector<double>&;
    put(phi_, [](const Column& c) -> ByRow { return c.states->phi; });
    put(flux_, [](const Column& c) -> ByRow { return c.states->flux; });
    put(boundary_, [](const Column& c) -> ByRow { return c.scene->boundary; });
    put(top_, [](const Column& c) -> ByRow { return c.scene->top; });
    put(change_, [](const Column& c) -> ByRow { return c.scene->change; });
  }

  [[nodiscard]] std::size_t n_columns() const { return n_; }
  [[nodiscard]] const double* phi(std::size_t layer, State i) const { return &phi_[rows_(layer, i) * n_]; }
  [[nodiscard]] const double* flux(std::size_t layer, State i) const { return &flux_[rows_(layer, i) * n_]; }
  [[nodiscard]] const double* boundary(std::size_t k) const { return &boundary_[k * n_]; }
  [[nodiscard]] const double* top(std::size_t piece) const { return &top_[piece * n_]; }
  [[nodiscard]] const double* change(std::size_t i) const { return &change_[i * n_]; }

 private:
  StateRows rows_;
  std::size_t n_ = 0;
  std::vector<double> phi_, flux_, boundary_, top_, change_;
};

/// Which states are so close that a difference of their derivatives has lost too much.
class CloseStates {
 public:
  template <class Grid>
  [[nodiscard]] bool are(const Grid& grid, std::size_t layer, double rise) {
    constexpr double kClose = 1e-5;  // five of sixteen digits
    if (widths_.empty())
      for (std::size_t k = 0; k < grid.n_layers(); ++k)
        widths_.push_back(std::abs(grid.phi(k, grid.n_states(k) / 2) - grid.phi(k, 0)));
    return !(std::abs(rise) > kClose * widths_[layer]);
  }

 private:
  std::vector<double> widths_;  // per layer: about half of the range of its states
};

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

/// An observer that makes fronts carry derivatives.
///
/// A front l | r of speed s that left a point (z0, t0) is at z0 + s (t - t0); what an entry moves by 1 moves it by
///
///     g + (t - t0) ds,   g = dz0 - s dt0,   ds = (dF_r - dF_l - s (dphi_r - dphi_l)) / (phi_r - phi_l).
///
/// Where two fronts a and b meet in a layer dt = (d_b - d_a) / (s_a - s_b), d what they have been moved at that time, and dz = d_a + s_a dt;
/// at a boundary, which moves by its own dz, dt = (dz - d_a) / s_a. A front that is all that leaves a point of a layer is moved as its
/// mass is: by the mean of d_a and d_b with their jumps of phi as weights.
///
/// Guaranteed: the order of events is that of the run. Events within 64 roundings of their times of each other, so that another
/// order would be as good, and points in which more fronts meet than moved apart would meet again, are counted (order()): derivatives
/// then hold to one side at most. Cost: O(columns) per front; memory 24 bytes per column and front alive.
class FrontTangents {
 public:
  static constexpr bool kActive = true;

  /// ds of a front between states so close that what is said above cancels: called with (column, layer, l, r).
  using CloseSpeed = std::function<double(std::size_t, std::size_t, State, State)>;

  /// Both must outlive this.
  FrontTangents(const TangentTable& table, const std::vector<double>& initial_tops, CloseSpeed close_speed)
      : table_(&table),
        tops_(&initial_tops),
        close_speed_(std::move(close_speed)),
        n_(table.n_columns()),
        dt_(n_),
        dz_(n_),
        a_(n_),
        b_(n_) {}

  template <class Grid>
  void collision(const Grid& grid, const CollisionView<double>& view) {
    const bool is_merged = view.incoming.size() == 2 && view.outgoing.size() == 1 &&
                           view.boundary == CollisionView<double>::kNoBoundary;
    if (view.incoming.empty())
      begin(view);
    else
      meet(view);
    for (const FrontView<double>& f : view.outgoing) {
      const double* boundary = nullptr;
      if (view.boundary != CollisionView<double>::kNoBoundary)
        boundary = table_->boundary(f.z == grid.boundary(f.layer) ? f.layer : f.layer + 1);
      const double* dz = boundary ? boundary : dz_.data();
      double* row = row_of(f.slot);
      for (std::size_t j = 0; j < n_; ++j) row[j] = dz[j] - f.speed * dt_[j];
      set_speed(grid, f, row + n_);
      std::copy(dt_.begin(), dt_.end(), row + 2 * n_);
    }
    if (is_merged) merge(grid, view);
  }

  /// Where a front is moved to at time t, by column.
  void moved(const FrontView<double>& f, double t, double* to) const {
    const double *row = &rows_[3 * n_ * f.slot], age = t - f.t;
    for (std::size_t j = 0; j < n_; ++j) to[j] = row[j] + age * row[n_ + j];
  }
  /// Derivatives of the time at which it was born, by column.
  [[nodiscard]] const double* births(const FrontView<double>& f) const {
    return &rows_[3 * n_ * f.slot + 2 * n_];
  }
  [[nodiscard]] const TangentTable& table() const { return *table_; }
  [[nodiscard]] const OrderCheck& order() const { return order_; }

 private:
  /// Where fronts begin without one that ends: at time 0, or where the state outside changes.
  void begin(const CollisionView<double>& view) {
    const double *dz = nullptr, *dt = nullptr;
    if (view.t > 0) dt = table_->change(n_changes_++);
    if (view.boundary != CollisionView<double>::kNoBoundary)
      dz = table_->boundary(view.boundary);
    else
      dz = table_->top(
          static_cast<std::size_t>(std::lower_bound(tops_->begin(), tops_->end(), view.z) - tops_->begin()));
    for (std::size_t j = 0; j < n_; ++j) dz_[j] = dz[j], dt_[j] = dt ? dt[j] : 0;
  }
  void meet(const CollisionView<double>& view) {
    const FrontView<double>&a = view.incoming.front(), &b = view.incoming.back();
    moved(a, view.t, a_.data());
    std::size_t n_needed = 1;
    if (view.boundary != CollisionView<double>::kNoBoundary) {
      const double* dz = table_->boundary(view.boundary);
      for (std::size_t j = 0; j < n_; ++j) dz_[j] = dz[j], dt_[j] = (dz[j] - a_[j]) / a.speed;
    } else {
      n_needed = 2;
      moved(b, view.t, b_.data());
      const double closing = a.speed - b.speed;
      for (std::size_t j = 0; j < n_; ++j) {
        dt_[j] = closing != 0 ? (b_[j] - a_[j]) / closing : 0;
        dz_[j] = a_[j] + a.speed * dt_[j];
      }
    }
    order_.see(view, n_needed);
  }
  template <class Grid>
  void merge(const Grid& grid, const CollisionView<double>& view) {
    const FrontView<double>&a = view.incoming.front(), &f = view.outgoing.front();
    const double phi_l = grid.phi(f.layer, f.below), phi_r = grid.phi(f.layer, f.above),
                 share =
                     phi_r != phi_l ? (phi_r - grid.phi(f.layer, a.above)) / (phi_r - phi_l) : 0.5;  // of b
    double* row = row_of(f.slot);
    for (std::size_t j = 0; j < n_; ++j) row[j] = a_[j] + share * (b_[j] - a_[j]);
  }
  template <class Grid>
  void set_speed(const Grid& grid, const FrontView<double>& f, double* speed) {
    const double *phi_l = table_->phi(f.layer, f.below), *phi_r = table_->phi(f.layer, f.above);
    const double *flux_l = table_->flux(f.layer, f.below), *flux_r = table_->flux(f.layer, f.above);
    const double rise = grid.phi(f.layer, f.above) - grid.phi(f.layer, f.below), jump = 1 / rise;
    if (close_.are(grid, f.layer, rise)) {
      for (std::size_t j = 0; j < n_; ++j) speed[j] = close_speed_(j, f.layer, f.below, f.above);
      return;
    }
    for (std::size_t j = 0; j < n_; ++j)
      speed[j] = (flux_r[j] - flux_l[j] - f.speed * (phi_r[j] - phi_l[j])) * jump;
  }
  [[nodiscard]] double* row_of(std::uint32_t slot) {
    if (rows_.size() < 3 * n_ * (std::size_t{slot} + 1)) rows_.resize(3 * n_ * (std::size_t{slot} + 1));
    return &rows_[3 * n_ * slot];
  }

  const TangentTable* table_;
  const std::vector<double>* tops_;
  CloseSpeed close_speed_;
  std::size_t n_, n_changes_ = 0;
  std::vector<double> dt_, dz_, a_, b_;  // of the point, and what two fronts have moved there
  std::vector<double> rows_;             // per slot: g, ds and dt0
  CloseStates close_;
  OrderCheck order_;
};

}  // namespace shearfront
