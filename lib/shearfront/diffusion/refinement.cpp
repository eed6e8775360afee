// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "shearfront/diffusion/extended_flux.hpp"
#include "shearfront/diffusion/setup.hpp"

namespace shearfront::diffusion {
namespace {

constexpr double kGrading = 0.0625;
constexpr double kQuiet = 0.03;
/// How often equal cells are halved for what is steeper than any front: data, and their first moments.
constexpr int kHalvingsOfData = 3;
/// max |phi''| of the logistic front 1 / (1 + exp(x)): 1 / (6 sqrt(3)).
constexpr double kFrontBend = 0.09622504486493763;
constexpr int kCallsBetweenCleanings = 32;
/// A grid that has to change takes cells narrower by this than it must: or the next step asks for another one, and
/// cells are halved and merged in turn without end. What states had adjusted to is left behind each time.
constexpr double kMargin = 0.7;

/// phi_z at the end of a bed without flux there; `inner`: what the states beside it say.
double slope_at_end(const Problem& problem, std::size_t face, double state, double inner) {
  if (problem.ends == Ends::neumann) return 0;
  const double f = problem.flux.value(state);
  return problem.diffusivity[face] > 0 ? problem.rate[face] * f / problem.diffusivity[face] : inner;
}

/// Slopes at the faces.
std::vector<double> slopes(const Problem& problem, std::span<const double> states) {
  const std::size_t n = problem.n_cells;
  std::vector<double> all(n + 1);
  double below = problem.width(0);
  for (std::size_t i = 1; i < n; ++i) {
    const double above = problem.width(i);
    all[i] = (states[i] - states[i - 1]) / (0.5 * (below + above));
    below = above;
  }
  if (problem.ends == Ends::periodic) {
    all[0] = all[n] = (states[0] - states[n - 1]) / (0.5 * (problem.width(0) + problem.width(n - 1)));
  } else {
    all[0] = slope_at_end(problem, 0, states[0], all[1]);
    all[n] = slope_at_end(problem, n, states[n - 1], all[n - 1]);
  }
  return all;
}

}  // namespace

std::vector<double> wanted_widths(const Problem& problem, std::span<const double> states,
                                  const Resolution& resolution) {
  const double bend = resolution.bend, quiet = kQuiet * bend * std::sqrt(bend);
  const double front_share = std::sqrt(bend / kFrontBend) / resolution.fastest;
  const double data = std::ldexp(resolution.equal_width, -kHalvingsOfData);
  const double widest = problem.top - problem.bottom;
  const std::vector<double> slope = slopes(problem, states);
  const auto front_at = [&](std::size_t i) {
    return std::min(widest, front_share * problem.diffusivity[i] / std::abs(problem.rate[i]));
  };
  std::vector<double> wanted(problem.n_cells);
  double front_below = front_at(0);
  for (std::size_t j = 0; j < wanted.size(); ++j) {
    const double width = problem.width(j), found = std::abs(slope[j + 1] - slope[j]) * width;
    const double smooth = width * std::sqrt(quiet / std::max(found, 1e-300));
    const double front_above = front_at(j + 1);
    wanted[j] = std::min(std::max(smooth, std::min({front_below, front_above, data})), widest);
    front_below = front_above;
  }
  return wanted;
}

std::vector<double> graded(const Problem& problem, std::vector<double> widths) {
  for (std::size_t j = 1; j < widths.size(); ++j)
    widths[j] = std::min(widths[j], widths[j - 1] + kGrading * problem.width(j - 1));
  for (std::size_t j = widths.size() - 1; j-- > 0;)
    widths[j] = std::min(widths[j], widths[j + 1] + kGrading * problem.width(j + 1));
  return widths;
}

Refinement::Refinement(const Scene<double>& scene, std::size_t n_cells, double bend)
    : scene_(scene),
      cells_(scene.bottom(), scene.top(), n_cells),
      resolution_{bend, (scene.top() - scene.bottom()) / static_cast<double>(n_cells), 0} {}

bool Refinement::change_towards(const Problem& present, std::vector<double> widths,
                                std::vector<CellChange>& changes) {
  widths = graded(present, std::move(widths));
  changes = cells_.changes_towards(widths);
  if (cells_.are_too_wide_for(widths)) is_exhausted_ = true;
  if (std::all_of(changes.begin(), changes.end(), [](CellChange c) { return c == CellChange::keep; }))
    return false;
  const auto n_split = std::count(changes.begin(), changes.end(), CellChange::split);
  if (cells_.size() + static_cast<std::size_t>(n_split) > kMostCells) is_exhausted_ = true;
  if (is_exhausted_) return false;
  cells_.apply(changes);
  return true;
}

Problem Refinement::start() {
  for (int i = 0; i < kHalvingsOfData && 2 * cells_.size() <= kMostCells; ++i)
    cells_.apply(std::vector<CellChange>(cells_.size(), CellChange::split));
  Problem problem = problem_of(scene_, cells_.faces());
  resolution_.fastest = fastest_slope(problem.flux);
  std::vector<CellChange> changes;
  for (int i = 0; i < 2 * RefinedCells::kMostHalvings; ++i) {
    if (!change_towards(problem, wanted_widths(problem, problem.initial, resolution_), changes)) break;
    problem = problem_of(scene_, cells_.faces());
  }
  return problem;
}

std::optional<Regrid> Refinement::next(const Problem& present, std::span<const double> states) {
  std::vector<double> widths = wanted_widths(present, states, resolution_);
  bool is_too_wide = false;
  for (std::size_t j = 0; j < present.n_cells && !is_too_wide; ++j)
    is_too_wide = present.width(j) > widths[j];
  if (!is_too_wide && ++n_calls_ % kCallsBetweenCleanings != 0) return {};
  for (double& width : widths) width *= kMargin;
  if (!is_too_wide && !is_worth_cleaning(present, widths)) return {};
  std::vector<CellChange> changes;
  if (!change_towards(present, std::move(widths), changes)) return {};
  return Regrid{problem_without_initial(scene_, cells_.faces()), std::move(changes)};
}

bool Refinement::is_worth_cleaning(const Problem& present, const std::vector<double>& widths) const {
  const std::vector<CellChange> changes = cells_.changes_towards(graded(present, widths));
  return 4 * std::count(changes.begin(), changes.end(), CellChange::merge) >
         static_cast<std::ptrdiff_t>(changes.size());
}

}  // namespace shearfront::diffusion
