// SPDX-License-Identifier: BSD-3-Clause
#include <nlopt.h>

#include <Eigen/Core>
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

/// What the callbacks of NLopt share. Exceptions must not cross its C code: they stop it and go on
/// afterwards.
class Session {
 public:
  Session(Objective& objective, const NloptSpace& space, const NloptAlgorithm& algorithm,
          const Allowance& allowance, SearchResult& best)
      : objective_(&objective),
        space_(&space),
        algorithm_(&algorithm),
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

  static void excess(unsigned m, double* values, unsigned n, const double* v, double* gradient,
                     void* session) {
    const auto* self = static_cast<const Session*>(session);
    const VectorXd at = Eigen::Map<const VectorXd>(v, n);
    Eigen::Map<VectorXd>(values, m) = self->space_->excess(at);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (gradient) Eigen::Map<RowMajor>(gradient, m, n) = self->space_->excess_derivative(at);
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
    // Who follows derivatives asks for them next, where not at once.
    const bool with_gradient = gradient || (algorithm_->uses_derivatives && objective_->has_derivatives());
    const Objective::Evaluation& at = objective_->evaluate_misfit(u, with_gradient);
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
          space_->turned(u, objective_->gradient(at).transpose()).transpose();
    return at.misfit;
  }

  Objective* objective_;
  const NloptSpace* space_;
  const NloptAlgorithm* algorithm_;
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

/// One search, which may be several runs of NLopt.
class NloptSearch {
 public:
  NloptSearch(Objective& objective, const VectorXd& start, const SearchSpec& spec,
              const NloptAlgorithm& algorithm)
      : objective_(&objective),
        spec_(spec),
        algorithm_(&algorithm),
        space_(objective.coordinates(), start, algorithm),
        allowance_(objective.control(), spec.max_evaluations) {
    check(objective.coordinates(), space_, algorithm);
    best_.u = start;
    const bool with_gradient = algorithm.uses_derivatives && objective.has_derivatives();
    best_.misfit = objective.evaluate_misfit(start, with_gradient).misfit;
  }

  SearchResult operator()() {
    if (!std::isfinite(best_.misfit)) {
      best_.status = Status::not_converged;
      best_.message = "there is no solution at the start values";
      return best_;
    }
    nlopt_srand(static_cast<unsigned long>(spec_.seed));
    if (algorithm_->name == "cobyla") {
      run_preconditioned();
    } else if (algorithm_->is_global && algorithm_->name != "mlsl") {
      run_and_finish();
    } else {
      run(*algorithm_, space_, {spec_.tolerance, spec_.tolerance, allowance_.left(), 0});
    }
    if (best_.misfit > objective_->rounding_misfit()) allowance_.report(best_);
    return best_;
  }

 private:
  struct Limits {
    double xtol = 0, ftol = 0;
    std::size_t most = 0;
    double step = 0;  ///< 0: the space's own
  };

  /// Global algorithms find a valley, not its floor.
  void run_and_finish() {
    run(*algorithm_, space_, {spec_.tolerance, 0, allowance_.left() - allowance_.left() / 3, 0});
    if (allowance_.must_stop() || best_.misfit <= objective_->rounding_misfit()) return;
    const NloptAlgorithm& local = *find_nlopt_algorithm("sbplx");
    run(local, NloptSpace(objective_->coordinates(), best_.u, local),
        {spec_.tolerance, spec_.tolerance, allowance_.left(), 0});
    best_.message = "finished by sbplx: " + best_.message;
  }

  /// Linear models see no curvature, so COBYLA creeps in narrow valleys; seen through the Jacobian these are
  /// round. The Jacobian is renewed as the search moves on.
  void run_preconditioned() {
    constexpr std::size_t kFirst = 20, kNext = 30;
    constexpr double kRough = 1e-3, kFine = 1e-4, kLongest = 0.1;
    const auto n = static_cast<std::size_t>(best_.u.size()) + 1;
    run(*algorithm_, space_, {std::max(spec_.tolerance, kRough), spec_.tolerance, kFirst * n, 0});
    double step = kLongest;
    while (!allowance_.must_stop() && best_.misfit > objective_->rounding_misfit()) {
      const Objective::Evaluation& at = objective_->evaluate(best_.u, true);
      if (!at.is_valid) return;
      NloptSpace space = space_;
      space.precondition(best_.u, at.jacobian);
      const double misfit = best_.misfit;
      const VectorXd before = space_.v(best_.u);
      run(*algorithm_, space, {std::max(spec_.tolerance, kFine * step), 0, kNext * n, step});
      const double moved = (space_.v(best_.u) - before).cwiseAbs().maxCoeff();
      const bool is_flat = misfit - best_.misfit <= spec_.tolerance * misfit;
      if (is_flat && step <= kRough) return;
      step = is_flat ? step / 10 : std::clamp(moved, spec_.tolerance, kLongest);
    }
  }

