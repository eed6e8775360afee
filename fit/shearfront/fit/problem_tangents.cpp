// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/problem_tangents.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shearfront/diffusion/setup.hpp"

namespace shearfront::fit {
namespace {

using diffusion::Problem;
using diffusion::Tangent;

/// Breaks enter piecewise linearly, with a kink wherever one passes the edge of a cell or the middle of it;
/// a smooth initial profile is integrated over cells, which costs digits for shorter steps.
double step_of(const Parameter& parameter, double value, double cell) {
  if (parameter.entry.range == Range::positive) return 1e-3 * value;
  const std::string& field = parameter.entry.field;
  if (field == "initial.centre" || field == "initial.origin") return 1e-2 * cell;
  const bool is_height = field.ends_with(".breaks") || field.ends_with(".z") || field.ends_with(".above");
  return is_height && field != "initial.above" ? 1e-3 * cell : 1e-3 * std::max(1.0, std::abs(value));
}

struct Weighted {
  std::optional<Problem> problem;
  double weight;
};

/// sum of weight x part over the problems, a part being one of their vectors.
std::vector<double> combined(const std::vector<Weighted>& terms, std::vector<double> Problem::*part) {
  std::vector<double> sum((*terms.front().problem.*part).size());
  for (const Weighted& term : terms)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += term.weight * ((*term.problem).*part)[i];
  return sum;
}

/// The problem with one value moved; nothing if that is no scene.
class Moved {
 public:
  Moved(const Parameters& parameters, Eigen::VectorXd values, Eigen::Index column, std::size_t n_cells)
      : parameters_(parameters), values_(std::move(values)), column_(column), n_cells_(n_cells) {}

  [[nodiscard]] std::optional<Problem> operator()(double by) const {
    Eigen::VectorXd moved = values_;
    moved[column_] += by;
    SceneSpec<double> spec = parameters_.scene_with(moved);
    if (!find_complaints(spec).empty()) return {};
    return diffusion::problem_of(Scene<double>(std::move(spec)), n_cells_);
  }

 private:
  const Parameters& parameters_;
  Eigen::VectorXd values_;
  Eigen::Index column_;
  std::size_t n_cells_;
};

std::vector<Weighted> difference(const Moved& at, double h) {
  std::vector<Weighted> terms{
      {at(h), 8 / (12 * h)}, {at(-h), -8 / (12 * h)}, {at(2 * h), -1 / (12 * h)}, {at(-2 * h), 1 / (12 * h)}};
  const auto exists = [](const Weighted& term) { return term.problem.has_value(); };
  if (std::all_of(terms.begin(), terms.end(), exists)) return terms;
  const double side = exists(terms[0]) && exists(terms[2]) ? h : -h;
  terms = {{at(0), -3 / (2 * side)}, {at(side), 4 / (2 * side)}, {at(2 * side), -1 / (2 * side)}};
  return std::all_of(terms.begin(), terms.end(), exists) ? terms : std::vector<Weighted>{};
}

}  // namespace

bool has_problem_tangent(const std::string& field) {
  if (field.starts_with("flux")) return field.ends_with("].above");
  return !field.starts_with("domain.") && !field.starts_with("boundary.");
}

std::vector<Tangent> problem_tangents(const Parameters& parameters, const Eigen::VectorXd& values,
                                      std::size_t n_cells) {
  const Scene<double>& scene = parameters.scene();
  const double cell = (scene.top() - scene.bottom()) / static_cast<double>(n_cells);
  std::vector<Tangent> tangents;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Moved at(parameters, values, column, n_cells);
    // A step that is a difference of doubles: of breaks it is small.
    const double value = values[column], h = (value + step_of(parameters[k], value, cell)) - value;
    const std::vector<Weighted> terms = difference(at, h);
    Tangent& tangent = tangents.emplace_back();
    if (terms.empty()) continue;
    tangent.rate = combined(terms, &Problem::rate);
    tangent.diffusivity = combined(terms, &Problem::diffusivity);
    tangent.initial = combined(terms, &Problem::initial);
  }
  return tangents;
}

}  // namespace shearfront::fit
