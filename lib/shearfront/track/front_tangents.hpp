// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "shearfront/track/event_order.hpp"
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

  [[nodiscard]] const StateRows& rows() const { return rows_; }
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
/// Guaranteed: the order of events is that of the run; its signature() and the steps() within which it stays are known (event_order.hpp).
/// Events within 64 roundings of their times of each other, so that another order would be as good, and points in which more fronts meet
/// than moved apart would meet again, are counted (order()): derivatives then hold to one side at most.
/// Cost: O(columns) per front; memory 24 bytes per column and front alive.
class FrontTangents {
 public:
  static constexpr bool kActive = true;

  /// ds of a front between states so close that what is said above cancels: called with (column, layer, l, r).
  using CloseSpeed = std::function<double(std::size_t, std::size_t, State, State)>;

  /// Both must outlive this. Both ends of a periodic bed are one boundary.
  FrontTangents(const TangentTable& table, const std::vector<double>& initial_tops, CloseSpeed close_speed,
                std::size_t n_layers, bool is_periodic)
      : table_(&table),
        tops_(&initial_tops),
        close_speed_(std::move(close_speed)),
        n_(table.n_columns()),
        n_layers_(n_layers),
        is_periodic_(is_periodic),
        dt_(n_),
        dz_(n_),
        a_(n_),
        b_(n_),
        closing_(n_),
        last_t_(n_layers + 1, 0.0),
        last_dt_((n_layers + 1) * n_),
        last_begin_(table.boundary(0), table.boundary(0) + n_),
        has_front_(table.rows().n()),
        signature_(n_layers, is_periodic),
        steps_(n_) {}

