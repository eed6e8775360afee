// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/profile_likelihood.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "shearfront/fit/covariance.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLevel = 0.95;
/// Distance of the first bracket where there is no standard error: 10 % of a positive parameter.
constexpr double kFirstStep = 0.1;
/// Stands for "no solution there" in a root search.
constexpr double kVeryFar = 100;
/// How well the place is found, relative to its distance, beyond which the model has no solution.
constexpr double kEdgeTolerance = 0.02;
/// Newton's method to an end: a step of this share of kEndTolerance is the last, after so many it does not lead there. Steps of
/// Gauss-Newton shrink by a factor that the residuals decide, so the last is taken well below what is asked for.
constexpr double kLastStep = 0.2;
constexpr int kMostNewtonSteps = 12;
/// A misfit lower than the minimum by more than this, in units of chi^2, is another minimum.
constexpr double kLower = 1e-3;

/// The square of a t variable has law F(1, freedom).
double quantile_of(const Estimate& estimate) {
  if (estimate.sigma_is_given) return boost::math::quantile(boost::math::chi_squared(1), kLevel);
  const double t = boost::math::quantile(boost::math::students_t(estimate.freedom), (1 + kLevel) / 2);
  return t * t;
}

/// Where one side of a profile ends.
struct End {
  double place = kUnknown;  ///< coordinate; NaN: open
  double edge = kUnknown;   ///< open because the model has no solution beyond this coordinate
  std::string failure;      ///< why it has none
};

/// The profile of one coordinate to one side of the minimum, by the distance from it.
class Side {
 public:
  Side(Objective& objective, const SearchSpec& spec, const VectorXd& start, const VectorXd& minimum,
       double misfit, Index j, double direction)
      : objective_(&objective),
        spec_(spec),
        start_(start),
        u_(minimum),
        misfit_(misfit),
        j_(j),
        direction_(direction),
        from_(minimum[j]),
        fixed_(static_cast<std::size_t>(minimum.size()), false) {
    fixed_[static_cast<std::size_t>(j)] = true;
  }

  /// A place that may lie inside: where another profile has come to.
  void set_inside(const VectorXd& u) { known_ = u; }

  /// The coordinate where 2 (F - F_min) = scale * quantile, not beyond the bound.
  End end(double scale, double quantile, double first_step, double bound) {
    scale_ = scale;
    target_ = std::sqrt(quantile);
    if (const double place = newton_end(first_step); !std::isnan(place)) return {place, kUnknown, {}};
    const double limit = std::abs(bound - from_);
    double inside = 0, below = -target_, edge = std::numeric_limits<double>::infinity();
    double outside = std::min(first_step, limit);
    // From there, not over a ridge between two valleys of the misfit.
    const double known = known_.size() > 0 ? direction_ * (known_[j_] - from_) : 0;
    if (known > 0) {
      const VectorXd kept = std::exchange(u_, known_);
      if (const double there = height(known); there < 0) {
        inside = known;
        below = there;
        outside = std::min(limit, inside + first_step);
      } else {
        u_ = kept;
      }
    }
    while (inside < outside && inside < (1 - kEdgeTolerance) * edge && may_refit()) {
      const double above = height(outside);
      if (above == kVeryFar) {
        edge = outside;
        outside = 0.5 * (inside + edge);
        continue;
      }
      if (above >= 0) return {from_ + direction_ * crossing(inside, below, outside, above), kUnknown, {}};
      inside = outside;
      below = above;
      // The root of the misfit is nearly a straight line.
      outside = std::min(limit, inside * std::clamp(1.05 * target_ / (above + target_), 1.3, 4.0));
      if (outside >= edge) outside = 0.5 * (inside + edge);
    }
    if (std::isinf(edge)) return {};
    return {kUnknown, from_ + direction_ * inside, failure_};
  }
  [[nodiscard]] bool found_lower() const { return found_lower_; }
  /// Where the last refit ended.
  [[nodiscard]] const VectorXd& last() const { return u_; }

 private:
  [[nodiscard]] bool may_refit() const {
    return n_refits_ < kMostRefits && !objective_->control().must_stop();
  }

