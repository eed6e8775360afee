// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <mutex>
#include <string>

#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/run_control.hpp"

namespace shearfront::fit {

/// The residuals of a fit's last stage as a function of its unknowns, r(p), for searches and samplers of others. All
/// observations are in it: none is left out for being near a shock. In units of sigma where the data give it; with correlated
/// noise, whitened.
///
/// Threads may share it, but wait for each other: the forward model remembers its last run.
class MisfitFunction {
 public:
  struct Value {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd jacobian;  ///< dr/dp: row = residual, column = unknown; empty unless asked for
    Eigen::VectorXd gradient;  ///< J^T r, of sum r^2 / 2; empty unless asked for
    std::string failure;       ///< why there is none: no solution there
    [[nodiscard]] bool is_valid() const { return failure.empty(); }
  };

  /// Errors: InputError for what holds between entries of the specification, and where [noise] has numbers to be estimated.
  explicit MisfitFunction(const FitSpec& spec);
  MisfitFunction(const MisfitFunction&) = delete;
  MisfitFunction& operator=(const MisfitFunction&) = delete;

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Eigen::Index size() const { return objective_.rows().size(); }
  /// Derivatives are exact where the forward model has them, otherwise by differences: some 4 runs for each unknown.
  /// Errors: InputError (key "p") unless there is one number per unknown.
  [[nodiscard]] Value at(const Eigen::VectorXd& p, bool with_jacobian) const;
  /// The residuals and the gradient; a Jacobian only where that costs less than the gradient by itself.
  [[nodiscard]] Value with_gradient(const Eigen::VectorXd& p) const;
  /// sum rho(r_i^2) / 2, rho the loss of the fit.
  [[nodiscard]] double misfit(const Eigen::VectorXd& residuals) const;

 private:
  void expect_size(const Eigen::VectorXd& p) const;

  Parameters parameters_;
  Coordinates coordinates_;
  RunControl control_;
  Objective objective_;
  mutable std::mutex mutex_;
};

}  // namespace shearfront::fit
