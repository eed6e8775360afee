// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// All residuals come from one run of the forward model, made here before Ceres asks for them one by one.
class Batch final : public ceres::EvaluationCallback {
 public:
  Batch(Objective& objective, const VectorXd& start)
      : objective_(&objective), u_(start), best_u_(start), size_(1 / objective.rows().unit) {}

  void PrepareForEvaluation(bool evaluate_jacobians, bool /*new_evaluation_point*/) override {
    at_ = &objective_->evaluate(u_, evaluate_jacobians);
    if (at_->is_valid) take_if_best();
    if (!at_->is_valid)
      failure_ = at_->failure.empty() ? "it is out of bounds" : at_->failure, failed_u_ = u_;
  }

  [[nodiscard]] const Objective::Evaluation& at() const { return *at_; }
  /// Ceres has limits for residuals of order one: it is given them as numbers beside their unit, times this.
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] const Objective& objective() const { return *objective_; }
  [[nodiscard]] double* coordinate(Index j) { return &u_[j]; }
  [[nodiscard]] const VectorXd& best_u() const { return best_u_; }
  [[nodiscard]] double best_misfit() const { return best_misfit_; }
  /// Where the last evaluation that failed was, and why; empty if none did.
  [[nodiscard]] std::string failure() const {
    if (failure_.empty()) return {};
    const Coordinates& coordinates = objective_->coordinates();
    const VectorXd values = coordinates.values(failed_u_);
    std::string at;
    for (Index j = 0; j < values.size(); ++j)
      at += (j == 0 ? "" : ", ") + coordinates.name(j) + " = " + number_text(values[j], 6);
    return "the model has no solution at " + at + ": " + failure_;
  }

 private:
  /// At a minimum the misfit is flat, and the same to rounding over some 1e-7 of the unknowns: there the gradient tells which point is
  /// nearer to it.
  void take_if_best() {
    const bool has_gradient = at_->jacobian.size() > 0 && objective_->has_derivatives();
    const double rounding = has_gradient ? std::sqrt(2 * at_->misfit) * at_->rounding : 0,
                 gradient = has_gradient ? objective_->gradient(*at_).norm() : 0;
    const bool is_same = std::abs(at_->misfit - best_misfit_) <= rounding;
    if (!(is_same ? gradient < best_gradient_ : at_->misfit < best_misfit_)) return;
    best_misfit_ = at_->misfit;
    best_gradient_ = gradient;
    best_u_ = u_;
  }

  Objective* objective_;
  VectorXd u_, best_u_;
  double size_;
  VectorXd failed_u_;
  std::string failure_;
  double best_misfit_ = std::numeric_limits<double>::infinity(), best_gradient_ = best_misfit_;
  const Objective::Evaluation* at_ = nullptr;
};

/// More rows than this take the loss into one block of residuals: blocks of their own cost half a kilobyte each.
constexpr Index kManyRows = 100'000;

/// Residuals from i on and their rows of the Jacobian, copied from the batch: one for a robust loss, else all in one.
/// With a loss of its own the residuals are +- sqrt(rho(r^2)): the same misfit and gradient, with flatter curvature
/// where rho bends than that of Ceres.
class RowCost final : public ceres::CostFunction {
 public:
  RowCost(const Batch& batch, Index i, Index n_rows, Index n_coordinates, const Loss* own_loss = nullptr)
      : batch_(&batch), i_(i), n_(n_rows), loss_(own_loss) {
    set_num_residuals(static_cast<int>(n_rows));
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(n_coordinates), 1);
  }
  bool Evaluate(double const* const* /*u*/, double* residual, double** jacobians) const override {
    const Objective::Evaluation& at = batch_->at();
    if (!at.is_valid) return false;
    Eigen::Map<VectorXd> r(residual, n_);
    r = at.residuals.segment(i_, n_);
    VectorXd factor = VectorXd::Constant(n_, batch_->size());
    for (Index i = 0; loss_ && i < n_; ++i) {
      const LossValue value = (*loss_)(r[i] * r[i]);
      const double root = std::sqrt(value.rho);
      if (root > 0) factor[i] *= value.first * std::abs(r[i]) / root;
      r[i] = std::copysign(root, r[i]);
    }
    r *= batch_->size();
    if (!jacobians) return true;
    for (Index j = 0; j < at.jacobian.cols(); ++j)
      if (jacobians[j])
        Eigen::Map<VectorXd>(jacobians[j], n_) = factor.cwiseProduct(at.jacobian.col(j).segment(i_, n_));
    return true;
  }

 private:
  const Batch* batch_;
  Index i_, n_;
  const Loss* loss_;
};

