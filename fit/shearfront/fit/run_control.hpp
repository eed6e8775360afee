// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <chrono>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/fit/estimate.hpp"

namespace shearfront::fit {

/// Counts the evaluations of a whole fit, over all its searches, and ends it when told to.
class RunControl {
 public:
  /// How long runs of the forward model may go on after an interruption: enough for the report of a fit whose runs are
  /// short, and not felt by who waits.
  static constexpr std::chrono::milliseconds kGrace{50};

  explicit RunControl(std::size_t max_evaluations, Progress progress = {})
      : max_evaluations_(max_evaluations), progress_(std::move(progress)) {}

  /// One run of the forward model gave this misfit (infinite: no solution).
  void count(double misfit) {
    ++evaluations_;
    if (misfit < best_) {
      best_ = misfit;
      steps_.push_back({evaluations_, misfit, stage_});
    }
    ask();
  }
  /// Whether a run of the forward model may begin or go on; asked now and then within it.
  [[nodiscard]] bool may_run() {
    ask();
    return !interrupted_ || Clock::now() - *interrupted_ < kGrace;
  }
  /// For runs of the same fit that are not counted here.
  [[nodiscard]] RunControl for_part(std::size_t max_evaluations) const {
    RunControl part(max_evaluations, progress_);
    part.interrupted_ = interrupted_;
    return part;
  }
  /// A new stage minimises another misfit: what was best before cannot be compared.
  void new_stage() {
    best_ = std::numeric_limits<double>::infinity();
    ++stage_;
  }

  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }
  [[nodiscard]] bool is_interrupted() const { return interrupted_.has_value(); }
  [[nodiscard]] bool is_exhausted() const { return evaluations_ >= max_evaluations_; }
  [[nodiscard]] bool must_stop() const { return is_interrupted() || is_exhausted(); }
  [[nodiscard]] std::size_t left() const { return is_exhausted() ? 0 : max_evaluations_ - evaluations_; }
  [[nodiscard]] const std::vector<SearchStep>& steps() const { return steps_; }

 private:
  using Clock = std::chrono::steady_clock;
  void ask() {
    if (!interrupted_ && progress_ && !progress_(evaluations_, best_)) interrupted_ = Clock::now();
  }

  std::size_t max_evaluations_, evaluations_ = 0, stage_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
  std::optional<Clock::time_point> interrupted_;  ///< when
  Progress progress_;
  std::vector<SearchStep> steps_;
};

}  // namespace shearfront::fit