  /// sqrt(2 (F - F_min) / scale) - sqrt(quantile), the others refitted; kVeryFar without a solution.
  double height(double distance) {
    ++n_refits_;
    std::string failure;
    const SearchResult refit = refit_at(from_ + direction_ * distance, failure);
    if (!std::isfinite(refit.misfit)) {
      failure_ = std::move(failure);
      return kVeryFar;
    }
    u_ = refit.u;
    const double chi2 = 2 * (refit.misfit - misfit_) / scale_;
    if (chi2 < -kLower) found_lower_ = true;
    return std::sqrt(std::max(chi2, 0.0)) - target_;
  }

  /// The refit from the last one. Where that has no solution, or ends so high that it may have got stuck (on
  /// a bound, where the misfit is flat), also from nearer to the start of the whole fit. `failure`: why the
  /// first has none.
  SearchResult refit_at(double value, std::string& failure) {
    SearchResult best;
    best.misfit = std::numeric_limits<double>::infinity();
    for (const double share : {0.0, 0.5, 1.0}) {
      VectorXd from = (1 - share) * u_ + share * start_;
      from[j_] = value;
      const Objective::Evaluation& at = objective_->evaluate(from, false);
      if (share == 0) failure = at.failure;
      if (!at.is_valid) continue;
      SearchResult refit = search_ceres(*objective_, from, spec_, fixed_);
      if (refit.misfit < best.misfit) best = std::move(refit);
      if (2 * (best.misfit - misfit_) < scale_ * target_ * target_) break;
    }
    return best;
  }

