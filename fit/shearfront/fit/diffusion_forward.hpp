// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <string>
#include <vector>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/fit/forward.hpp"

namespace shearfront::fit {

/// phi and M of a bed with diffusion by diffusion::CrankNicolson, with the exact derivatives of what the
/// scheme computes: one run, in which every step solves one more system of equations per parameter.
///
/// Adaptive steps are chosen once and then repeated, so that the solution is a smooth function of the
/// parameters and not one with noise of the size of the tolerance. They are chosen anew when a parameter has
/// moved by more than kReach of its value since: so they always belong to parameters that near, and what
/// renewing changes (a part of the error of time stepping, which is below the tolerance) happens only while
/// a search still makes longer steps.
/// Derivatives: relative error 1e-8 (from those of the coefficients, problem_tangents.hpp), for entries of
/// shear_rate, temperature, diffusion, initial and heights of layers with another flux; none if an unknown is
/// another (domain, flux). The solution has kinks where an unknown break passes the middle or the edge of a
/// cell.
/// Errors: InputError (forward.method) for scenes without diffusion and others the scheme does not cover, at
/// the start values. Not for use by several threads at once. Cost: (1 + parameters / 2) runs of the scheme.
class DiffusionForward final : public Forward {
 public:
  static constexpr double kReach = 0.01;

  /// phi or M at the points.
  DiffusionForward(const Parameters& parameters, const ForwardSpec& forward, Observable field,
                   std::vector<Point> points);

  [[nodiscard]] bool has_derivatives() const override { return has_derivatives_; }
  [[nodiscard]] double smallest_step() const override { return 1e-6; }
  [[nodiscard]] Prediction predict(const Eigen::VectorXd& values, bool with_derivatives) const override;

 private:
  /// The steps from each time to the next, and the values they were chosen for.
  struct Plan {
    Eigen::VectorXd values;
    std::vector<std::vector<diffusion::TimeStep>> parts;
  };
  /// The points of one time.
  struct Row {
    double t = 0;
    std::vector<double> heights;
    std::vector<Eigen::Index> places;
  };

  [[nodiscard]] bool can_repeat(const Eigen::VectorXd& values) const;
  [[nodiscard]] Prediction run(const diffusion::Problem& problem,
                               const std::vector<diffusion::Tangent>& tangents, const Plan* repeated,
                               Plan& made) const;
  void read(const diffusion::Problem& problem, const diffusion::CrankNicolson& engine, const Row& row,
            Prediction& prediction) const;

  Parameters parameters_;
  SolverOptions options_;
  Observable field_;
  Eigen::Index n_points_;
  std::vector<Row> rows_;  ///< by ascending time
  bool has_derivatives_ = true;
  mutable Plan plan_;
};

}  // namespace shearfront::fit
