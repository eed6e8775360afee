// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/estimate_json.hpp"

#include <cmath>
#include <string>

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

/// A number that does not belong to the model is left out, with its interval.
Json to_json(const std::optional<NoiseEstimate>& e) {
  if (!e) return {};
  Json all{{"model", e->model}};
  const auto add = [&](const char* key, double x, const std::optional<Interval>& interval) {
    if (std::isnan(x)) return;
    all[key] = x;
    if (interval) all[std::string(key) + "95"] = to_json(interval);
  };
  add("length_z", e->length_z, e->length_z95);
  add("length_t", e->length_t, e->length_t95);
  add("independent", e->independent, e->independent95);
  add("tau", e->tau, e->tau95);
  return all;
}

Json to_json(const std::optional<OrderOfEvents>& order) {
  if (!order) return {};
  return {{"parameter", order->parameter}, {"std_errors", order->std_errors}, {"changes", order->changes}};
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
           {"noise", to_json(estimate.noise)},
           {"order_of_events", to_json(estimate.order)},
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
