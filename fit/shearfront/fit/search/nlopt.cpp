// SPDX-License-Identifier: BSD-3-Clause
#include <nlopt.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/fit/search/nlopt_algorithm.hpp"
#include "shearfront/fit/search/nlopt_space.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Destroy {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};
using Optimiser = std::unique_ptr<nlopt_opt_s, Destroy>;

/// dF/du from the residuals and their Jacobian.
VectorXd gradient_of(const Objective::Evaluation& at, const Loss& loss) {
  VectorXd weighted = at.residuals;
  for (double& r : weighted) r *= loss(r * r).first;
  return at.jacobian.transpose() * weighted;
}

/// What the callbacks of NLopt share. Exceptions must not cross its C code: they stop it and go on
/// afterwards.
class Session {
 public:
  Session(Objective& objective, const NloptSpace& space, const Allowance& allowance, SearchResult& best)
      : objective_(&objective),
        space_(&space),
        allowance_(&allowance),
        best_(&best),
        worst_(std::max(best.misfit, 1e-300)) {}

  void set_optimiser(nlopt_opt optimiser) { optimiser_ = optimiser; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

  static double misfit(unsigned n, const double* v, double* gradient, void* session) {
    auto* self = static_cast<Session*>(session);
    try {
      return self->misfit(Eigen::Map<const VectorXd>(v, n), gradient);
    } catch (...) {
      self->thrown_ = std::current_exception();
      nlopt_force_stop(self->optimiser_);
      return self->penalty();
    }
  }

  /// -u_k <= 0 for every step, in units of the start.
  static void shape(unsigned m, double* values, unsigned n, const double* v, double* gradient,
                    void* session) {
    const auto* self = static_cast<const Session*>(session);
    const VectorXd u = self->space_->u(Eigen::Map<const VectorXd>(v, n));
    MatrixXd derivative;
    if (gradient) derivative = self->space_->derivative(u);
    for (unsigned i = 0; i < m; ++i) {
      const Index k = self->space_->constrained()[i];
      values[i] = -u[k];
      for (unsigned j = 0; gradient && j < n; ++j) gradient[i * n + j] = -derivative(k, j);
    }
  }

 private:
  /// In place of no solution: finite, because the models of some algorithms are built from all values.
  [[nodiscard]] double penalty() const { return 10 * worst_; }

  double misfit(const VectorXd& v, double* gradient) {
    if (gradient) std::fill(gradient, gradient + v.size(), 0.0);
    if (allowance_->must_stop() || thrown_) {
      nlopt_force_stop(optimiser_);
      return penalty();
    }
    const VectorXd u = space_->u(v);
    const Objective::Evaluation& at = objective_->evaluate(u, gradient != nullptr);
    if (!at.is_valid) return penalty();
    worst_ = std::max(worst_, at.misfit);
    const Coordinates& coordinates = objective_->coordinates();
    const bool is_inside =
        (u.array() >= coordinates.lower().array()).all() && (u.array() <= coordinates.upper().array()).all();
    if (is_inside && at.misfit < best_->misfit) {
      best_->u = u;
      best_->misfit = at.misfit;
    }
    ++best_->iterations;
    if (gradient)
      Eigen::Map<VectorXd>(gradient, v.size()) =
          space_->derivative(u).transpose() * gradient_of(at, objective_->loss());
    return at.misfit;
  }

  Objective* objective_;
  const NloptSpace* space_;
  const Allowance* allowance_;
  SearchResult* best_;
  nlopt_opt optimiser_ = nullptr;
  double worst_;
  std::exception_ptr thrown_;
};

void check(const Coordinates& coordinates, const NloptSpace& space, const NloptAlgorithm& algorithm) {
  const std::string value = quoted_text("nlopt:" + std::string(algorithm.name));
  if (static_cast<std::size_t>(coordinates.size()) < algorithm.fewest_unknowns)
    throw InputError("search.algorithm", value,
                     "needs " + std::to_string(algorithm.fewest_unknowns) + " or more unknowns");
  if (!algorithm.is_global) return;
  std::string names;
  for (Index j = 0; j < coordinates.size(); ++j)
    if (!std::isfinite(space.lower()[j]) || !std::isfinite(space.upper()[j]))
      names += (names.empty() ? "" : ", ") + coordinates.name(j);
  if (!names.empty()) throw InputError("search.algorithm", value, "needs finite bounds for " + names);
}

Optimiser make_optimiser(nlopt_algorithm id, const NloptSpace& space, const VectorXd& start_u,
                         const SearchSpec& spec, std::size_t most) {
  const VectorXd step = space.steps(start_u);
  Optimiser optimiser(nlopt_create(id, static_cast<unsigned>(step.size())));
  if (!optimiser) return optimiser;
  nlopt_set_lower_bounds(optimiser.get(), space.lower().data());
  nlopt_set_upper_bounds(optimiser.get(), space.upper().data());
  nlopt_set_initial_step(optimiser.get(), step.data());
  nlopt_set_ftol_rel(optimiser.get(), spec.tolerance);
  nlopt_set_xtol_rel(optimiser.get(), spec.tolerance);
  // Relative to the parameter; a logarithm may be near 0 for no reason.
  nlopt_set_xtol_abs1(optimiser.get(), spec.tolerance);
  nlopt_set_maxeval(optimiser.get(), static_cast<int>(std::min<std::size_t>(most, 1'000'000'000)));
  return optimiser;
}

void set_outcome(nlopt_result code, const char* detail, SearchResult& result) {
  result.status = code > 0 || code == NLOPT_ROUNDOFF_LIMITED ? Status::ok : Status::not_converged;
  switch (code) {
    case NLOPT_STOPVAL_REACHED:
      result.message = "the misfit is at rounding level";
      return;
    case NLOPT_FTOL_REACHED:
      result.message = "the misfit changes by less than the tolerance";
      return;
    case NLOPT_XTOL_REACHED:
      result.message = "the parameters change by less than the tolerance";
      return;
    case NLOPT_MAXEVAL_REACHED:
      result.status = Status::budget_reached;
      result.message = "the largest number of evaluations was reached";
      return;
    case NLOPT_ROUNDOFF_LIMITED:
      result.message = "rounding allows no further progress";
      return;
    default:
      result.message = code > 0 ? "finished" : std::string("NLopt: ") + nlopt_result_to_string(code);
      if (code <= 0 && detail) result.message += std::string(" (") + detail + ")";
  }
}

}  // namespace

SearchResult search_nlopt(Objective& objective, const VectorXd& start, const SearchSpec& spec,
                          std::string_view name) {
  const NloptAlgorithm* algorithm = find_nlopt_algorithm(name);
  if (!algorithm) throw unknown_algorithm("nlopt:" + std::string(name));
  const NloptSpace space(objective.coordinates(), start, *algorithm);
  check(objective.coordinates(), space, *algorithm);
  const Allowance allowance(objective.control(), spec.max_evaluations);
  SearchResult result;
  result.u = start;
  result.misfit = objective.evaluate(start, false).misfit;
  if (!std::isfinite(result.misfit)) {
    result.status = Status::not_converged;
    result.message = "there is no solution at the start values";
    return result;
  }
  const nlopt_algorithm id = nlopt_algorithm_from_string(algorithm->nlopt_name);
  Optimiser optimiser = make_optimiser(id, space, start, spec, allowance.left());
  if (!optimiser) {
    result.status = Status::not_converged;
    result.message = "NLopt: out of memory";
    return result;
  }
  Session session(objective, space, allowance, result);
  session.set_optimiser(optimiser.get());
  nlopt_srand(static_cast<unsigned long>(spec.seed));
  nlopt_set_min_objective(optimiser.get(), &Session::misfit, &session);
  nlopt_set_stopval(optimiser.get(), rounding_misfit(objective));
  if (!space.constrained().empty()) {
    const std::vector<double> slack(space.constrained().size(), 1e-9);
    nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(slack.size()), &Session::shape,
                                     &session, slack.data());
  }
  if (id == NLOPT_G_MLSL_LDS) {
    const Optimiser local = make_optimiser(NLOPT_LD_SLSQP, space, start, spec, allowance.left());
    nlopt_set_local_optimizer(optimiser.get(), local.get());  // copied by NLopt
  }
  VectorXd v = space.v(start);
  double last = result.misfit;
  const nlopt_result code = nlopt_optimize(optimiser.get(), v.data(), &last);
  session.rethrow();
  set_outcome(code, nlopt_get_errmsg(optimiser.get()), result);
  if (!space.constrained().empty() && !allowance.must_stop()) {
    // The end may lie outside the shape by the slack of the constraints.
    const Coordinates& coordinates = objective.coordinates();
    const VectorXd end = space.u(v).cwiseMax(coordinates.lower()).cwiseMin(coordinates.upper());
    if (const double misfit = objective.evaluate(end, false).misfit; misfit < result.misfit) {
      result.u = end;
      result.misfit = misfit;
    }
  }
  allowance.report(result);
  return result;
}

}  // namespace shearfront::fit
