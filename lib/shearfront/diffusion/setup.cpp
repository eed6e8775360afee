// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/setup.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include "shearfront/diffusion/cell_rise.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {
namespace {

/// r and D at a height inside a piece without a knot.
class Coefficients {
 public:
  explicit Coefficients(const Scene<double>& scene) : scene_(scene) {
    if (scene.fluxes().size() > 1)
      for (const Flux<double>& flux : scene.fluxes()) signs_.push_back(unit_parabola_sign(flux));
  }
  [[nodiscard]] double rate(double z) const {
    const double r = scene_.scale() * scene_.rate_at(z);
    return signs_.empty() ? r : signs_[scene_.flux_index(z)] * r;
  }
  [[nodiscard]] double diffusivity(double z) const { return scene_.diffusivity_at(z); }

 private:
  const Scene<double>& scene_;
  std::vector<int> signs_;
};

StateRange<double> range_of(const Problem& problem) { return problem.flux.range(); }

/// Lines through the middles of the cells.
Profile<double> lines(const Problem& problem, std::span<const double> means,
                      std::span<const double> half_rises) {
  const std::size_t n = problem.n_cells;
  std::vector<double> z(n + 1), below(n), above(n);
  for (std::size_t j = 0; j <= n; ++j) z[j] = problem.face(j);
  for (std::size_t j = 0; j < n; ++j) {
    below[j] = means[j] - half_rises[j];
    above[j] = means[j] + half_rises[j];
  }
  return {std::move(z), std::move(below), std::move(above)};
}

Problem without_cells(const Scene<double>& scene) {
  Problem problem;
  problem.bottom = scene.bottom(), problem.top = scene.top();
  problem.flux = scene.fluxes().size() > 1 ? Flux<double>(Quadratic<double>{}) : scene.fluxes()[0];
  problem.ends = scene.spec().is_periodic  ? Ends::periodic
                 : scene.spec().is_neumann ? Ends::neumann
                                           : Ends::no_flux;
  return problem;
}

void set_coefficients(const Scene<double>& scene, Problem& problem) {
  const Coefficients at(scene);
  const std::vector<double> knots = scene.knots();
  const std::size_t n = problem.n_cells;
  problem.rate.reserve(n + 1), problem.diffusivity.reserve(n + 1);
  auto knot = knots.begin();
  for (std::size_t i = 0; i <= n; ++i) {
    const double face = problem.face(i);
    const double begin = i > 0 ? face - problem.width(i - 1) / 2 : face;
    const double end = i < n ? face + problem.width(i) / 2 : face;
    while (knot != knots.end() && *knot <= begin) ++knot;
    if (knot == knots.end() || *knot >= end) {
      problem.rate.push_back(at.rate(face));
      problem.diffusivity.push_back(at.diffusivity(face));
      continue;
    }
    double rate = 0, resistance = 0, from = begin;
    const auto add = [&](double to) {
      const double middle = from + (to - from) / 2, part = (to - from) / at.diffusivity(middle);
      rate += at.rate(middle) * part;
      resistance += part;
      from = to;
    };
    for (; knot != knots.end() && *knot < end; ++knot) add(*knot);
    add(end);
    problem.rate.push_back(rate / resistance);
    problem.diffusivity.push_back((end - begin) / resistance);
  }
  if (problem.ends == Ends::periodic) {
    const double below = 1 / problem.diffusivity.back(), above = 1 / problem.diffusivity.front();
    problem.rate.back() = problem.rate.front() =
        (problem.rate.back() * below + problem.rate.front() * above) / (below + above);
    problem.diffusivity.back() = problem.diffusivity.front() = 2 / (below + above);
  }
}

void set_initial(const Scene<double>& scene, Problem& problem) {
  problem.initial.reserve(problem.n_cells);
  for (std::size_t j = 0; j < problem.n_cells; ++j) {
    const double below = problem.face(j), above = problem.face(j + 1);
    problem.initial.push_back(scene.initial_amount(below, above) / (above - below));
  }
}

}  // namespace

std::string refusal(const Scene<double>& scene) {
  if (!scene.has_diffusion()) return "grains do not diffuse in this bed (no D > 0)";
  if (scene.spec().solid_fraction) return "solid fraction and diffusion together are not covered";
  if (scene.spec().outside_bottom || scene.spec().outside_top)
    return "states beyond open ends are not covered with diffusion; boundary.neumann and boundary.periodic "
           "are";
  if (scene.fluxes().size() > 1 &&
      std::any_of(scene.fluxes().begin(), scene.fluxes().end(),
                  [](const Flux<double>& flux) { return unit_parabola_sign(flux) == 0; }))
    return "with diffusion, layers may have the fluxes phi (phi - 1) and phi (1 - phi) only";
  return "";
}

Problem problem_of(const Scene<double>& scene, std::size_t n_cells) {
  SHEARFRONT_EXPECTS(refusal(scene).empty() && n_cells >= 2, "a bed with diffusion and a grid");
  Problem problem = without_cells(scene);
  problem.n_cells = n_cells;
  set_coefficients(scene, problem);
  set_initial(scene, problem);
  return problem;
}

Problem problem_of(const Scene<double>& scene, std::vector<double> faces) {
  Problem problem = problem_without_initial(scene, std::move(faces));
  set_initial(scene, problem);
  return problem;
}

Problem problem_without_initial(const Scene<double>& scene, std::vector<double> faces) {
  SHEARFRONT_EXPECTS(refusal(scene).empty() && faces.size() >= 3, "a bed with diffusion and a grid");
  Problem problem = without_cells(scene);
  problem.n_cells = faces.size() - 1;
  problem.faces = std::move(faces);
  set_coefficients(scene, problem);
  return problem;
}

Profile<double> profile_of(const Problem& problem, std::span<const double> states) {
  const StateRange<double> range = range_of(problem);
  std::vector<double> half(problem.n_cells);
  for (std::size_t j = 0; j < half.size(); ++j) half[j] = bounded_half_rise(problem, states, j, range);
  return lines(problem, states, half);
}

Profile<double> profile_tangent(const Problem& problem, std::span<const double> states,
                                std::span<const double> tangent) {
  const StateRange<double> range = range_of(problem);
  std::vector<double> half(problem.n_cells);
  for (std::size_t j = 0; j < half.size(); ++j) {
    const double below = states[j] - range.lowest, above = range.highest - states[j];
    const double room = std::max(0.0, std::min(below, above)), wanted = half_rise(problem, states, j);
    const double room_grows = room == 0 ? 0 : below < above ? tangent[j] : -tangent[j];
    half[j] = std::abs(wanted) <= room ? half_rise(problem, tangent, j)
              : wanted > 0             ? room_grows
                                       : -room_grows;
  }
  return lines(problem, tangent, half);
}

}  // namespace shearfront::diffusion
