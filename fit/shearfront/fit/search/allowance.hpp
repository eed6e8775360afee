// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

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
      result.message = "interrupted; the best point so far is given";
    } else if (is_used_up()) {
      result.status = Status::budget_reached;
      result.message = "the largest number of evaluations was reached";
    }
  }

 private:
  const RunControl* control_;
  std::size_t end_;
};

/// The misfit that rounding alone makes: sum (kUlps eps weight_i (sum_j |c_ij| + n_i))^2 / 2 for solutions of
/// order one and residuals made of n_i observations. A search that is there has nothing left to find.
[[nodiscard]] inline double rounding_misfit(const Objective& objective) {
  constexpr double kUlp = 2.2e-16, kUlps = 4;
  double sum = 0;
  for (const ResidualRows::Row& row : objective.rows().rows) {
    auto size = static_cast<double>(row.data.size());
    for (const Term& term : row.model) size += std::abs(term.coefficient);
    sum += std::pow(kUlps * kUlp * row.weight * size, 2) / 2;
  }
  return sum;
}

}  // namespace shearfront::fit
