// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/profile_likelihood.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "shearfront/fit/covariance.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLevel = 0.95;
/// Distance of the first bracket where there is no standard error: 10 % of a positive parameter.
constexpr double kFirstStep = 0.1;
/// Stands for "no solution there" in a root search.
constexpr double kVeryFar = 100;
/// A misfit lower than the minimum by more than this, in units of chi^2, is another minimum.
constexpr double kLower = 1e-3;

/// The square of a t variable has law F(1, freedom).
double quantile_of(const Estimate& estimate) {
  if (estimate.sigma_is_given) return boost::math::quantile(boost::math::chi_squared(1), kLevel);
  const double t = boost::math::quantile(boost::math::students_t(estimate.freedom), (1 + kLevel) / 2);
  return t * t;
}

/// The profile of one coordinate to one side of the minimum, by the distance from it.
class Side {
 public:
  Side(Objective& objective, const SearchSpec& spec, const VectorXd& minimum, double misfit, Index j,
       double direction)
      : objective_(&objective),
        spec_(spec),
        u_(minimum),
        misfit_(misfit),
        j_(j),
        direction_(direction),
        from_(minimum[j]),
        fixed_(static_cast<std::size_t>(minimum.size()), false) {
    fixed_[static_cast<std::size_t>(j)] = true;
  }

  /// The coordinate where 2 (F - F_min) = scale * quantile, not beyond the bound; NaN if there is none.
  double end(double scale, double quantile, double first_step, double bound) {
    scale_ = scale;
    target_ = std::sqrt(quantile);
    const double limit = std::abs(bound - from_);
    double inside = 0, below = -target_, outside = std::min(first_step, limit);
    while (inside < outside && may_refit()) {
      const double above = height(outside);
      if (above >= 0) return from_ + direction_ * crossing(inside, below, outside, above);
      inside = outside;
      below = above;
      // The root of the misfit is nearly a straight line.
      outside = std::min(limit, inside * std::clamp(1.05 * target_ / (above + target_), 1.3, 4.0));
    }
    return kNaN;
  }
  [[nodiscard]] bool found_lower() const { return found_lower_; }

 private:
  [[nodiscard]] bool may_refit() const {
    return n_refits_ < kMostRefits && !objective_->control().must_stop();
  }

  /// sqrt(2 (F - F_min) / scale) - sqrt(quantile), the others refitted.
  double height(double distance) {
    ++n_refits_;
    VectorXd start = u_;
    start[j_] = from_ + direction_ * distance;
    const SearchResult refit = search_ceres(*objective_, start, spec_, fixed_);
    if (!std::isfinite(refit.misfit)) return kVeryFar;
    u_ = refit.u;
    const double chi2 = 2 * (refit.misfit - misfit_) / scale_;
    if (chi2 < -kLower) found_lower_ = true;
    return std::sqrt(std::max(chi2, 0.0)) - target_;
  }

  double crossing(double inside, double below, double outside, double above) {
    if (above == 0) return outside;
    const auto is_close = [](double a, double b) { return b - a <= kEndTolerance * b; };
    const auto g = [&](double distance) { return may_refit() ? height(distance) : 0.0; };
    auto most = static_cast<std::uintmax_t>(kMostRefits);
    const auto [a, b] = boost::math::tools::toms748_solve(g, inside, outside, below, above, is_close, most);
    return (a + b) / 2;
  }

  Objective* objective_;
  SearchSpec spec_;
  VectorXd u_;  ///< of the last refit, the start of the next
  double misfit_;
  Index j_;
  double direction_, from_;
  std::vector<bool> fixed_;
  double scale_ = 1, target_ = 1;
  int n_refits_ = 0;
  bool found_lower_ = false;
};

/// The scale of 2 F where the covariance gives none: that of least squares.
double scale_of(const Covariance& errors, const Estimate& estimate, Index j) {
  const double scale = errors.misfit_scale[j];
  return std::isfinite(scale) && scale > 0 ? scale : estimate.sigma * estimate.sigma;
}

}  // namespace

Profiles profile_intervals(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                           const Estimate& estimate, const Progress& progress) {
  const Coordinates& coordinates = objective.coordinates();
  Profiles profiles;
  profiles.intervals.resize(parameters.size());
  VectorXd values(coordinates.size());
  for (Index j = 0; j < values.size(); ++j)
    values[j] = estimate.parameters[static_cast<std::size_t>(j)].estimate;
  const VectorXd u = coordinates.coordinates(values);
  const Objective::Evaluation best = objective.inspect(u, true);
  if (!best.is_valid || !(estimate.sigma > 0)) return profiles;
  const Covariance errors = covariance(objective.rows(), spec.observations, best, objective.loss(),
                                       estimate.sigma, coordinates.at_bound(u));
  const double quantile = quantile_of(estimate);
  SearchSpec local = spec.search;
  local.algorithm = "ceres";
  local.starts = 1;
  bool found_lower = false;
  for (Index j = 0; j < u.size(); ++j) {
    // Refits of one parameter may take as long as the fit itself did.
    RunControl control(spec.search.max_evaluations, progress);
    Objective refitted(parameters, coordinates, spec.forward, objective.rows(), objective.loss(), control);
    const double error = std::sqrt(errors.matrix(j, j));
    const bool has_error =
        errors.determined[static_cast<std::size_t>(j)] && error > 0 && std::isfinite(error);
    const double step = has_error ? error * std::sqrt(quantile) : kFirstStep;
    const auto find = [&](double direction, double bound) {
      Side side(refitted, local, u, best.misfit, j, direction);
      const double end = side.end(scale_of(errors, estimate, j), quantile, step, bound);
      found_lower = found_lower || side.found_lower();
      VectorXd at = u;
      at[j] = end;
      return std::isnan(end) ? kNaN : coordinates.values(at)[j];
    };
    const Interval interval{find(-1, coordinates.lower()[j]), find(1, coordinates.upper()[j])};
    if (control.is_interrupted()) break;
    const bool low = std::isfinite(interval.low), high = std::isfinite(interval.high);
    if (low || high) profiles.intervals[static_cast<std::size_t>(j)] = interval;
    if (low && high) continue;
    profiles.warnings.push_back(
        parameters[static_cast<std::size_t>(j)].name() +
        (low    ? ": these data give no upper end of its 95 % profile interval within its bounds"
         : high ? ": these data give no lower end of its 95 % profile interval within its bounds"
                : ": these data give no 95 % profile interval within its bounds"));
  }
  if (found_lower)
    profiles.warnings.emplace_back(
        "a lower misfit was found on the way along a profile: the estimate is not the best fit; try other "
        "start "
        "values or search.starts > 1");
  return profiles;
}

}  // namespace shearfront::fit
