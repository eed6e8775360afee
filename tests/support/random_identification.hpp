// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/fit/shock_rows.hpp"
#include "support/identification.hpp"
#include "support/random_scene.hpp"

namespace shearfront::support {

/// Largest standard error of log a_k that noise of the data with standard deviation 1e-3, independent at
/// every time and height, would leave at the truth: the worse of M and of phi away from its jumps. Infinite
/// if a layer is not seen.
inline double worst_error(const Identification& problem) {
  const ExactSolution<double> solution{Scene<double>(problem.truth)};
  const auto& values = std::get<Piecewise<double>>(problem.truth.shear_rate).values;
  const auto n = static_cast<Eigen::Index>(values.size());
  const Derivatives<double> derivatives(solution);
  const auto all = entries(problem.truth);
  const auto first = std::find_if(all.begin(), all.end(),
                                  [](const Entry& entry) { return entry.field == "shear_rate.values"; }) -
                     all.begin();
  const auto add = [&](Eigen::MatrixXd& normal, const std::vector<double>& gradient) {
    Eigen::VectorXd row(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto i = static_cast<std::size_t>(k);
      row[k] = gradient[static_cast<std::size_t>(first) + i] * values[i];
    }
    normal += row * row.transpose();
  };
  Eigen::MatrixXd normal_M = Eigen::MatrixXd::Zero(n, n), normal_phi = normal_M;
  const Observations places = exact_data(problem, Quantity::point);
  const fit::Parameters parameters(Scene<double>(problem.truth), {problem.parameters, {}, {}, {}, {}});
  const auto is_smooth = fit::rows_without_jumps(parameters, {}, places, parameters.start());
  for (std::size_t i = 0; i < places.rows.size(); ++i) {
    const auto at = derivatives.at(places.rows[i].z, places.rows[i].t);
    add(normal_M, at.M);
    if (is_smooth[i]) add(normal_phi, at.phi);
  }
  const auto error = [&](const Eigen::MatrixXd& normal) -> double {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(normal);
    if (!(parts.eigenvalues()[0] > 1e-12 * parts.eigenvalues()[n - 1])) return INFINITY;
    return 1e-3 * std::sqrt(normal.inverse().diagonal().maxCoeff());
  };
  return std::max(error(normal_M), error(normal_phi));
}

/// A bed of `n_layers` layers with a log-uniform in [0.2, 5], random breaks and initial height in [0.3, 0.7],
/// observed at 20 times up to its steady state and 40 heights; every start value is the truth times or
/// divided by `factor`. Drawn again until noise of 1e-3 would leave 10 % error in no layer.
inline Identification random_identification(std::uint64_t seed, int n_layers, double factor) {
  SceneMaker make(seed_of(seed));
  for (;;) {
    Identification problem;
    problem.name = std::to_string(seed);
    Piecewise<double> a;
    a.breaks = make.heights(n_layers - 1, 0, 1);
    for (int i = 0; i < n_layers; ++i)
      a.values.push_back(std::exp(make.uniform(std::log(0.2), std::log(5.0))));
    problem.truth = half_filled(a);
    problem.truth.initial_breaks = {make.uniform(0.3, 0.7)};
    for (const double value : a.values)
      problem.start.push_back(make.integer(0, 1) == 0 ? value * factor : value / factor);
    const auto timeline = exact_timeline(Scene<double>(problem.truth));
    if (!timeline.t_star) continue;
    for (int i = 1; i <= 20; ++i) problem.times.push_back(*timeline.t_star * i / 20);
    for (int j = 0; j < 40; ++j) problem.heights.push_back((j + 0.5) / 40);
    if (worst_error(problem) <= 0.1) return problem;
  }
}

}  // namespace shearfront::support
