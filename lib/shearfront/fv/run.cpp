// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "shearfront/fv/cell_profile.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/riemann/overload.hpp"

namespace shearfront::fv {
namespace {

constexpr double kMostUpdates = 1e15;  // some days
// The caller is asked for leave to go on after so many cell updates, some thousandths of a second.
constexpr double kUpdatesPerCall = 1 << 22;
// A bed that changes by no more than this in a step, and is where it ends, is at rest: the two mixed cells of an
// Engquist-Osher shock may hand a quantum to and fro for ever.
constexpr double kRestChange = 4 * March::kQuantum;
// M of a bed at rest this near to that of the steady state, relative to what the bed holds, has reached it.
constexpr double kSteadyTolerance = 1e-9;
// For the time of the settled state, which itself needs no march: so many steps per cell (beds whose rates do not differ much
// take some ten), but milliseconds at least and ten seconds at most.
constexpr double kStepsPerCellToRest = 256, kLeastUpdatesForRestTime = 0x1p22,
                 kMostUpdatesForRestTime = 0x1p33;
// Steps per cell after which a bed that does not come to rest is given up, if its last state is asked for.
constexpr double kMostStepsPerCell = 1000;
// Times the waves cross a bed between walls before it rests, at most.
constexpr double kCrossingsToRest = 10;

using Outside = std::optional<OutsideState<double>>;

/// Right after time t; NaN for a wall.
double share_outside(const Outside& state, double t) {
  if (!state) return std::nan("");
  const auto k = std::upper_bound(state->breaks.begin(), state->breaks.end(), t) - state->breaks.begin();
  return state->values[static_cast<std::size_t>(k)];
}
double next_break(const Outside& state, double t) {
  if (!state) return infinity<double>();
  const auto next = std::upper_bound(state->breaks.begin(), state->breaks.end(), t);
  return next == state->breaks.end() ? infinity<double>() : *next;
}

class GridRun final : public Run {
 public:
  GridRun(const Scheme& scheme, const Scene<double>& scene, const GridOptions& options, Progress progress)
      : scene_(scene),
        progress_(std::move(progress)),
        grid_(grid_of(scene, options)),
        march_(scheme, scene, grid_),
        dt_(options.cfl * march_.largest_step()),
        n_cells_(static_cast<double>(grid_.n_cells())) {
    for (const double capacity : march_.capacities()) capacity_ += capacity;
    if (march_.has_steady_state()) steps_to_rest_ = kCrossingsToRest * (march_.crossing_time() / dt_);
    enter(0);
  }

  Status advance(double t) override {
    field_.reset();
    status_ = go_to(t);
    if (status_ != Status::ok) return status_;
    if (!std::all_of(cells_.x.begin(), cells_.x.end(), [](double x) { return std::isfinite(x); }))
      return status_ = Status::diverged;
    return status_ = is_at_rest_ ? Status::steady : Status::ok;
  }

  [[nodiscard]] const Field& field() override {
    if (!field_) field_.emplace(scene_, cell_profile(scene_, grid_, cells_));
    return *field_;
  }

  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message = message();
    summary.cell_updates = n_updates_;
    summary.rest_time = rest_time_;
    return summary;
  }

 private:
  void enter(double begin) {
    const Outside &bottom = scene_.spec().outside_bottom, &top = scene_.spec().outside_top;
    begin_ = begin;
    n_steps_ = 0;
    next_check_ = steps_per_check();
    next_break_ = std::min(next_break(bottom, begin), next_break(top, begin));
    march_.set_outside({share_outside(bottom, begin), share_outside(top, begin)});
  }

