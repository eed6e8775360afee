// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <cmath>

#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A compass: a point, and how far its needles reach.
class PatternSearch {
 public:
  PatternSearch(Objective& objective, const VectorXd& start, const SearchSpec& spec)
      : objective_(&objective),
        spec_(&spec),
        allowance_(objective.control(), spec.max_evaluations),
        p_(objective.coordinates().values(start)) {
    best_.u = start;
    best_.misfit = objective.evaluate_misfit(start, false).misfit;
  }

  SearchResult operator()() {
    best_.status = Status::not_converged;
    best_.message = "there is no solution at the start values";
    if (!std::isfinite(best_.misfit)) return best_;
    while (mesh_ >= spec_->tolerance && best_.misfit > objective_->rounding_misfit()) {
      if (allowance_.must_stop()) break;
      ++best_.iterations;
      mesh_ *= has_improved() ? 2 : 0.5;
    }
    best_.status = Status::ok;
    best_.message =
        mesh_ < spec_->tolerance ? "the mesh is finer than the tolerance" : "the misfit is at rounding level";
    if (mesh_ >= spec_->tolerance && best_.misfit > objective_->rounding_misfit()) allowance_.report(best_);
    return best_;
  }

 private:
  /// Whether a point of the mesh is better; goes to the first that is.
  bool has_improved() {
    for (const double direction : {1.0, -1.0})
      for (Index j = 0; j < p_.size(); ++j) {
        VectorXd trial = p_;
        trial[j] += direction * mesh_;
        if (trial[j] == p_[j] || !is_feasible(trial)) continue;
        if (allowance_.must_stop()) return false;
        const VectorXd u = objective_->coordinates().unbounded(trial);
        const double misfit = objective_->evaluate_misfit(u, false).misfit;
        if (!(misfit < best_.misfit)) continue;
        best_.u = u;
        best_.misfit = misfit;
        p_ = trial;
        return true;
      }
    return false;
  }

  /// Within the bounds, positive where that is needed, and of the shape.
  [[nodiscard]] bool is_feasible(const VectorXd& p) const {
    const Coordinates& coordinates = objective_->coordinates();
    for (Index j = 0; j < p.size(); ++j)
      if (!(p[j] >= coordinates.lowest_values()[j] && p[j] <= coordinates.highest_values()[j]) ||
          (coordinates.is_positive(j) && !(p[j] > 0)))
        return false;
    const VectorXd u = coordinates.unbounded(p);
    for (std::size_t k = 0; k + 1 < coordinates.shaped().size(); ++k)
      if (u[coordinates.shaped()[k]] < 0) return false;
    return true;
  }

  Objective* objective_;
  const SearchSpec* spec_;
  Allowance allowance_;
  VectorXd p_;  ///< the parameters themselves: offsets from the start stay dyadic
  double mesh_ = 1;
  SearchResult best_;
};

}  // namespace

SearchResult search_pattern(Objective& objective, const VectorXd& start, const SearchSpec& spec) {
  return PatternSearch(objective, start, spec)();
}

}  // namespace shearfront::fit
