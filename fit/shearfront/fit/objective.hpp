// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/forward.hpp"
#include "shearfront/fit/loss/loss.hpp"
#include "shearfront/fit/residual_rows.hpp"
#include "shearfront/fit/run_control.hpp"

namespace shearfront::fit {

/// A loss of LossList with the residual where it bends (in the unit of the residuals).
struct Loss {
  LossValue (*function)(double s, double scale) = nullptr;
  double scale = 1;
  bool is_robust = false;
  [[nodiscard]] LossValue operator()(double s) const { return function(s, scale); }
};

/// The loss of this name; scale <= 0: its default. Errors: InputError if there is none.
[[nodiscard]] Loss find_loss(std::string_view name, double scale);

/// The misfit  F(u) = sum_i rho(r_i(u)^2) / 2  over the coordinates of a search, with r and its Jacobian.
///
/// Every call that needs the forward model is counted in the RunControl; the last point is kept, so asking
/// for it again is free. Derivatives are exact if the forward model has them, otherwise central differences
/// with the step chosen for the noise of the model (numeric_step.hpp); each of their 2 n runs is counted.
class Objective {
 public:
  struct Evaluation {
    bool is_valid = false;  ///< false: no solution there, or outside the bounds
    std::string failure;    ///< why the solver has no solution; empty where it was not asked
    Eigen::VectorXd residuals;
    Eigen::MatrixXd jacobian;      ///< row = residual, column = coordinate; empty unless asked for
    Eigen::VectorXd gradient;      ///< dF/du, where it is known without a Jacobian
    double misfit = 0;             ///< infinite if not valid
    Eigen::VectorXd column_error;  ///< of a numeric jacobian from inspect(), relative; empty: rounding only
    double rounding = 0;           ///< norm of what rounding alone makes of the residuals
    std::vector<StepRange> order_holds;  ///< of the Prediction, per parameter, with an exact jacobian
    std::uint64_t order = 0;             ///< likewise
  };
  /// dF/du = sum_i rho'(r_i^2) r_i dr_i/du from an evaluation with its gradient or Jacobian.
  [[nodiscard]] Eigen::VectorXd gradient(const Evaluation& at) const;

  Objective(const Parameters& parameters, const Coordinates& coordinates, const ForwardSpec& forward,
            ResidualRows rows, Loss loss, RunControl& control);

  [[nodiscard]] const Evaluation& evaluate(const Eigen::VectorXd& u, bool with_jacobian);
  /// The same for who looks at F and gradient() alone: where the forward model has gradients of sums there is no Jacobian.
  [[nodiscard]] const Evaluation& evaluate_misfit(const Eigen::VectorXd& u, bool with_gradient);
  /// The same without touching the count: for the report after a search. A numeric Jacobian costs twice as
  /// much here, to know its error.
  [[nodiscard]] Evaluation inspect(const Eigen::VectorXd& u, bool with_jacobian) const;
  /// What is known of this point without a run: its evaluation, if it was the best so far.
  [[nodiscard]] const Evaluation* known(const Eigen::VectorXd& u) const {
    return best_.is_valid && best_u_ == u ? &best_ : nullptr;
  }

  [[nodiscard]] const Parameters& parameters() const { return *parameters_; }
  [[nodiscard]] const Coordinates& coordinates() const { return *coordinates_; }
  [[nodiscard]] const ResidualRows& rows() const { return rows_; }
  [[nodiscard]] const Loss& loss() const { return loss_; }
  [[nodiscard]] const Forward& forward() const { return forward_; }
  [[nodiscard]] RunControl& control() const { return *control_; }
  [[nodiscard]] bool has_derivatives() const { return forward_.has_derivatives(); }
  /// How often the order of events was another one than at the point before.
  [[nodiscard]] std::size_t n_order_changes() const { return n_order_changes_; }
  /// The misfit that rounding alone makes: sum (kUlps eps weight_i X sum_j |c_ij| (1 + n_i))^2 / 2 for solutions of
  /// size X and residuals made of n_i observations. A search that is there has nothing left to find.
  [[nodiscard]] double rounding_misfit() const { return rounding_misfit_; }
  void set_loss(Loss loss);
  /// Adds the residuals tether * (u - centre): keeps directions the data hardly see near the centre.
  void set_tether(Eigen::VectorXd centre, double tether);
  [[nodiscard]] Eigen::Index n_residuals() const { return rows_.size() + centre_.size(); }

 private:
  enum class Derivatives { none, gradient, jacobian };
  [[nodiscard]] Evaluation run(const Eigen::VectorXd& u, Derivatives derivatives) const;
  /// run() at the next point of a search: counted, and kept.
  void go_to(const Eigen::VectorXd& u, Derivatives derivatives);
  /// dF/dr.
  [[nodiscard]] Eigen::VectorXd slopes(const Eigen::VectorXd& residuals) const;
  void add_tether(const Eigen::VectorXd& u, Evaluation& at) const;
  void differentiate(const Eigen::VectorXd& u, Evaluation& at, RunControl* control) const;

  const Parameters* parameters_;
  const Coordinates* coordinates_;
  ResidualRows rows_;
  Loss loss_;
  RunControl* control_;
  Eigen::VectorXd centre_;
  double tether_ = 0, rounding_misfit_ = 0;
  Forward forward_;
  mutable Eigen::VectorXd step_;  ///< of the differences, chosen at the first use
  Eigen::VectorXd last_u_, best_u_;
  Evaluation last_, best_;
  std::uint64_t last_order_ = 0;
  std::size_t n_order_changes_ = 0;
};

}  // namespace shearfront::fit