  Status go_to(double t) {
    while (next_break_ <= t && std::isfinite(next_break_)) {
      const double whole = std::floor((next_break_ - begin_) / dt_);
      if (const Status status = march_to(whole); status != Status::ok) return status;
      march_.step(std::max(0.0, next_break_ - begin_ - whole * dt_));
      n_updates_ += grid_.n_cells();
      enter(next_break_);
    }
    const bool is_final = !std::isfinite(t);
    if (is_final && march_.has_steady_state()) {
      if (const Status status = find_rest_time(); status != Status::ok) return status;
      march_.settle();
      is_at_rest_ = true;
      cells_ = march_.shares();
      return Status::ok;
    }
    const double steps = is_final ? kMostStepsPerCell * n_cells_ : (t - begin_) / dt_,
                 whole = std::floor(steps);
    if (const Status status = march_to(whole); status != Status::ok) return status;
    if (is_final && !is_at_rest_) return Status::not_converged;
    if (is_final) rest_time_ = begin_ + dt_ * n_steps_;
    const double rest = is_at_rest_ ? 0 : (steps - whole) * dt_;
    if (rest > 0) n_updates_ += grid_.n_cells();
    cells_ = march_.shares_after(rest);
    return Status::ok;
  }

  /// Up to so many steps since the last break; fewer if the bed has come to rest for good.
  Status march_to(double steps) {
    while (!is_at_rest_ && n_steps_ < steps) {
      const double end = n_steps_ < steps_to_rest_ ? std::min(steps, steps_to_rest_) : steps;
      if (!(static_cast<double>(n_updates_) + (end - n_steps_) * n_cells_ <= kMostUpdates))
        return Status::budget_reached;
      if (progress_ && !progress_(begin_ + dt_ * n_steps_, n_updates_)) return Status::interrupted;
      const double per_call = std::max(1.0, std::floor(kUpdatesPerCall / n_cells_));
      const double n = std::min({steps - n_steps_, next_check_ - n_steps_, per_call});
      for (double i = 1; i < n; ++i) march_.step(dt_);
      n_steps_ += n;
      n_updates_ += static_cast<std::uint64_t>(n * n_cells_);
      n_steps_ < next_check_ ? march_.step(dt_) : step_and_check_rest();
    }
    if (!march_.has_steady_state() || is_steady_) return Status::ok;
    // What rounding has stopped or will have taken by then is too much if the bed is not steady.
    return steps * (March::kQuantum / 4 / capacity_) < kSteadyTolerance ? Status::ok : Status::not_converged;
  }

  /// A wave crosses the bed in as many steps as there are cells, at least: no need to look for rest more often.
  [[nodiscard]] double steps_per_check() const { return std::max(1024.0, n_cells_); }

  void step_and_check_rest() {
    next_check_ = n_steps_ + steps_per_check();
    const std::vector<double> before = march_.amounts();
    march_.step(dt_);
    double change = 0;
    for (std::size_t j = 0; j < before.size(); ++j)
      change = std::max(change, std::abs(march_.amounts()[j] - before[j]));
    if (std::isfinite(next_break_) || !(change <= kRestChange)) return;
    is_steady_ = march_.has_steady_state() && is_near_steady();
    is_at_rest_ = change == 0 || is_steady_ || !march_.has_steady_state();
  }

  /// On until the bed is near its settled state, or that takes too long.
  Status find_rest_time() {
    constexpr double kLooksPerCrossing = 64;
    const double per_look = std::max(1.0, std::floor(n_cells_ / kLooksPerCrossing));
    const double most =
        static_cast<double>(n_updates_) + std::clamp(kStepsPerCellToRest * n_cells_ * n_cells_,
                                                     kLeastUpdatesForRestTime, kMostUpdatesForRestTime);
    std::optional<March> before;  // the last look
    while (!is_near_steady()) {
      const bool is_stopped = n_steps_ > steps_to_rest_;  // by rounding
      if (is_stopped || static_cast<double>(n_updates_) + per_look * n_cells_ > most) return Status::ok;
      if (progress_ && !progress_(begin_ + dt_ * n_steps_, n_updates_)) return Status::interrupted;
      before = march_;
      for (double i = 0; i < per_look; ++i) march_.step(dt_);
      n_steps_ += per_look;
      n_updates_ += static_cast<std::uint64_t>(per_look * n_cells_);
    }
    if (before) {  // to the step
      march_ = std::move(*before);
      for (n_steps_ -= per_look; !is_near_steady(); ++n_steps_) march_.step(dt_);
    }
    rest_time_ = begin_ + dt_ * n_steps_;
    return Status::ok;
  }

