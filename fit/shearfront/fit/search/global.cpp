// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/fit/search/starts.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Evaluations of a first, short search and of its continuation, in runs with derivatives.
constexpr std::size_t kShort = 40, kLong = 200;
/// A short search that ends above this many times the best misfit is given up.
constexpr double kPromising = 10;
/// The search ends when so many local searches led to the best misfit, out of as many and one per unknown:
/// the first ones, from one start in other units of time, tend to agree on whatever they find.
constexpr int kConfirmed = 3;
constexpr double kSameMisfit = 1e-6;
/// Spread of the points around the centre, in turns: most starts are wrong by less than the box allows.
constexpr double kSpreads[] = {5, 30, 1e300};

/// Positions of the entries that a common factor of a(z) multiplies.
std::vector<Index> rates_of(const Coordinates& coordinates) {
  std::vector<Index> values, scale;
  for (Index j = 0; j < coordinates.size(); ++j) {
    const std::string& name = coordinates.name(j);
    if (name.rfind("shear_rate.values", 0) == 0 || name == "shear_rate.amplitude") values.push_back(j);
    if (name == "shear_rate.scale") scale.push_back(j);
  }
  return values.empty() ? scale : values;
}

class GlobalSearch {
 public:
  GlobalSearch(Objective& objective, const VectorXd& start, const SearchSpec& spec)
      : objective_(&objective),
        spec_(spec),
        allowance_(objective.control(), spec.max_evaluations),
        rounding_(objective.rounding_misfit()),
        rates_(rates_of(objective.coordinates())),
        cost_(objective.has_derivatives() ? 1 : 2 * static_cast<std::size_t>(start.size()) + 1) {
    best_.u = start;
    best_.misfit = objective.evaluate(start, false).misfit;
  }

  SearchResult operator()() {
    const VectorXd start = best_.u;
    VectorXd centre = start;
    if (!is_done()) centre = best_factor(start);
    climb_down(centre);
    if (rates_.size() > 1 && !is_done()) climb_down(best_factor(flat(start)));
    if (!is_done()) climb_down(start);
    std::size_t round = 0;
    while (!is_done() && round < most_rounds()) search_around(centre, round++);
    best_.iterations = iterations_;
    best_.status = n_best_ > 0 ? Status::ok : Status::not_converged;
    best_.message = !std::isfinite(best_.misfit) ? "no start has a solution"
                    : best_.misfit <= rounding_  ? "the misfit is at rounding level"
                                                 : outcome();
    if (best_.misfit > rounding_) allowance_.report(best_);
    return best_;
  }

 private:
  [[nodiscard]] bool is_done() const {
    return allowance_.must_stop() || best_.misfit <= rounding_ ||
           (n_best_ >= kConfirmed && n_finished_ >= kConfirmed + best_.u.size());
  }
  [[nodiscard]] std::size_t most_rounds() const {
    return std::max<std::size_t>(spec_.starts, 8 * static_cast<std::size_t>(best_.u.size()));
  }
  [[nodiscard]] std::string outcome() const {
    return "the smallest misfit was found by " + std::to_string(n_best_) + " of " +
           std::to_string(n_finished_) + " searches that ended";
  }

  [[nodiscard]] VectorXd with_factor(const VectorXd& u, double factor) const {
    VectorXd p = objective_->coordinates().values(u);
    for (const Index j : rates_) p[j] *= factor;
    return objective_->coordinates().coordinates(p);
  }
  [[nodiscard]] VectorXd flat(const VectorXd& u) const {
    VectorXd p = objective_->coordinates().values(u);
    double mean = 0;
    for (const Index j : rates_) mean += std::log(p[j]) / static_cast<double>(rates_.size());
    for (const Index j : rates_) p[j] = std::exp(mean);
    return objective_->coordinates().coordinates(p);
  }
  /// A common factor of a(z) is a unit of time: the data show it best, whatever the shape of a(z).
  [[nodiscard]] VectorXd best_factor(const VectorXd& u) {
    constexpr int kOctaves = 10;
    VectorXd best = u;
    double smallest = objective_->evaluate(u, false).misfit;
    for (int k = -kOctaves; k <= kOctaves && !rates_.empty() && !allowance_.must_stop(); ++k) {
      const VectorXd there = with_factor(u, std::exp2(k));
      const double misfit = objective_->evaluate_misfit(there, false).misfit;
      if (misfit < smallest) smallest = misfit, best = there;
    }
    return best;
  }

  /// The best of a few points, by their misfit alone, is worth a search.
  void search_around(const VectorXd& centre, std::size_t round) {
    const double spread = kSpreads[round % std::size(kSpreads)];
    StartPoints points(objective_->coordinates(), centre, spec_.seed + round, spread);
    VectorXd best = centre;
    double smallest = INFINITY;
    for (Index k = 0; k < 2 * centre.size() + 2 && !allowance_.must_stop(); ++k) {
      const VectorXd there = points.next();
      const double misfit = objective_->evaluate_misfit(there, false).misfit;
      if (misfit < smallest) smallest = misfit, best = there;
    }
    if (!allowance_.must_stop() && std::isfinite(smallest)) climb_down(best);
  }

  void climb_down(const VectorXd& from) {
    if (allowance_.must_stop()) return;
    SearchResult found = local(from, kShort);
    if (found.status == Status::budget_reached && found.misfit < kPromising * best_.misfit &&
        !allowance_.must_stop())
      found = local(found.u, kLong);
    const bool has_ended = found.status == Status::ok;
    n_finished_ += has_ended ? 1 : 0;
    if (found.misfit <= best_.misfit * (1 + kSameMisfit) + rounding_) {
      const bool is_same = found.misfit >= best_.misfit * (1 - kSameMisfit);
      n_best_ = (is_same ? n_best_ : 0) + (has_ended ? 1 : 0);
    }
    if (found.misfit < best_.misfit) {
      best_.u = found.u;
      best_.misfit = found.misfit;
    }
  }
  SearchResult local(const VectorXd& from, std::size_t runs) {
    SearchSpec how = spec_;
    how.max_evaluations = std::min(allowance_.left(), runs * cost_);
    // Minima are told apart by their misfits: these have to be known well.
    if (objective_->has_derivatives()) how.tolerance = std::min(how.tolerance, 1e-10);
    SearchResult found = search_ceres(*objective_, from, how);
    iterations_ += found.iterations;
    return found;
  }

  Objective* objective_;
  SearchSpec spec_;
  Allowance allowance_;
  double rounding_;
  std::vector<Index> rates_;
  std::size_t cost_, iterations_ = 0;
  int n_best_ = 0, n_finished_ = 0;
  SearchResult best_;
};

}  // namespace

SearchResult search_global(Objective& objective, const VectorXd& start, const SearchSpec& spec) {
  return GlobalSearch(objective, start, spec)();
}

}  // namespace shearfront::fit