  void run(const NloptAlgorithm& algorithm, const NloptSpace& space, const Limits& limits) {
    const auto n = static_cast<unsigned>(best_.u.size());
    const Optimiser optimiser = make(nlopt_algorithm_from_string(algorithm.nlopt_name), space, limits);
    if (!optimiser) {
      set_outcome(NLOPT_OUT_OF_MEMORY, nullptr, best_);
      return;
    }
    VectorXd v = space.is_preconditioned() ? VectorXd::Zero(n) : space.v(best_.u);
    Session session(*objective_, space, algorithm, allowance_, best_);
    session.set_optimiser(optimiser.get());
    nlopt_set_min_objective(optimiser.get(), &Session::misfit, &session);
    nlopt_set_stopval(optimiser.get(), objective_->rounding_misfit());
    const Index n_constraints = space.excess(v).size();
    if (n_constraints > 0) {
      const std::vector<double> slack(static_cast<std::size_t>(n_constraints), 1e-9);
      nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(n_constraints),
                                       &Session::excess, &session, slack.data());
    }
    if (algorithm.name == "mlsl") {
      const Optimiser local = make(NLOPT_LD_SLSQP, space, limits);
      nlopt_set_local_optimizer(optimiser.get(), local.get());  // copied by NLopt
    }
    double last = best_.misfit;
    const nlopt_result code = nlopt_optimize(optimiser.get(), v.data(), &last);
    session.rethrow();
    set_outcome(code, nlopt_get_errmsg(optimiser.get()), best_);
    if (n_constraints > 0) take_end(space.u(v));
  }

  /// The end may lie outside the shape by the slack of the constraints.
  void take_end(const VectorXd& u) {
    if (allowance_.must_stop()) return;
    const Coordinates& coordinates = objective_->coordinates();
    const VectorXd end = u.cwiseMax(coordinates.lower()).cwiseMin(coordinates.upper());
    if (const double misfit = objective_->evaluate_misfit(end, false).misfit; misfit < best_.misfit) {
      best_.u = end;
      best_.misfit = misfit;
    }
  }

  [[nodiscard]] Optimiser make(nlopt_algorithm id, const NloptSpace& space, const Limits& limits) const {
    const Index n = best_.u.size();
    Optimiser optimiser(nlopt_create(id, static_cast<unsigned>(n)));
    if (!optimiser) return optimiser;
    VectorXd step = limits.step > 0 ? VectorXd::Constant(n, limits.step) : space.steps(best_.u);
    if (!space.is_preconditioned()) {
      nlopt_set_lower_bounds(optimiser.get(), space.lower().data());
      nlopt_set_upper_bounds(optimiser.get(), space.upper().data());
    }
    nlopt_set_initial_step(optimiser.get(), step.data());
    nlopt_set_ftol_rel(optimiser.get(), limits.ftol);
    // A logarithm may be near 0 for no reason: its change is relative to the parameter by itself.
    nlopt_set_xtol_rel(optimiser.get(), limits.xtol);
    nlopt_set_xtol_abs1(optimiser.get(), limits.xtol);
    const std::size_t most = std::min(limits.most, allowance_.left());
    nlopt_set_maxeval(optimiser.get(), static_cast<int>(std::min<std::size_t>(most, 1'000'000'000)));
    return optimiser;
  }

  Objective* objective_;
  SearchSpec spec_;
  const NloptAlgorithm* algorithm_;
  NloptSpace space_;
  Allowance allowance_;
  SearchResult best_;
};

}  // namespace

SearchResult search_nlopt(Objective& objective, const VectorXd& start, const SearchSpec& spec,
                          std::string_view name) {
  const NloptAlgorithm* algorithm = find_nlopt_algorithm(name);
  if (!algorithm) throw unknown_algorithm("nlopt:" + std::string(name));
  return NloptSearch(objective, start, spec, *algorithm)();
}

VectorXd least_in_box(const std::function<double(const VectorXd&)>& f, const VectorXd& from,
                      const VectorXd& lower, const VectorXd& upper, double first_step, double tolerance,
                      int most) {
  const auto n = static_cast<unsigned>(from.size());
  const Optimiser optimiser(nlopt_create(n > 1 ? NLOPT_LN_BOBYQA : NLOPT_LN_SBPLX, n));  // BOBYQA needs two
  const auto value = [](unsigned size, const double* x, double*, void* function) {
    const auto& g = *static_cast<const std::function<double(const VectorXd&)>*>(function);
    const double y = g(Eigen::Map<const VectorXd>(x, size));
    return std::isfinite(y) ? y : HUGE_VAL;
  };
  nlopt_set_lower_bounds(optimiser.get(), lower.data());
  nlopt_set_upper_bounds(optimiser.get(), upper.data());
  nlopt_set_min_objective(optimiser.get(), value,
                          const_cast<std::function<double(const VectorXd&)>*>(&f));  // NOLINT: read only
  nlopt_set_xtol_abs1(optimiser.get(), tolerance);
  nlopt_set_maxeval(optimiser.get(), most);
  nlopt_set_initial_step1(optimiser.get(), first_step);
  VectorXd x = from.cwiseMax(lower).cwiseMin(upper);
  double least = 0;
  nlopt_optimize(optimiser.get(), x.data(), &least);
  return x;
}

}  // namespace shearfront::fit
