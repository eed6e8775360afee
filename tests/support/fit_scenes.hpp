// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/solution/observe.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront::support {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

inline SceneSpec<double> small_above_large(std::vector<double> breaks, std::vector<double> values) {
  SceneSpec<double> scene;
  scene.initial_breaks = {0.5};
  scene.initial_values = {0, 1};
  scene.shear_rate = Piecewise<double>{std::move(breaks), std::move(values)};
  return scene;
}

/// Exact observations of a scene with noise; the column sigma only if asked for.
inline Observations observed(const SceneSpec<double>& truth, const ObservationPlan& plan, double sigma,
                             std::uint64_t seed, bool with_sigma) {
  const Scene<double> scene(truth);
  Observations data = observe(plan, scene, solve<ExactSolver>(scene, request_of(plan, scene)));
  add_noise(data, sigma, seed);
  if (!with_sigma)
    for (Observation& o : data.rows) o.sigma = Observation{}.sigma;
  return data;
}

inline fit::FitSpec fit_of(const SceneSpec<double>& scene, Observations data,
                           std::vector<std::string> parameters, std::vector<double> start = {}) {
  return {"",
          Scene<double>(scene),
          std::move(data),
          {std::move(parameters), std::move(start), {}, {}, fit::Shape::none},
          {},
          {},
          {},
          {}};
}

/// One layer, a = 1: the fan from z0 is phi = 1/2 + (z - z0) / (2 s t). With beta = 1 / (2 s) the numbers
/// beta and beta z0 enter linearly, so a fit of s and z0 is a linear regression.
inline SceneSpec<double> fan_scene() { return small_above_large({}, {1}); }
inline ObservationPlan fan_plan() {
  return {{0.3, 0.4}, {0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65}, Quantity::point, 0};
}
inline fit::FitSpec fan_fit(double sigma, std::uint64_t seed, bool with_sigma) {
  fit::FitSpec spec = fit_of(fan_scene(), observed(fan_scene(), fan_plan(), sigma, seed, with_sigma),
                             {"shear_rate.scale", "initial.breaks"}, {1.2, 0.48});
  spec.misfit.loss = "squared";
  spec.misfit.two_stage = false;
  return spec;
}

/// The rows that compare these observations as `Misfit` says.
template <class Misfit>
fit::ResidualRows rows_for(const fit::FitSpec& spec) {
  return Misfit::rows(spec.observations, spec.scene.bottom(), spec.scene.top());
}

/// What a fit is made of, at its start values.
template <class Misfit>
struct Parts {
  explicit Parts(const fit::FitSpec& spec, std::string_view loss = "squared", double loss_scale = 0)
      : parameters(spec.scene, spec.unknown),
        coordinates(parameters),
        control(1000),
        objective(parameters, coordinates, spec.forward, rows_for<Misfit>(spec),
                  fit::find_loss(loss, loss_scale), control),
        u(coordinates.coordinates(parameters.start())),
        at(objective.inspect(u, true)) {}
  fit::Parameters parameters;
  fit::Coordinates coordinates;
  fit::RunControl control;
  fit::Objective objective;
  Eigen::VectorXd u;
  fit::Objective::Evaluation at;
};

}  // namespace shearfront::support
