// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <any>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "shearfront/fit/parameters.hpp"
#include "shearfront/solver/method.hpp"

namespace shearfront::fit {

/// What the observations are made of. `volume` is int_bottom^z phi dz in a steady chute, where M is what passes below z. The
/// height of the bed has no place in it: z of its places does not matter.
enum class Observable { phi, M, bed_height, volume };

/// Values at the places and, if asked for, their derivatives: row = place, column = parameter.
struct Prediction {
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;
  Eigen::VectorXd gradient;  ///< of a sum of the values: one per parameter
  std::string failure;       ///< why there is none: the scene is invalid, or the solver's message
  std::string remark;        ///< the solver's, on what is less good than usual
  std::vector<StepRange>
      order_holds;  ///< per parameter, with derivatives of a solution made of events: as in Linearisation
  std::uint64_t order = 0;  ///< likewise
  [[nodiscard]] bool is_valid() const { return failure.empty(); }
};

/// What a number made of the values changes by with each of them, asked for once they are known.
using ValueSlopes = std::function<Eigen::VectorXd(const Eigen::VectorXd& values)>;

/// The solution at fixed places as a function of the parameters, by any solver.
///
/// Derivatives come from solvers that can differentiate (DifferentiableSolver), if they can for every parameter; others
/// are differentiated numerically by the caller (numeric_step.hpp). Not for use by several threads at once.
class Forward {
 public:
  /// `parameters` must outlive this. Errors: InputError (forward.method, misfit.quantity) if the method does not solve
  /// the scene at the start values.
  Forward(const Parameters& parameters, const ForwardSpec& forward, Observable observable,
          std::vector<Place> places);

  /// Whether predict() gives derivatives, exact up to rounding.
  [[nodiscard]] bool has_derivatives() const { return has_derivatives_; }
  /// Whether predict_gradient() is to be had, and costs less than all derivatives.
  [[nodiscard]] bool has_gradient() const { return has_gradient_; }
  /// No numeric differentiation below this step: what a grid or a polygonal flux adds to the solution jumps
  /// when a cell, a time step or a level appears.
  [[nodiscard]] double smallest_step() const { return is_smooth_ ? 1e-6 : 1e-3; }
  /// `progress` is asked now and then whether to go on; if not, there is no prediction. Cost: one run of the solver.
  [[nodiscard]] Prediction predict(const Eigen::VectorXd& values, bool with_derivatives,
                                   const shearfront::Progress& progress = {}) const;
  /// The values and s^T dX/dp, s = slopes(X), X the values and p the parameters, by one pass backwards over the run: no
  /// matrix of derivatives is made. Precondition: has_gradient(). Cost: two runs of the solver, whatever the number of
  /// parameters.
  [[nodiscard]] Prediction predict_gradient(const Eigen::VectorXd& values, const ValueSlopes& slopes,
                                            const shearfront::Progress& progress = {}) const;

 private:
  void take(const std::vector<Sample>& samples, Prediction& prediction) const;
  void predict_samples(const Scene<double>& scene, bool with_derivatives,
                       const shearfront::Progress& progress, Prediction& prediction) const;
  void predict_heights(const Scene<double>& scene, bool with_derivatives,
                       const shearfront::Progress& progress, Prediction& prediction) const;

  const Parameters* parameters_;
  Method method_;
  Observable observable_;
  std::vector<Place> places_;
  std::vector<double> times_;         ///< of the places, each once, ascending
  std::vector<std::size_t> entries_;  ///< of the parameters among those of the scene
  bool has_derivatives_ = false, has_gradient_ = false, can_linearise_ = false, is_smooth_ = false;
  mutable std::any memory_;  ///< of the solver, from one set of values to the next
};

}  // namespace shearfront::fit