class RowLoss final : public ceres::LossFunction {
 public:
  /// Of residuals that were multiplied by `size`.
  RowLoss(const Loss& loss, double size) : loss_(loss), size2_(size * size) {}
  void Evaluate(double s, double rho[3]) const override {
    const LossValue value = loss_(s / size2_);
    rho[0] = size2_ * value.rho;
    rho[1] = value.first;
    rho[2] = value.second / size2_;
  }

 private:
  Loss loss_;
  double size2_;
};

/// Ceres tells developers what it tries, on standard error if nobody has set up its log: the outcome says it here. One that was built with a
/// small log of its own (miniglog) has been told then.
void silence_log() {
#ifndef CERCES_INTERNAL_MINIGLOG_GLOG_LOGGING_H_
  if (!google::IsGoogleLoggingInitialized()) FLAGS_minloglevel = google::GLOG_FATAL;
#endif
}

/// Ends the search where nothing is left to find, or when told to. With derivatives by differences that is where a step comes of which the
/// linear model expects less than this part of the misfit, some 1e-4 of a standard error: those that follow are as long as the error of
/// the derivatives makes them.
class Stop final : public ceres::IterationCallback {
 public:
  Stop(const Allowance& allowance, double rounding, bool has_derivatives)
      : allowance_(&allowance), rounding_(rounding), has_derivatives_(has_derivatives) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& at) override {
    if (at.cost <= rounding_) is_at_rounding_ = true;
    const bool has_step = at.iteration > 0 && at.step_is_valid && at.relative_decrease != 0;
    is_at_noise_ =
        !has_derivatives_ && has_step && std::abs(at.cost_change / at.relative_decrease) <= kWorth * at.cost;
    return is_at_rounding_ || is_at_noise_ || allowance_->must_stop() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                                      : ceres::SOLVER_CONTINUE;
  }
  [[nodiscard]] bool is_at_rounding() const { return is_at_rounding_; }
  [[nodiscard]] bool is_at_noise() const { return is_at_noise_; }

 private:
  static constexpr double kWorth = 1e-9;
  const Allowance* allowance_;
  double rounding_;
  bool has_derivatives_, is_at_rounding_ = false, is_at_noise_ = false;
};

void set_bounds(ceres::Problem& problem, Batch& batch, const Coordinates& coordinates,
                const std::vector<bool>& fixed) {
  for (Index j = 0; j < coordinates.size(); ++j) {
    if (!fixed.empty() && fixed[static_cast<std::size_t>(j)]) {
      problem.SetParameterBlockConstant(batch.coordinate(j));
      continue;
    }
    if (std::isfinite(coordinates.lower()[j]))
      problem.SetParameterLowerBound(batch.coordinate(j), 0, coordinates.lower()[j]);
    if (std::isfinite(coordinates.upper()[j]))
      problem.SetParameterUpperBound(batch.coordinate(j), 0, coordinates.upper()[j]);
  }
}

