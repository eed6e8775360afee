// SPDX-License-Identifier: BSD-3-Clause
#include "levenberg_marquardt.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/numeric/number_text.hpp"

/// What Ceres is for the program: the search of a fit, here in a hundred lines. All else of a fit, its misfit, stages,
/// intervals and warnings, is that of fit/.
namespace shearfront::web {
namespace {
Watcher the_watcher = nullptr;
}
void set_watcher(Watcher watcher) { the_watcher = watcher; }
}  // namespace shearfront::web

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Steps with less of the promised gain than this are not taken.
constexpr double kLeastGain = 1e-3;
constexpr double kFirstDamping = 1e-4, kMostDamping = 1e12;
constexpr int kMostFailures = 20;

/// The misfit as a sum of squares: of a robust loss the roots of rho, with its sign.
struct Squares {
  VectorXd r;
  MatrixXd J;
};
Squares squares(const Objective& objective, const Objective::Evaluation& at) {
  Squares all{at.residuals, at.jacobian};
  if (!objective.loss().is_robust) return all;
  for (Index i = 0; i < all.r.size(); ++i) {
    const LossValue value = objective.loss()(all.r[i] * all.r[i]);
    const double root = std::sqrt(value.rho);
    if (root > 0) all.J.row(i) *= value.first * std::abs(all.r[i]) / root;
    all.r[i] = std::copysign(root, all.r[i]);
  }
  return all;
}

/// A search under way: minimum of |r|^2 / 2 in the box of the coordinates, whose faces hold what wants to pass them.
class Search {
 public:
  Search(Objective& objective, const VectorXd& start, const SearchSpec& spec, const std::vector<bool>& fixed)
      : objective_(objective),
        box_(objective.coordinates()),
        allowance_(objective.control(), spec.max_evaluations),
        tolerance_(spec.tolerance),
        fixed_(fixed),
        u_(start) {}

  SearchResult run() {
    SearchResult result;
    if (!go_to(u_)) {
      result.u = u_;
      result.misfit = std::numeric_limits<double>::infinity();
      result.status = Status::not_converged;
      result.message = "there is no solution at the start values";
      return result;
    }
    while (end_.empty() && !allowance_.must_stop()) step();
    result.u = u_;
    result.misfit = misfit_;
    result.iterations = iterations_;
    result.message = end_.empty() ? failure_ : end_;
    result.status = end_.empty() ? Status::not_converged : Status::ok;
    if (has_failed_) result.status = Status::not_converged;
    if (end_.empty()) allowance_.report(result);
    return result;
  }

 private:
  /// Takes the point, if there is a solution.
  bool go_to(const VectorXd& u) {
    const Objective::Evaluation& at = objective_.evaluate(u, true);
    if (!at.is_valid) return false;
    u_ = u;
    misfit_ = at.misfit;
    squares_ = squares(objective_, at);
    gradient_ = squares_.J.transpose() * squares_.r;
    if (web::the_watcher) web::the_watcher(objective_.control().evaluations(), misfit_, box_.values(u_));
    if (misfit_ <= objective_.rounding_misfit()) end_ = "the misfit is at rounding level";
    return true;
  }

  /// Coordinates that may move: not fixed, and not at a face they would pass.
  [[nodiscard]] std::vector<Index> free() const {
    std::vector<Index> all;
    for (Index j = 0; j < u_.size(); ++j) {
      const bool is_fixed = !fixed_.empty() && fixed_[static_cast<std::size_t>(j)];
      const bool is_held =
          (u_[j] <= box_.lower()[j] && gradient_[j] > 0) || (u_[j] >= box_.upper()[j] && gradient_[j] < 0);
      if (!is_fixed && !is_held) all.push_back(j);
    }
    return all;
  }

