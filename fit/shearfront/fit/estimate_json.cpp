// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/estimate_json.hpp"

namespace shearfront::fit {
namespace {

using detail::Json;
using detail::json_or_null;

Json to_json(const std::optional<Interval>& i) { return i ? Json{i->low, i->high} : Json(); }

Json to_json(const ParameterEstimate& p) {
  Json all{{"name", p.name},
           {"start", p.start},
           {"estimate", p.estimate},
           {"std_error", json_or_null(p.std_error)},
           {"ci95", to_json(p.ci95)},
           {"at_bound", p.at_bound},
           {"held_by_shape", p.held_by_shape},
           {"ci95_is_doubtful", p.check ? Json(p.check->is_doubtful()) : Json()}};
  if (p.profile95) all["profile95"] = to_json(p.profile95);
  if (p.bootstrap95) all["bootstrap95"] = to_json(p.bootstrap95);
  return all;
}

Json to_json(const std::optional<ResidualStructure>& s) {
  if (!s) return {};
  return {{"lag1_height", s->lag1_height},
          {"lag1_time", s->lag1_time},
          {"runs_z_score", s->runs_z_score},
          {"is_structured", s->is_structured}};
}

Json to_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json& row = rows.emplace_back(Json::array());
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
  }
  return rows;
}

/// In the units of the entries; null where there is no error bar.
Eigen::MatrixXd covariance_of(const Estimate& estimate) {
  Eigen::MatrixXd matrix = estimate.correlation;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const double error = estimate.parameters[static_cast<std::size_t>(i)].std_error.value_or(kUnknown);
    matrix.row(i) *= error;
    matrix.col(i) *= error;
  }
  return matrix;
}

}  // namespace

Json to_json(const Estimate& estimate) {
  // Numbers of an estimate that was not found say nothing.
  const auto found = [&](double x) { return estimate.usable() ? Json(x) : Json(); };
  Json parameters = Json::array();
  for (const ParameterEstimate& p : estimate.parameters) parameters.push_back(to_json(p));
  Json all{{"name", estimate.name},
           {"method", estimate.method},
           {"algorithm", estimate.algorithm},
           {"quantity", estimate.quantity},
           {"loss", estimate.loss},
           {"parameters", parameters},
           {"misfit", found(estimate.misfit)},
           {"residual_norm", found(estimate.residual_norm)},
           {"sigma", found(estimate.sigma)},
           {"sigma_is_given", estimate.sigma_is_given},
           {"observations", estimate.observations},
           {"left_out", estimate.left_out},
           {"evaluations", estimate.evaluations},
           {"iterations", estimate.iterations},
           {"wall_s", estimate.wall_s},
           {"aic", json_or_null(estimate.aic)},
           {"bic", json_or_null(estimate.bic)},
           {"correlation", to_json(estimate.correlation)},
           {"covariance", to_json(covariance_of(estimate))},
           {"structure", to_json(estimate.structure)},
           {"warnings", estimate.warnings},
           {"status", name_of(estimate.status)},
           {"message", estimate.message}};
  if (estimate.scene && estimate.scene->spec().units.are_given()) {
    const SceneUnits& units = estimate.scene->spec().units;
    all["units"] = {{"z", units.z}, {units.symbol(), units.t}};
  }
  return all;
}

}  // namespace shearfront::fit
