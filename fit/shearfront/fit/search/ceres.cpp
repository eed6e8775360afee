// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/ceres.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// All residuals come from one run of the forward model, made here before Ceres asks for them one by one.
class Batch final : public ceres::EvaluationCallback {
 public:
  Batch(Objective& objective, const VectorXd& start) : objective_(&objective), u_(start), best_u_(start) {}

  void PrepareForEvaluation(bool evaluate_jacobians, bool /*new_evaluation_point*/) override {
    at_ = &objective_->evaluate(u_, evaluate_jacobians);
    if (at_->is_valid && at_->misfit < best_misfit_) {
      best_misfit_ = at_->misfit;
      best_u_ = u_;
    }
  }

  [[nodiscard]] const Objective::Evaluation& at() const { return *at_; }
  [[nodiscard]] const Objective& objective() const { return *objective_; }
  [[nodiscard]] double* coordinate(Index j) { return &u_[j]; }
  [[nodiscard]] const VectorXd& best_u() const { return best_u_; }
  [[nodiscard]] double best_misfit() const { return best_misfit_; }

 private:
  Objective* objective_;
  VectorXd u_, best_u_;
  double best_misfit_ = std::numeric_limits<double>::infinity();
  const Objective::Evaluation* at_ = nullptr;
};

/// Residual i and its row of the Jacobian, copied from the batch.
class RowCost final : public ceres::CostFunction {
 public:
  RowCost(const Batch& batch, Index i, Index n_coordinates) : batch_(&batch), i_(i) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(n_coordinates), 1);
  }
  bool Evaluate(double const* const* /*u*/, double* residual, double** jacobians) const override {
    const Objective::Evaluation& at = batch_->at();
    if (!at.is_valid) return false;
    residual[0] = at.residuals[i_];
    if (!jacobians) return true;
    for (Index j = 0; j < at.jacobian.cols(); ++j)
      if (jacobians[j]) jacobians[j][0] = at.jacobian(i_, j);
    return true;
  }

 private:
  const Batch* batch_;
  Index i_;
};

class RowLoss final : public ceres::LossFunction {
 public:
  explicit RowLoss(const Loss& loss) : loss_(loss) {}
  void Evaluate(double s, double rho[3]) const override {
    const LossValue value = loss_(s);
    rho[0] = value.rho;
    rho[1] = value.first;
    rho[2] = value.second;
  }

 private:
  Loss loss_;
};

class StopOnRequest final : public ceres::IterationCallback {
 public:
  explicit StopOnRequest(const RunControl& control) : control_(&control) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return control_->must_stop() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const RunControl* control_;
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

ceres::Solver::Options options_of(const SearchSpec& spec, const RunControl& control,
                                  ceres::IterationCallback& callback) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = static_cast<int>(std::min<std::size_t>(control.left(), 100'000));
  options.parameter_tolerance = spec.tolerance;
  options.function_tolerance = spec.tolerance;
  options.gradient_tolerance = 1e-16;
  // A residual at rounding level cannot fall further: Ceres then shrinks the region until this.
  options.min_trust_region_radius = 1e-12;
  options.max_num_consecutive_invalid_steps = 20;
  options.callbacks.push_back(&callback);
  return options;
}

}  // namespace

SearchResult search_ceres(Objective& objective, const VectorXd& start, const SearchSpec& spec,
                          const std::vector<bool>& fixed) {
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
  RowLoss row_loss(loss);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &batch;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  ceres::Problem problem(problem_options);
  std::vector<double*> blocks;
  for (Index j = 0; j < start.size(); ++j) blocks.push_back(batch.coordinate(j));
  for (Index i = 0; i < objective.n_residuals(); ++i)
    problem.AddResidualBlock(new RowCost(batch, i, start.size()), loss.is_robust ? &row_loss : nullptr,
                             blocks);
  set_bounds(problem, batch, objective.coordinates(), fixed);
  StopOnRequest stop(objective.control());
  ceres::Solver::Summary summary;
  ceres::Solve(options_of(spec, objective.control(), stop), &problem, &summary);

  if (batch.best_misfit() <= result.misfit) {
    result.u = batch.best_u();
    result.misfit = batch.best_misfit();
  }
  result.iterations = static_cast<std::size_t>(summary.num_successful_steps + summary.num_unsuccessful_steps);
  result.message = summary.message;
  if (objective.control().is_interrupted()) {
    result.status = Status::interrupted;
    result.message = "interrupted; the best point so far is given";
  } else if (objective.control().is_exhausted() || summary.termination_type == ceres::NO_CONVERGENCE) {
    result.status = Status::budget_reached;
    result.message = "the largest number of evaluations was reached";
  } else {
    result.status = summary.termination_type == ceres::CONVERGENCE ? Status::ok : Status::not_converged;
  }
  return result;
}

}  // namespace shearfront::fit