  /// The end by Newton's method on all coordinates at once: there F has risen by scale * quantile / 2 and its gradient in
  /// the others is 0. With g, H = J'J of least squares at u, the others o follow coordinate j by d_o = -H_oo^-1 (g_o + H_oj d_j),
  /// which leaves a parabola in d_j. NaN where it does not lead there inside the bounds: for the slow road. Some six
  /// evaluations instead of ten refits. Where the misfit has several valleys it is the end of the one of the estimate. Source: Venzon & Moolgavkar (1988), with H of Gauss-Newton.
  double newton_end(double first_step) {
    const Coordinates& box = objective_->coordinates();
    if (!objective_->has_derivatives() || objective_->loss().is_robust || known_.size() > 0) return kUnknown;
    const std::vector<bool> at_bound = box.at_bound(u_);
    if (std::find(at_bound.begin(), at_bound.end(), true) != at_bound.end()) return kUnknown;
    const Index n = u_.size();
    const double target = misfit_ + scale_ * target_ * target_ / 2;
    VectorXd u = u_;
    for (int step = 0; step < kMostNewtonSteps && !objective_->control().must_stop(); ++step) {
      const Objective::Evaluation& at = objective_->evaluate(u, true);
      if (!at.is_valid) return kUnknown;
      const MatrixXd H = at.jacobian.transpose() * at.jacobian;
      const VectorXd g = at.jacobian.transpose() * at.residuals;
      // H of the others with a 1 in the place of j is solved for g_o and H_oj at once.
      MatrixXd others = H, sides(n, 2);
      others.row(j_).setZero();
      others.col(j_).setZero();
      others(j_, j_) = 1;
      sides.col(0) = g;
      sides.col(1) = H.col(j_);
      sides.row(j_).setZero();
      const Eigen::LLT<MatrixXd> factors(others);
      if (factors.info() != Eigen::Success) return kUnknown;
      const MatrixXd solved = factors.solve(sides);
      const double decrement = sides.col(0).dot(solved.col(0)) / 2;
      const double curve = H(j_, j_) - sides.col(1).dot(solved.col(1));
      const double slope = g[j_] - sides.col(1).dot(solved.col(0));
      const double rest = at.misfit - decrement - target;
      const double root = slope * slope - 2 * curve * rest;
      if (!(curve > 0) || !(root >= 0)) return kUnknown;
      double move = (direction_ * std::sqrt(root) - slope) / curve;
      if (step == 0) move = direction_ * first_step;  // g is 0 up to where the search ended
      const double distance = direction_ * (u[j_] + move - from_);
      if (!(distance > 0)) return kUnknown;
      u -= solved.col(0) + move * solved.col(1);
      u[j_] += move;
      if ((u.array() < box.lower().array()).any() || (u.array() > box.upper().array()).any()) return kUnknown;
      if (step == 0 || std::abs(move) > kLastStep * kEndTolerance * distance) continue;
      // A place where the gradient is 0 need not be a minimum.
      const SearchResult refit = search_ceres(*objective_, u, spec_, fixed_);
      if (!(std::abs(refit.misfit - target) <= kEndTolerance * 10 * (target - misfit_))) return kUnknown;
      u_ = refit.u;
      return u_[j_];
    }
    return kUnknown;
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
  VectorXd start_;  ///< of the whole fit
  VectorXd u_;      ///< of the last refit, the start of the next
  VectorXd known_;  ///< empty: none
  double misfit_;
  Index j_;
  double direction_, from_;
  std::vector<bool> fixed_;
  double scale_ = 1, target_ = 1;
  int n_refits_ = 0;
  bool found_lower_ = false;
  std::string failure_;
};

/// The scale of 2 F where the covariance gives none: that of least squares.
double scale_of(const Covariance& errors, const Estimate& estimate, Index j) {
  const double scale = errors.misfit_scale[j];
  return std::isfinite(scale) && scale > 0 ? scale : estimate.sigma * estimate.sigma;
}

/// What is to be said of a lower and an upper end that stay open.
void warn_of_open_ends(const std::string& name, const std::array<End, 2>& ends,
                       std::vector<std::string>& warnings) {
  constexpr std::string_view kEnd[] = {"lower", "upper"}, kWay[] = {"down", "up"},
                             kBeyond[] = {"below", "above"};
  for (std::size_t i = 0; i < 2; ++i)
    if (!std::isnan(ends[i].edge))
      warnings.push_back(fmt::format(
          "{}: no {} end of its 95 % profile interval {} to {}, {} which the model has no solution: {}", name,
          kEnd[i], kWay[i], number_text(ends[i].edge, 3), kBeyond[i], ends[i].failure));
  const auto meets_bound = [](const End& end) { return std::isnan(end.place) && std::isnan(end.edge); };
  const bool low = meets_bound(ends[0]), high = meets_bound(ends[1]);
  if (low || high)
    warnings.push_back(fmt::format("{}: these data give no {}95 % profile interval within its bounds", name,
                                   low && high ? ""
                                   : low       ? "lower end of its "
                                               : "upper end of its "));
}

/// All that the profiles of one fit have in common.
class Profiler {
 public:
  Profiler(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
           const Estimate& estimate, const Progress& progress)
      : parameters_(parameters),
        objective_(objective),
        coordinates_(objective.coordinates()),
        estimate_(estimate),
        progress_(progress),
        local_(spec.search),
        forward_(spec.forward),
        quantile_(estimate.sigma > 0 ? quantile_of(estimate) : kUnknown),
        u_(coordinates_.size()) {
    for (Index j = 0; j < u_.size(); ++j) u_[j] = estimate.parameters[static_cast<std::size_t>(j)].estimate;
    u_ = coordinates_.coordinates(u_);
    best_ = objective.inspect(u_, true);
    local_.algorithm = "ceres";
    local_.starts = 1;
    if (is_possible())
      errors_ = covariance(objective.rows(), spec.observations, best_, objective.loss(), estimate.sigma,
                           coordinates_.at_bound(u_));
  }

  Profiles of(const std::vector<bool>& wanted) {
    profiles_.intervals.resize(parameters_.size());
    if (!best_.is_valid)
      profiles_.warnings.emplace_back(
          "no profile intervals: the model has no solution at the estimate, or only just");
    for (Index j = 0; is_possible() && j < u_.size(); ++j)
      if (wanted[static_cast<std::size_t>(j)] && !add(j, {true, true})) break;
    return finished();
  }

