// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// A place where the solution is wanted.
struct Point {
  double t = 0, z = 0;
  friend auto operator<=>(const Point&, const Point&) = default;
};

/// What the observations are made of. The height of the bed has no place in it: z of its points does not
/// matter.
enum class Observable { phi, M, bed_height };

/// Values at the points and, if asked for, their derivatives: row = point, column = parameter.
struct Prediction {
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;
  std::string failure;  ///< why there is none: the scene is invalid, or the solver's message
  [[nodiscard]] bool is_valid() const { return failure.empty(); }
};

/// The solution at fixed points as a function of the parameters, by any solver of SolverList.
class Forward {
 public:
  virtual ~Forward() = default;
  /// Whether predict() gives derivatives, exact up to rounding.
  [[nodiscard]] virtual bool has_derivatives() const = 0;
  /// No numeric differentiation below this step: what a grid or a polygonal flux adds to the solution jumps
  /// when a cell, a time step or a level appears.
  [[nodiscard]] virtual double smallest_step() const = 0;
  [[nodiscard]] virtual Prediction predict(const Eigen::VectorXd& values, bool with_derivatives) const = 0;
};

/// The forward model for these points. The exact solver gives derivatives if every parameter is one of
/// shear_rate.values, .breaks, .amplitude, .decay, .scale, initial.breaks, initial.values; crank-nicolson for
/// those of DiffusionForward; other solvers and parameters are differentiated numerically by the caller
/// (numeric_step.hpp).
/// Errors: InputError if there is no solver of this name. Cost of predict(): one run of the solver.
[[nodiscard]] std::unique_ptr<Forward> make_forward(const Parameters& parameters, const ForwardSpec& forward,
                                                    Observable field, std::vector<Point> points);

/// Names of the solvers a fit may use.
[[nodiscard]] std::vector<std::string> forward_names();

}  // namespace shearfront::fit