  [[nodiscard]] bool is_near_steady() const {
    const std::vector<double> settled = march_.settled_amounts();
    double amount = 0, largest = 0;
    for (std::size_t j = 0; j < settled.size(); ++j)
      largest = std::max(largest, std::abs(amount += march_.amounts()[j] - settled[j]));
    return largest <= kSteadyTolerance * 2 * capacity_;
  }

  [[nodiscard]] std::string message() const {
    switch (status_) {
      case Status::steady:
        return "steady state reached";
      case Status::interrupted:
        return "interrupted after " + std::to_string(n_updates_) + " cell updates";
      case Status::budget_reached:
        return "more than " + number_text(kMostUpdates) + " cell updates are needed; use fewer cells";
      case Status::not_converged:
        return march_.has_steady_state()
                   ? "the rates or widths of the cells differ so much that rounding stops the slow ones"
                   : "the bed has not come to rest; ask for a finite time";
      case Status::diverged:
        return "the scheme has diverged: its fluxes do not match between unequal cells";
      default:
        return "reached the last time";
    }
  }

  const Scene<double>& scene_;
  Progress progress_;
  Grid grid_;
  March march_;
  double dt_, n_cells_;
  double capacity_ = 0;  ///< of the bed, in the units of the march
  double steps_to_rest_ = infinity<double>();
  double begin_ = 0, next_break_ = 0;    ///< breaks of the states outside around the present
  double n_steps_ = 0, next_check_ = 0;  ///< since begin_
  std::uint64_t n_updates_ = 0;
  std::optional<double> rest_time_;
  bool is_at_rest_ = false, is_steady_ = false;
  Status status_ = Status::ok;
  CellShares cells_;
  std::optional<ProfileField> field_;
};

}  // namespace

Grid grid_of(const Scene<double>& scene, const GridOptions& options) {
  const auto cells = static_cast<std::size_t>(options.cells);
  return options.align_cells ? aligned_cells(scene, cells) : equal_cells(scene, cells);
}

std::string refusal(const Scheme& scheme, const Scene<double>& scene, const GridOptions& options) {
  if (scene.has_diffusion()) return "this scheme knows no diffusion";
  std::string why;
  options.fields(options, [&](const OptionInfo& info, const auto& member) {
    const auto number = static_cast<double>(member);
    if (why.empty() && !(info.range.contains(number)))
      why = std::string(info.name) + " = " + number_text(number) + "; must be " +
            (info.range.excludes_low ? "> " : ">= ") + number_text(info.range.low) +
            " and <= " + number_text(info.range.high);
  });
  if (!why.empty()) return why;
  for (const Flux<double>& model : scene.fluxes()) {
    const FluxShape flux(model);
    const bool has_one = flux.has_one_extremum() && flux.vanishes;
    const std::string name = "flux " + std::string(model.name());
    if (!is_monotone(scheme.rule) && !flux.is_parabola)
      return name + " has no values for shares beyond its range, where this scheme goes";
    if (scheme.limiter && !(has_one && scene.fluxes().size() == 1 && scene.has_walls()))
      return "it takes one flux with one extremum that vanishes at both ends of its range, and walls";
    if (flux.is_monotone() || scene.is_uniform()) continue;
    if (!has_one)
      return name +
             " has no exact flux between cells of unequal rate or solid fraction: it must have one extremum "
             "and vanish at both ends of its range, or none";
  }
  if (!scene.is_uniform() && is_monotone(course_of(scene.fluxes().front()))) return overload(scene);
  return "";
}

double order_M(const Guarantees& promised, const Scene<double>& scene) {
  constexpr int kParts = 64;
  for (const Flux<double>& flux : scene.fluxes()) {
    const auto [lowest, highest] = flux.range();
    const double part = (highest - lowest) / kParts;
    for (int i = 0; i < kParts; ++i)
      if (is_straight(flux, lowest + i * part, lowest + (i + 1) * part)) return promised.least_order_M;
  }
  return promised.order_M;
}

std::unique_ptr<Run> start(const Scheme& scheme, const Scene<double>& scene, const GridOptions& options,
                           const Watch& watch) {
  return std::make_unique<GridRun>(scheme, scene, options, watch.progress);
}

}  // namespace shearfront::fv