  /// argmin |r + J d|^2 + damping |D d|^2 over the free coordinates, D^2 the diagonal of J^T J.
  [[nodiscard]] VectorXd damped_step(const std::vector<Index>& moving) const {
    const Index n = squares_.r.size(), p = static_cast<Index>(moving.size());
    MatrixXd system(n + p, p);
    system.bottomRows(p).setZero();
    for (Index k = 0; k < p; ++k) {
      const auto column = squares_.J.col(moving[static_cast<std::size_t>(k)]);
      system.col(k).head(n) = column;
      system(n + k, k) = std::sqrt(damping_ * std::clamp(column.squaredNorm(), 1e-6, 1e32));
    }
    VectorXd right = VectorXd::Zero(n + p);
    right.head(n) = -squares_.r;
    const VectorXd d = system.colPivHouseholderQr().solve(right);
    VectorXd step = VectorXd::Zero(u_.size());
    for (Index k = 0; k < p; ++k) step[moving[static_cast<std::size_t>(k)]] = d[k];
    return step;
  }

  void step() {
    const std::vector<Index> moving = free();
    if (moving.empty()) {
      end_ = "all unknowns are held by their bounds";
      return;
    }
    ++iterations_;
    const VectorXd to = (u_ + damped_step(moving)).cwiseMax(box_.lower()).cwiseMin(box_.upper());
    const VectorXd d = to - u_;
    const double promised = (squares_.r.squaredNorm() - (squares_.r + squares_.J * d).squaredNorm()) / 2;
    if (d.norm() <= tolerance_ * (u_.norm() + tolerance_)) {
      end_ = "the step is within the tolerance";
      return;
    }
    const double before = misfit_;
    const Objective::Evaluation& there = objective_.evaluate(to, true);
    const double gain = there.is_valid && promised > 0 ? (before - there.misfit) / promised : -1;
    if (!there.is_valid) remember_failure(there, to);
    if (!(gain > kLeastGain)) {
      damping_ *= growth_;
      growth_ *= 2;
      n_failures_ = there.is_valid ? 0 : n_failures_ + 1;
      has_failed_ = n_failures_ >= kMostFailures;
      if (has_failed_)
        end_ = failure_;
      else if (damping_ > kMostDamping)
        end_ = "no step makes the misfit smaller";
      return;
    }
    n_failures_ = 0;
    damping_ *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3));
    growth_ = 2;
    go_to(to);
    if (end_.empty() && before - misfit_ <= tolerance_ * before)
      end_ = "the misfit changes by less than the tolerance";
  }

  void remember_failure(const Objective::Evaluation& there, const VectorXd& to) {
    const VectorXd values = box_.values(to);
    std::string at;
    for (Index j = 0; j < values.size(); ++j)
      at += (j == 0 ? "" : ", ") + box_.name(j) + " = " + number_text(values[j], 6);
    failure_ = "the model has no solution at " + at + ": " +
               (there.failure.empty() ? "it is out of bounds" : there.failure);
  }

  Objective& objective_;
  const Coordinates& box_;
  Allowance allowance_;
  double tolerance_;
  std::vector<bool> fixed_;
  VectorXd u_, gradient_;
  Squares squares_;
  double misfit_ = 0, damping_ = kFirstDamping, growth_ = 2;
  std::size_t iterations_ = 0;
  int n_failures_ = 0;
  bool has_failed_ = false;
  std::string end_, failure_;
};

}  // namespace

SearchResult search_ceres(Objective& objective, const VectorXd& start, const SearchSpec& spec,
                          const std::vector<bool>& fixed) {
  return Search(objective, start, spec, fixed).run();
}

SearchResult search_nlopt(Objective&, const VectorXd&, const SearchSpec&, std::string_view name) {
  throw InputError("search.algorithm", "nlopt:" + std::string(name),
                   "must be \"ceres\", \"global\" or \"pattern\" here: the explorer has no NLopt");
}

VectorXd least_in_box(const std::function<double(const VectorXd&)>&, const VectorXd&, const VectorXd&,
                      const VectorXd&, double, double, int) {
  throw InputError("noise.model", "",
                   "needs its numbers given here, or \"independent\": the explorer has no NLopt");
}

}  // namespace shearfront::fit
