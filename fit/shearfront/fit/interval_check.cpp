// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/interval_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A bound nearer than this share of the way leaves too little to look at.
constexpr double kNearestBound = 0.25;
/// Relative half width of an interval that is rounding, not noise: searches end at 1e-10.
constexpr double kLeastWidth = 1e-8;
/// A rise at the end itself between these needs no second look.
constexpr double kLeastGood = 0.85, kMostGood = 1.2;
/// Refits end when the misfit changes by less than this share of the rise looked for.
constexpr double kRefitTolerance = 0.02;
constexpr std::size_t kMostRuns = 40;

/// Share of the way from u along `direction` that is inside the bounds, at most 1.
double share_inside(const Coordinates& coordinates, const VectorXd& u, const VectorXd& direction) {
  double share = 1;
  for (Index j = 0; j < u.size(); ++j) {
    if (direction[j] == 0) continue;
    const double bound = direction[j] > 0 ? coordinates.upper()[j] : coordinates.lower()[j];
    if (std::isfinite(bound)) share = std::min(share, (bound - u[j]) / direction[j]);
  }
  return std::max(share, 0.0);
}

class Checker {
 public:
  explicit Checker(const Minimum& minimum) : minimum_(minimum), u_(minimum.u), errors_(minimum.errors) {}

  /// Towards the lower (-1) or upper end of coordinate j.
  [[nodiscard]] EndFault towards(Index j, double sign, std::string& failure) const {
    const VectorXd way = sign * minimum_.quantile / std::sqrt(errors_.matrix(j, j)) * errors_.matrix.col(j);
    const Rise end = rise(j, way, 1);
    if (!end.failure.empty()) {
      failure = end.failure;
      return EndFault::no_solution;
    }
    if (end.size < kLeastGood) {
      const Rise beyond = rise(j, way, kMostOff);
      if (beyond.reach >= 1 && beyond.size < 1 / kMostOff) return EndFault::too_near;
    }
    if (end.size > kMostGood && rise(j, way, 1 / kMostOff).size > kMostOff) return EndFault::too_far;
    return EndFault::none;
  }

 private:
  struct Rise {
    double size = std::numeric_limits<double>::quiet_NaN();  ///< NaN: a bound is too near
    double reach = 0;     ///< how far towards the end it was looked, 1: there
    std::string failure;  ///< no solution there
  };

  /// At `stretch` times the way, or where it meets a bound.
  [[nodiscard]] Rise rise(Index j, const VectorXd& way, double stretch) const {
    const double share = share_inside(minimum_.objective.coordinates(), u_, stretch * way);
    if (share < kNearestBound) return {};
    // A bound is inside by rounding.
    const VectorXd at = u_ + (share < 1 ? share * (1 - 1e-9) : 1) * stretch * way;
    const double expected = 0.5 * errors_.misfit_scale[j] * std::pow(share * stretch * minimum_.quantile, 2);
    const Objective::Evaluation there = minimum_.objective.inspect(at, false);
    if (!there.is_valid)
      return {std::numeric_limits<double>::quiet_NaN(), share * stretch,
              there.failure.empty() ? "it is out of bounds" : there.failure};
    const auto size = [&](double misfit) {
      return std::sqrt(std::max(0.0, misfit - minimum_.at.misfit) / expected);
    };
    double least = size(there.misfit);
    if (stretch < 1 && least > kMostOff) least = std::min(least, size(refitted(j, at, expected)));
    return {least, share * stretch, {}};
  }

  /// The misfit there when the others are refitted.
  [[nodiscard]] double refitted(Index j, const VectorXd& at, double expected) const {
    const Objective& found = minimum_.objective;
    RunControl control = found.control().for_part(kMostRuns);
    Objective objective(minimum_.parameters, found.coordinates(), minimum_.spec.forward, found.rows(),
                        found.loss(), control);
    SearchSpec search = minimum_.spec.search;
    search.max_evaluations = kMostRuns;
    search.tolerance =
        std::clamp(kRefitTolerance * expected / minimum_.at.misfit, minimum_.spec.search.tolerance, 1e-2);
    std::vector<bool> fixed(static_cast<std::size_t>(u_.size()), false);
    fixed[static_cast<std::size_t>(j)] = true;
    return search_ceres(objective, at, search, fixed).misfit;
  }

  const Minimum& minimum_;
  const VectorXd& u_;
  const Covariance& errors_;
};

}  // namespace

std::vector<std::optional<IntervalCheck>> check_intervals(const Minimum& minimum, const Estimate& estimate) {
  std::vector<std::optional<IntervalCheck>> checks(estimate.parameters.size());
  const bool leaves_out = quantity_of(minimum.spec) == name_of(Quantity::point) &&
                          minimum.objective.rows().rows.size() < minimum.spec.observations.rows.size();
  if (minimum.parameters.shape() != Shape::none || leaves_out || checks.size() > kMostProfiled) return checks;
  const Checker checker(minimum);
  for (std::size_t k = 0; k < checks.size(); ++k) {
    const auto j = static_cast<Index>(k);
    const double scale = minimum.errors.misfit_scale[j];
    if (!estimate.parameters[k].ci95 || !(scale > 0) || !std::isfinite(scale)) continue;
    const double half_width = minimum.quantile * std::sqrt(minimum.errors.matrix(j, j));
    if (!(half_width > kLeastWidth * std::max(1.0, std::abs(minimum.u[j])))) continue;
    IntervalCheck check;
    check.low = checker.towards(j, -1, check.failure);
    check.high = checker.towards(j, 1, check.failure);
    checks[k] = std::move(check);
  }
  return checks;
}

}  // namespace shearfront::fit
