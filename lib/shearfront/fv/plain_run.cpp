// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "shearfront/fv/run.hpp"

namespace shearfront::fv {
namespace {

// A bed whose states change by no more than this in a step is at rest: rounding.
constexpr double kRestChange = 0x1p-50;
// Steps per cell after which a bed that does not come to rest is given up, if its last state is asked for.
constexpr double kMostStepsPerCell = 1000;

/// The state beyond an open end; NaN for a wall.
class Outside {
 public:
  explicit Outside(std::optional<OutsideState<double>> state) : state_(std::move(state)) {}

  /// Right after time t.
  [[nodiscard]] double share(double t) const {
    if (!state_) return std::numeric_limits<double>::quiet_NaN();
    const auto& breaks = state_->breaks;
    const auto k = std::upper_bound(breaks.begin(), breaks.end(), t) - breaks.begin();
    return state_->values[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] double next_break(double t) const {
    if (!state_) return infinity<double>();
    const auto next = std::upper_bound(state_->breaks.begin(), state_->breaks.end(), t);
    return next == state_->breaks.end() ? infinity<double>() : *next;
  }

 private:
  std::optional<OutsideState<double>> state_;
};

/// Between two breaks of the states outside: whole steps of one length, and a shorter one to the break.
class PlainRun final : public Run {
 public:
  PlainRun(FaceRule rule, const Scene<double>& scene, const SolverOptions& options)
      : Run(grid_of(scene, options)),
        options_(options),
        march_(rule, scene, grid_, options.face_coefficient),
        dt_(options.cfl * march_.largest_step()),
        can_settle_(scene.has_walls() && (rule == FaceRule::godunov || rule == FaceRule::engquist_osher)),
        bottom_(scene.spec().outside_bottom),
        top_(scene.spec().outside_top),
        last_(march_) {
    enter(0);
  }

  CellStates at(double t, Status& status) override {
    const bool is_final = !std::isfinite(t);
    while (next_break_ <= t) {
      if (std::isinf(next_break_)) break;
      const double whole = std::floor((next_break_ - begin_) / dt_);
      if (status = march_to(whole, next_break_, false); status != Status::ok) return {};
      march_.step(next_break_ - begin_ - whole * dt_);
      n_updates_ += grid_.n_cells;
      enter(next_break_);
    }
    if (is_final && can_settle_) {
      last_ = march_;
      last_.settle();
      is_at_rest_ = true;
      return {last_.states(), {}};
    }
    const double n = static_cast<double>(grid_.n_cells);
    const double steps = is_final ? kMostStepsPerCell * n : (t - begin_) / dt_, whole = std::floor(steps);
    if (status = march_to(whole, t, true); status != Status::ok) return {};
    if (is_final && !is_at_rest_) status = Status::not_converged;
    last_ = march_;
    if (!is_at_rest_ && steps > whole) {
      last_.step((steps - whole) * dt_);
      n_updates_ += grid_.n_cells;
    }
    return {last_.states(), {}};
  }

 private:
  void enter(double begin) {
    begin_ = begin;
    n_steps_ = 0;
    next_break_ = std::min(bottom_.next_break(begin), top_.next_break(begin));
    march_.set_outside({bottom_.share(begin), top_.share(begin)});
  }

  /// Up to so many steps since the last break; fewer if the bed has come to rest for good.
  Status march_to(double steps, double t, bool is_last_break) {
    while (!is_at_rest_ && static_cast<double>(n_steps_) < steps) {
      const auto done = static_cast<double>(n_steps_);
      if (options_.progress && !options_.progress(std::isfinite(t) ? begin_ + dt_ * done : t, n_updates_))
        return Status::interrupted;
      if (static_cast<double>(n_updates_) > kMostUpdates) return Status::budget_reached;
      const std::uint64_t call = std::clamp<std::uint64_t>((kUpdatesPerCall / 16) / grid_.n_cells, 1,
                                                           std::max(kLeastSteps, grid_.n_cells));
      const auto n = static_cast<std::uint64_t>(std::min(static_cast<double>(call), steps - done));
      double largest = 0;
      for (std::uint64_t i = 0; i < n; ++i) largest = march_.step(dt_);
      n_steps_ += n;
      n_updates_ += n * grid_.n_cells;
      is_at_rest_ = is_last_break && std::isinf(next_break_) && largest <= kRestChange;
    }
    return Status::ok;
  }

  const SolverOptions& options_;
  PlainMarch march_;
  double dt_;
  bool can_settle_;
  double begin_ = 0, next_break_ = 0;
  Outside bottom_, top_;
  PlainMarch last_;  ///< after the last, shortened step
  std::uint64_t n_steps_ = 0;
};

}  // namespace

std::unique_ptr<Run> plain_run(FaceRule rule, const Scene<double>& scene, const SolverOptions& options) {
  return std::make_unique<PlainRun>(rule, scene, options);
}

}  // namespace shearfront::fv
