// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "shearfront/fit/estimate.hpp"

namespace shearfront::fit {

/// Counts the evaluations of a whole fit, over all its searches, and ends it when told to.
class RunControl {
 public:
  explicit RunControl(std::size_t max_evaluations, Progress progress = {})
      : max_evaluations_(max_evaluations), progress_(std::move(progress)) {}

  /// One run of the forward model gave this misfit (infinite: no solution).
  void count(double misfit) {
    ++evaluations_;
    if (misfit < best_) {
      best_ = misfit;
      steps_.push_back({evaluations_, misfit, stage_});
    }
    if (progress_ && !progress_(evaluations_, best_)) interrupted_ = true;
  }
  /// A new stage minimises another misfit: what was best before cannot be compared.
  void new_stage() {
    best_ = std::numeric_limits<double>::infinity();
    ++stage_;
  }

  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }
  [[nodiscard]] bool is_interrupted() const { return interrupted_; }
  [[nodiscard]] bool is_exhausted() const { return evaluations_ >= max_evaluations_; }
  [[nodiscard]] bool must_stop() const { return interrupted_ || is_exhausted(); }
  [[nodiscard]] std::size_t left() const { return is_exhausted() ? 0 : max_evaluations_ - evaluations_; }
  [[nodiscard]] const std::vector<SearchStep>& steps() const { return steps_; }

 private:
  std::size_t max_evaluations_, evaluations_ = 0, stage_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
  bool interrupted_ = false;
  Progress progress_;
  std::vector<SearchStep> steps_;
};

}  // namespace shearfront::fit