ceres::Solver::Options options_of(const SearchSpec& spec, const Allowance& allowance,
                                  ceres::IterationCallback& callback) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = static_cast<int>(std::min<std::size_t>(allowance.left(), 100'000));
  options.parameter_tolerance = spec.tolerance;
  options.function_tolerance = spec.tolerance;
  options.gradient_tolerance = 1e-16;
  // A residual at rounding level cannot fall further: Ceres then shrinks the region until this.
  options.min_trust_region_radius = 1e-12;
  options.max_num_consecutive_invalid_steps = 20;
  options.callbacks.push_back(&callback);
  return options;
}

SearchResult solve(Objective& objective, const VectorXd& start, const SearchSpec& spec,
                   const Allowance& allowance, const std::vector<bool>& fixed) {
  SearchResult result;
  result.u = start;
  result.misfit = objective.evaluate(start, false).misfit;
  if (!objective.evaluate(start, false).is_valid) {
    result.status = Status::not_converged;
    result.message = "there is no solution at the start values";
    return result;
  }
  Batch batch(objective, start);
  const Loss loss = objective.loss();
  RowLoss row_loss(loss, batch.size());
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &batch;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  ceres::Problem problem(problem_options);
  std::vector<double*> blocks;
  for (Index j = 0; j < start.size(); ++j) blocks.push_back(batch.coordinate(j));
  const Index n = objective.n_residuals();
  if (!loss.is_robust || n > kManyRows)
    problem.AddResidualBlock(new RowCost(batch, 0, n, start.size(), loss.is_robust ? &loss : nullptr),
                             nullptr, blocks);
  else
    for (Index i = 0; i < n; ++i)
      problem.AddResidualBlock(new RowCost(batch, i, 1, start.size()), &row_loss, blocks);
  set_bounds(problem, batch, objective.coordinates(), fixed);
  Stop stop(allowance, batch.size() * batch.size() * objective.rounding_misfit(),
            objective.has_derivatives());
  ceres::Solver::Summary summary;
  static std::once_flag once;
  std::call_once(once, silence_log);
  ceres::Solve(options_of(spec, allowance, stop), &problem, &summary);

  if (batch.best_misfit() <= result.misfit) {
    result.u = batch.best_u();
    result.misfit = batch.best_misfit();
  }
  result.iterations =
      static_cast<std::size_t>(std::max(0, summary.num_successful_steps + summary.num_unsuccessful_steps));
  result.message = summary.message;
  if (summary.termination_type == ceres::FAILURE && !batch.failure().empty())
    result.message = batch.failure();
  if (stop.is_at_rounding()) {
    result.status = Status::ok;
    result.message = "the misfit is at rounding level";
    return result;
  }
  const bool has_converged = summary.termination_type == ceres::CONVERGENCE || stop.is_at_noise();
  if (stop.is_at_noise()) result.message = "the noise of the model leaves nothing to find";
  result.status = has_converged ? Status::ok : Status::not_converged;
  allowance.report(result);
  return result;
}

/// Ceres projects its steps onto the box, which ends on a wrong place of its faces: what is held at a bound
/// is fixed there and the search repeated until this stays. Moves u to the bounds it is next to and marks
/// there what the misfit holds: beyond the bound it would fall, or inside by no more than `tolerance` of
/// itself.
std::vector<bool> held_at_bounds(Objective& objective, VectorXd& u, double tolerance) {
  const Coordinates& coordinates = objective.coordinates();
  std::vector<bool> held(static_cast<std::size_t>(u.size()), false);
  VectorXd outwards = VectorXd::Zero(u.size());
  for (Index j = 0; j < u.size(); ++j) {
    for (const double bound : {coordinates.lower()[j], coordinates.upper()[j]}) {
      if (!(std::abs(u[j] - bound) <= 1e-8 * std::max(1.0, std::abs(bound)))) continue;
      outwards[j] = bound == coordinates.lower()[j] ? -1 : 1;
      u[j] = bound;
    }
  }
  if (outwards.isZero()) return held;
  const Objective::Evaluation& at = objective.evaluate(u, true);
  if (!at.is_valid) return held;
  const VectorXd gradient = objective.gradient(at);
  for (Index j = 0; j < u.size(); ++j) {
    const double slope = gradient[j] * outwards[j], curvature = at.jacobian.col(j).squaredNorm();
    const bool gains = slope * slope / 2 > tolerance * at.misfit * curvature;
    held[static_cast<std::size_t>(j)] = outwards[j] != 0 && (slope <= 0 || !gains);
  }
  return held;
}

}  // namespace

SearchResult search_ceres(Objective& objective, const VectorXd& start, const SearchSpec& spec,
                          const std::vector<bool>& fixed) {
  const Allowance allowance(objective.control(), spec.max_evaluations);
  SearchResult result = solve(objective, start, spec, allowance, fixed);
  std::vector<bool> before = fixed;
  for (Index round = 0; round < 2 * start.size() && result.status == Status::ok; ++round) {
    if (result.misfit <= objective.rounding_misfit() || allowance.must_stop()) break;
    VectorXd u = result.u;
    std::vector<bool> held = held_at_bounds(objective, u, spec.tolerance);
    for (std::size_t j = 0; j < fixed.size(); ++j) held[j] = held[j] || fixed[j];
    if (held == before || std::find(held.begin(), held.end(), true) == held.end()) break;
    before = held;
    SearchResult next = solve(objective, u, spec, allowance, held);
    next.iterations += result.iterations;
    // Down from the bound itself, which may lie a little above the end of the search before.
    if (next.misfit > result.misfit) break;
    const bool is_end = result.misfit - next.misfit <= spec.tolerance * result.misfit;
    result = std::move(next);
    if (is_end) break;
  }
  return result;
}

}  // namespace shearfront::fit
