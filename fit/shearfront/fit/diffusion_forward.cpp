// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/diffusion_forward.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "shearfront/diffusion/crank_nicolson_solver.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/fit/problem_tangents.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {

using Eigen::Index;
using Eigen::VectorXd;

DiffusionForward::DiffusionForward(const Parameters& parameters, const ForwardSpec& forward, Observable field,
                                   std::vector<Point> points)
    : parameters_(parameters),
      options_(forward.options),
      field_(field),
      n_points_(static_cast<Index>(points.size())) {
  const Scene<double> start(parameters.scene_with(parameters.start()));
  if (const std::string reason = diffusion::refusal(start, options_); !reason.empty())
    throw InputError("forward.method", quoted_text(forward.method), "must suit the scene: " + reason);
  for (const Parameter& p : parameters)
    has_derivatives_ = has_derivatives_ && has_problem_tangent(p.entry.field);
  std::map<double, Row> rows;
  for (Index i = 0; i < n_points_; ++i) {
    const Point& point = points[static_cast<std::size_t>(i)];
    Row& row = rows[point.t];
    row.heights.push_back(point.z);
    row.places.push_back(i);
  }
  for (auto& [t, row] : rows) {
    row.t = t;
    rows_.push_back(std::move(row));
  }
}

bool DiffusionForward::can_repeat(const VectorXd& values) const {
  return plan_.values.size() == values.size() &&
         ((values - plan_.values).array().abs() <= kReach * plan_.values.array().abs()).all();
}

Prediction DiffusionForward::predict(const VectorXd& values, bool with_derivatives) const {
  Prediction prediction;
  const auto found = parameters_.scene_at(values, prediction.failure);
  if (!found) return prediction;
  const Scene<double>& scene = *found;
  if (prediction.failure = diffusion::refusal(scene, options_); !prediction.is_valid()) return prediction;
  const diffusion::Problem problem = diffusion::problem_of(scene, options_.cells);
  std::vector<diffusion::Tangent> tangents;
  if (with_derivatives) tangents = problem_tangents(parameters_, values, options_.cells);
  if (can_repeat(values)) {
    Plan same;
    prediction = run(problem, tangents, &plan_, same);
    if (prediction.is_valid()) return prediction;
  }
  Plan made{values, {}};
  prediction = run(problem, tangents, nullptr, made);
  if (prediction.is_valid()) plan_ = std::move(made);
  return prediction;
}

Prediction DiffusionForward::run(const diffusion::Problem& problem,
                                 const std::vector<diffusion::Tangent>& tangents, const Plan* repeated,
                                 Plan& made) const {
  diffusion::CrankNicolson engine(problem, diffusion::options_of(options_), tangents);
  Prediction prediction;
  prediction.values.resize(n_points_);
  if (!tangents.empty()) prediction.derivatives.resize(n_points_, static_cast<Index>(tangents.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::size_t before = engine.steps().size();
    const Status status = repeated ? engine.repeat(repeated->parts[i]) : engine.advance_to(rows_[i].t);
    if (status != Status::ok && status != Status::steady) {
      prediction.failure = repeated ? "the iteration does not converge" : engine.message();
      return prediction;
    }
    const auto& steps = engine.steps();
    made.parts.emplace_back(steps.begin() + static_cast<std::ptrdiff_t>(before), steps.end());
    read(problem, engine, rows_[i], prediction);
  }
  return prediction;
}

void DiffusionForward::read(const diffusion::Problem& problem, const diffusion::CrankNicolson& engine,
                            const Row& row, Prediction& prediction) const {
  const auto numbers = [&](const Profile<double>& profile, auto&& put) {
    const auto values = profile.at(row.heights);
    for (std::size_t k = 0; k < values.size(); ++k)
      put(row.places[k], field_ == Observable::phi ? values[k].phi : values[k].M);
  };
  numbers(diffusion::profile_of(problem, engine.states()),
          [&](Index place, double value) { prediction.values[place] = value; });
  for (Index k = 0; k < prediction.derivatives.cols(); ++k)
    numbers(diffusion::profile_tangent(problem, engine.states(), engine.tangent(static_cast<std::size_t>(k))),
            [&](Index place, double value) { prediction.derivatives(place, k) = value; });
}

}  // namespace shearfront::fit
