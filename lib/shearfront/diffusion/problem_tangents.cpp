// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/problem_tangents.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shearfront/diffusion/setup.hpp"

namespace shearfront::diffusion {
namespace {

/// Breaks enter piecewise linearly, with a kink wherever one passes the edge of a cell or the middle of it;
/// a smooth initial state is integrated over cells, which costs digits for shorter steps.
double step_of(const Entry& entry, double value, double cell) {
  if (entry.range == Range::positive) return 1e-3 * value;
  const std::string& field = entry.field;
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

/// The problem with one number of the scene moved; nothing if that is no scene.
class Moved {
 public:
  Moved(const Scene<double>& scene, std::size_t entry, std::size_t n_cells)
      : scene_(scene), entry_(entry), n_cells_(n_cells) {}

  [[nodiscard]] std::optional<Problem> operator()(double by) const {
    SceneSpec<double> spec = scene_.spec();
    *entry_places(spec)[entry_] += by;
    if (!find_complaints(spec).empty()) return {};
    return problem_of(Scene<double>(std::move(spec)), n_cells_);
  }

 private:
  const Scene<double>& scene_;
  std::size_t entry_, n_cells_;
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

bool has_problem_tangent(const Entry& entry) {
  const std::string& field = entry.field;
  if (field.starts_with("flux")) return field.ends_with("].above");
  // A solid fraction moves the heights of the cells, too.
  return !field.starts_with("domain.") && !field.starts_with("boundary.") &&
         !field.starts_with("solid_fraction.");
}

std::vector<Tangent> problem_tangents(const Scene<double>& scene, const std::vector<std::size_t>& wanted,
                                      std::size_t n_cells) {
  const double cell = (scene.top() - scene.bottom()) / static_cast<double>(n_cells);
  const std::vector<Entry> all = entries(scene.spec());
  SceneSpec<double> spec = scene.spec();
  const std::vector<double*> places = entry_places(spec);
  std::vector<Tangent> tangents;
  for (const std::size_t i : wanted) {
    // A step that is a difference of doubles: of breaks it is small.
    const double value = *places[i], h = (value + step_of(all[i], value, cell)) - value;
    const std::vector<Weighted> terms = difference(Moved(scene, i, n_cells), h);
    Tangent& tangent = tangents.emplace_back();
    if (terms.empty()) continue;
    tangent.rate = combined(terms, &Problem::rate);
    tangent.diffusivity = combined(terms, &Problem::diffusivity);
    tangent.initial = combined(terms, &Problem::initial);
  }
  return tangents;
}

}  // namespace shearfront::diffusion
