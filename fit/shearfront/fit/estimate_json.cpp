// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/estimate.hpp"

#include <fmt/format.h>

#include <vector>

#include "shearfront/io/detail/json_text.hpp"

namespace shearfront::fit {
namespace {

using detail::json_array;
using detail::json_number;
using detail::json_text;

/// Numbers of an estimate that was not found say nothing.
std::string found(const Estimate& estimate, double x) { return estimate.usable() ? json_number(x) : "null"; }

std::string interval(const std::optional<Interval>& i) {
  return i ? json_array({json_number(i->low), json_number(i->high)}) : "null";
}

std::string parameter_text(const ParameterEstimate& p) {
  std::string text =
      fmt::format(R"({{"name": {}, "start": {}, "estimate": {}, "std_error": {}, "ci95": {}, "at_bound": {})",
                  json_text(p.name), json_number(p.start), json_number(p.estimate), json_number(p.std_error),
                  interval(p.ci95), p.at_bound);
  text += fmt::format(R"(, "ci95_is_doubtful": {})", !p.check                 ? "null"
                                                     : p.check->is_doubtful() ? "true"
                                                                              : "false");
  if (p.profile95) text += fmt::format(R"(, "profile95": {})", interval(p.profile95));
  if (p.bootstrap95) text += fmt::format(R"(, "bootstrap95": {})", interval(p.bootstrap95));
  return text + "}";
}

std::string structure_text(const std::optional<ResidualStructure>& s) {
  if (!s) return "null";
  return fmt::format(R"({{"lag1_height": {}, "lag1_time": {}, "runs_z_score": {}, "is_structured": {}}})",
                     json_number(s->lag1_height), json_number(s->lag1_time), json_number(s->runs_z_score),
                     s->is_structured);
}

/// Pieces below each other, or [].
std::string column(const std::vector<std::string>& pieces, const std::string& indent) {
  if (pieces.empty()) return "[]";
  std::string text;
  for (const std::string& piece : pieces) text += (text.empty() ? "\n" : ",\n") + indent + "    " + piece;
  return "[" + text + "\n" + indent + "  ]";
}

std::vector<std::string> matrix_rows(const Eigen::MatrixXd& matrix) {
  std::vector<std::string> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    std::vector<std::string> row;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(json_number(matrix(i, j)));
    rows.push_back(json_array(row));
  }
  return rows;
}

}  // namespace

std::string estimate_json(const Estimate& estimate, const std::string& indent) {
  std::vector<std::string> parameters, warnings;
  for (const ParameterEstimate& p : estimate.parameters) parameters.push_back(parameter_text(p));
  for (const std::string& warning : estimate.warnings) warnings.push_back(json_text(warning));
  std::string text;
  const auto add = [&](std::string_view key, const std::string& value) {
    text += (text.empty() ? "" : ",\n") + indent + "  \"" + std::string(key) + "\": " + value;
  };
  add("name", json_text(estimate.name));
  add("method", json_text(estimate.method));
  add("algorithm", json_text(estimate.algorithm));
  add("quantity", json_text(estimate.quantity));
  add("loss", json_text(estimate.loss));
  add("parameters", column(parameters, indent));
  add("misfit", found(estimate, estimate.misfit));
  add("residual_norm", found(estimate, estimate.residual_norm));
  add("sigma", found(estimate, estimate.sigma));
  add("sigma_is_given", estimate.sigma_is_given ? "true" : "false");
  add("observations", std::to_string(estimate.observations));
  add("left_out", std::to_string(estimate.left_out));
  add("evaluations", std::to_string(estimate.evaluations));
  add("iterations", std::to_string(estimate.iterations));
  add("wall_s", json_number(estimate.wall_s));
  add("aic", json_number(estimate.aic));
  add("bic", json_number(estimate.bic));
  add("correlation", column(matrix_rows(estimate.correlation), indent));
  add("structure", structure_text(estimate.structure));
  add("warnings", column(warnings, indent));
  add("status", json_text(name_of(estimate.status)));
  add("message", json_text(estimate.message));
  return indent + "{\n" + text + "\n" + indent + "}";
}

}  // namespace shearfront::fit