  template <class Grid>
  void collision(const Grid& grid, const CollisionView<double>& view) {
    const bool is_merged = view.incoming.size() == 2 && view.outgoing.size() == 1 &&
                           view.boundary == CollisionView<double>::kNoBoundary;
    if (view.incoming.empty())
      begin(grid, view);
    else
      meet(view);
    if (view.t > 0) keep_order(grid, view);
    signature_.see(view);
    for (const FrontView<double>& f : view.outgoing) {
      const double* boundary = nullptr;
      if (view.boundary != CollisionView<double>::kNoBoundary)
        boundary = table_->boundary(f.z == grid.boundary(f.layer) ? f.layer : f.layer + 1);
      const double* dz = boundary ? boundary : dz_.data();
      has_front_[table_->rows()(f.layer, f.below)] = has_front_[table_->rows()(f.layer, f.above)] = true;
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
  [[nodiscard]] const OrderSignature& signature() const { return signature_; }
  [[nodiscard]] const OrderSteps& steps() const { return steps_; }
  /// By StateRows: which states have been on a side of a front.
  [[nodiscard]] const std::vector<bool>& has_front() const { return has_front_; }

 private:
  /// Where fronts begin without one that ends: at time 0, or where the state outside changes.
  template <class Grid>
  void begin(const Grid& grid, const CollisionView<double>& view) {
    const double *dz = nullptr, *dt = nullptr;
    if (view.t > 0) dt = table_->change(n_changes_++);
    if (view.boundary != CollisionView<double>::kNoBoundary)
      dz = table_->boundary(view.boundary);
    else
      dz = table_->top(
          static_cast<std::size_t>(std::lower_bound(tops_->begin(), tops_->end(), view.z) - tops_->begin()));
    for (std::size_t j = 0; j < n_; ++j) dz_[j] = dz[j], dt_[j] = dt ? dt[j] : 0;
    if (view.t > 0 || (view.boundary == CollisionView<double>::kNoBoundary && view.outgoing.empty())) return;
    // From bottom to top: layers, and pieces between which there are fronts, keep their places.
    const double width = view.z - (n_begun_ == 0 ? grid.boundary(0) : last_begin_z_);
    if (width > 0) steps_.keep_positive(width, [&](std::size_t j) { return dz_[j] - last_begin_[j]; });
    ++n_begun_;
    last_begin_z_ = view.z;
    last_begin_ = dz_;
  }
  /// What meets was apart when the last of it began, and neighbours stay beside the point.
  template <class Grid>
  void keep_order(const Grid& grid, const CollisionView<double>& view) {
    const bool is_in_layer = view.boundary == CollisionView<double>::kNoBoundary;
    set_closing(view);
    // A gap at a time before is what is left of time times the closing speed. Times alone are no measure: those of fronts that hardly
    // approach each other are far from linear.
    const auto keep_apart = [&](double since, const double* from) {
      const double per_time = 1 / (view.t - since);
      steps_.keep_positive(1, [&](std::size_t j) { return (dt_[j] - from[j]) * per_time + closing_[j]; });
    };
    for (const FrontView<double>& f : view.incoming) keep_apart(f.t, births(f));
    if (!is_in_layer) {
      const std::size_t k = is_periodic_ && view.boundary == n_layers_ ? 0 : view.boundary;
      double* const from = &last_dt_[k * n_];
      if (last_t_[k] > 0) keep_apart(last_t_[k], from);
      last_t_[k] = view.t;
      std::copy(dt_.begin(), dt_.end(), from);
    }
    if (view.over) keep_beside(grid, view, *view.over, true);
    if (view.under) keep_beside(grid, view, *view.under, false);
  }
  /// How the speed at which what meets has come together changes, relative to it.
  void set_closing(const CollisionView<double>& view) {
    std::fill(closing_.begin(), closing_.end(), 0.0);
    if (view.incoming.empty()) return;
    const FrontView<double>&a = view.incoming.front(), &b = view.incoming.back();
    const bool is_in_layer = view.boundary == CollisionView<double>::kNoBoundary;
    const double speed = a.speed - (is_in_layer ? b.speed : 0);
    if (speed == 0) return;
    const double *by_a = births(a) - n_, *by_b = births(b) - n_, per_speed = 1 / speed;
    if (is_in_layer)
      for (std::size_t j = 0; j < n_; ++j) closing_[j] = (by_a[j] - by_b[j]) * per_speed;
    else
      for (std::size_t j = 0; j < n_; ++j) closing_[j] = by_a[j] * per_speed;
  }
  /// A neighbour that was coming closer, and after this point does so no more, would have been in it had the gap closed before. Where it
  /// still does, it meets what left the point, and the time until then closes with the gap.
  template <class Grid>
  void keep_beside(const Grid& grid, const CollisionView<double>& view, const FrontView<double>& beside,
                   bool is_over) {
    const bool is_in_layer = view.boundary == CollisionView<double>::kNoBoundary;
    const double toward = is_over ? 1 : -1;
    double before = 0,
           after = is_in_layer ? -toward * infinity<double>() : 0;  // speeds of the outermost node
    if (!view.incoming.empty()) {
      const FrontView<double>& f = is_over ? view.incoming.back() : view.incoming.front();
      if (is_in_layer || (f.layer == view.boundary) == is_over) before = f.speed;
    }
    if (!view.outgoing.empty()) {
      const FrontView<double>& f = is_over ? view.outgoing.back() : view.outgoing.front();
      if (is_in_layer || (f.z == grid.boundary(f.layer)) == is_over) after = f.speed;
    }
    if (!(toward * (before - beside.speed) > 0) || toward * (after - beside.speed) > 0) return;
    double z = view.z;
    const double* dz = dz_.data();
    if (!is_in_layer) {
      const std::size_t k = is_over ? beside.layer : beside.layer + 1;
      z = grid.boundary(k);
      dz = table_->boundary(k);
    }
    const double age = view.t - beside.t, gap = toward * (beside.z + beside.speed * age - z);
    if (beside.slot <= n_layers_) {
      const double* to = table_->boundary(beside.layer);
      steps_.keep_positive(gap, [&](std::size_t j) { return toward * (to[j] - dz[j]); });
    } else {
      const double* row = &rows_[3 * n_ * beside.slot];
      steps_.keep_positive(gap, [&](std::size_t j) {
        return toward * (row[j] + age * row[n_ + j] + beside.speed * dt_[j] - dz[j]);
      });
    }
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
  std::size_t n_, n_layers_, n_changes_ = 0, n_begun_ = 0;
  bool is_periodic_;
  std::vector<double> dt_, dz_, a_, b_;   // of the point, and what two fronts have moved there
  std::vector<double> closing_;           // of their closing speed, relative to it
  std::vector<double> rows_;              // per slot: g, ds and dt0
  std::vector<double> last_t_, last_dt_;  // of each boundary: its last event after time 0
  double last_begin_z_ = 0;
  std::vector<double> last_begin_;  // of the last point at time 0
  std::vector<bool> has_front_;
  CloseStates close_;
  OrderCheck order_;
  OrderSignature signature_;
  OrderSteps steps_;
};

}  // namespace shearfront
