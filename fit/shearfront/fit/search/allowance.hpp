// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

inline constexpr const char* kInterrupted = "interrupted; the best point so far is given";

/// When a search ends whatever its algorithm says: interrupted, its own evaluations or those of the whole fit
/// used up.
class Allowance {
 public:
  Allowance(const RunControl& control, std::size_t most)
      : control_(&control), end_(control.evaluations() + std::min(most, control.left())) {}

  [[nodiscard]] bool must_stop() const { return control_->is_interrupted() || is_used_up(); }
  [[nodiscard]] bool is_used_up() const { return control_->evaluations() >= end_; }
  [[nodiscard]] std::size_t left() const { return is_used_up() ? 0 : end_ - control_->evaluations(); }
  /// Gives the result its status if the search was ended; otherwise leaves it.
  void report(SearchResult& result) const {
    if (control_->is_interrupted()) {
      result.status = Status::interrupted;
      result.message = kInterrupted;
    } else if (is_used_up()) {
      result.status = Status::budget_reached;
      result.message = "the largest number of evaluations was reached";
    }
  }

 private:
  const RunControl* control_;
  std::size_t end_;
};

}  // namespace shearfront::fit