  /// Of parameters at a bound, and of those that depend on how far they are from it.
  Profiles beside_bounds() {
    profiles_.intervals.resize(parameters_.size());
    if (!is_possible()) return std::move(profiles_);
    const auto is_at_bound = [&](Index j) {
      return estimate_.parameters[static_cast<std::size_t>(j)].at_bound;
    };
    std::vector<bool> moves(parameters_.size(), false);
    for (Index j = 0; j < u_.size(); ++j) {
      if (!is_at_bound(j)) continue;
      const bool is_lower = u_[j] - coordinates_.lower()[j] < coordinates_.upper()[j] - u_[j];
      inside_.resize(0);
      if (!add(j, {!is_lower, is_lower})) return finished();
      inside_ = last_;
      for (Index i = 0; i < u_.size(); ++i) {
        const double moved = std::abs(last_[i] - u_[i]), error = std::sqrt(errors_.matrix(i, i));
        const auto k = static_cast<std::size_t>(i);
        moves[k] = moves[k] || (errors_.determined[k] && moved > kMostMoved * error);
      }
    }
    for (Index j = 0; j < u_.size(); ++j)
      if (moves[static_cast<std::size_t>(j)] && !is_at_bound(j) && !add(j, {true, true})) break;
    return finished();
  }

 private:
  Profiles finished() {
    if (found_lower_)
      profiles_.warnings.emplace_back(
          "a lower misfit was found on the way along a profile: the estimate is not the best fit; try other "
          "start values or search.starts > 1");
    return std::move(profiles_);
  }

  [[nodiscard]] bool is_possible() const { return best_.is_valid && estimate_.sigma > 0; }

  /// The interval of coordinate j, with a lower and an upper end if they are wanted; false if the user ended it.
  bool add(Index j, const std::array<bool, 2>& wanted) {
    // Refits of one parameter may take as long as the fit itself did.
    RunControl control(local_.max_evaluations, progress_);
    Objective refitted(parameters_, coordinates_, forward_, objective_.rows(), objective_.loss(), control);
    std::array<End, 2> ends;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (!wanted[i]) continue;
      Side side(refitted, local_, coordinates_.coordinates(parameters_.start()), u_, best_.misfit, j,
                i == 0 ? -1 : 1);
      side.set_inside(inside_);
      ends[i] = side.end(scale_of(errors_, estimate_, j), quantile_, first_step(j),
                         (i == 0 ? coordinates_.lower() : coordinates_.upper())[j]);
      ends[i].place = value(j, ends[i].place);
      ends[i].edge = value(j, ends[i].edge);
      found_lower_ = found_lower_ || side.found_lower();
      last_ = side.last();
    }
    if (control.is_interrupted()) return false;
    const auto k = static_cast<std::size_t>(j);
    if (std::isfinite(ends[0].place) || std::isfinite(ends[1].place))
      profiles_.intervals[k] = Interval{ends[0].place, ends[1].place};
    if (wanted[0] && wanted[1]) warn_of_open_ends(parameters_[k].name(), ends, profiles_.warnings);
    return true;
  }

  [[nodiscard]] double first_step(Index j) const {
    const double error = std::sqrt(errors_.matrix(j, j));
    const bool has_error =
        errors_.determined[static_cast<std::size_t>(j)] && error > 0 && std::isfinite(error);
    return has_error ? error * std::sqrt(quantile_) : kFirstStep;
  }

  /// Of the parameter where coordinate j is `place`.
  [[nodiscard]] double value(Index j, double place) const {
    if (std::isnan(place)) return kUnknown;
    VectorXd at = u_;
    at[j] = place;
    return coordinates_.values(at)[j];
  }

  const Parameters& parameters_;
  const Objective& objective_;
  const Coordinates& coordinates_;
  const Estimate& estimate_;
  const Progress& progress_;
  SearchSpec local_;
  const ForwardSpec& forward_;
  double quantile_;
  VectorXd u_;  ///< the estimate
  Objective::Evaluation best_;
  Covariance errors_;
  Profiles profiles_;
  VectorXd last_;    ///< coordinates at the last end
  VectorXd inside_;  ///< at the end of the profile of one at a bound; empty: none
  bool found_lower_ = false;
};

}  // namespace

Profiles intervals_beside_bounds(const FitSpec& spec, const Parameters& parameters,
                                 const Objective& objective, const Estimate& estimate,
                                 const Progress& progress) {
  return Profiler(spec, parameters, objective, estimate, progress).beside_bounds();
}

Profiles profile_intervals(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                           const Estimate& estimate, const std::vector<bool>& wanted,
                           const Progress& progress) {
  return Profiler(spec, parameters, objective, estimate, progress).of(wanted);
}

}  // namespace shearfront::fit
