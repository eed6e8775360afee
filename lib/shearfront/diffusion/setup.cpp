// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/setup.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {
namespace {

/// +1 for phi (phi - 1), -1 for phi (1 - phi), 0 for any other flux.
int sign_of(const Flux<double>& flux) {
  return std::visit(
      [](const auto& f) {
        const StateRange<double> range = f.range();
        if (!f.kIsParabola || range.lowest != 0 || range.highest != 1) return 0;
        const double at_extremum = f.value(0.5);
        return at_extremum == -0.25 ? 1 : at_extremum == 0.25 ? -1 : 0;
      },
      flux);
}

/// r and D at a height inside a piece without a knot.
class Coefficients {
 public:
  explicit Coefficients(const Scene<double>& scene) : scene_(scene) {
    if (scene.fluxes().size() > 1)
      for (const Flux<double>& flux : scene.fluxes()) signs_.push_back(sign_of(flux));
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

StateRange<double> range_of(const Problem& problem) {
  return std::visit([](const auto& flux) { return flux.range(); }, problem.flux);
}

/// By how much the parabola through the means of cell j and its neighbours rises over half the cell.
double rise(const Problem& problem, std::span<const double> means, std::size_t j) {
  const std::size_t n = problem.n_cells;
  if (problem.ends == Ends::periodic) return (means[(j + 1) % n] - means[(j + n - 1) % n]) / 4;
  if (n < 3) return 0.0;
  if (j == 0) return (4 * means[1] - 3 * means[0] - means[2]) / 4;
  if (j == n - 1) return (3 * means[j] - 4 * means[j - 1] + means[j - 2]) / 4;
  return (means[j + 1] - means[j - 1]) / 4;
}

/// Lines through the middles of the cells.
Profile<double> lines(const Problem& problem, std::span<const double> means,
                      std::span<const double> half_rises) {
  const std::size_t n = problem.n_cells;
  std::vector<double> z(n + 1), below(n), above(n);
  for (std::size_t j = 0; j <= n; ++j)
    z[j] = j == n ? problem.top : problem.bottom + problem.width() * static_cast<double>(j);
  for (std::size_t j = 0; j < n; ++j) {
    below[j] = means[j] - half_rises[j];
    above[j] = means[j] + half_rises[j];
  }
  return {std::move(z), std::move(below), std::move(above)};
}

}  // namespace

std::string refusal(const Scene<double>& scene) {
  if (!scene.has_diffusion())
    return "grains do not diffuse in this bed (no D > 0); use exact, front-tracking or a finite-volume "
           "method";
  if (scene.spec().packing) return "packing and diffusion together are not covered";
  if (scene.spec().outside_bottom || scene.spec().outside_top)
    return "states beyond open ends are not covered with diffusion; boundary.neumann and boundary.periodic "
           "are";
  if (scene.fluxes().size() > 1 && std::any_of(scene.fluxes().begin(), scene.fluxes().end(),
                                               [](const Flux<double>& flux) { return sign_of(flux) == 0; }))
    return "with diffusion, layers may have the fluxes phi (phi - 1) and phi (1 - phi) only";
  return "";
}

Problem problem_of(const Scene<double>& scene, std::size_t n_cells) {
  SHEARFRONT_EXPECTS(refusal(scene).empty() && n_cells >= 2, "a bed with diffusion and a grid");
  Problem problem;
  problem.bottom = scene.bottom(), problem.top = scene.top();
  problem.n_cells = n_cells;
  problem.flux = scene.fluxes().size() > 1 ? Flux<double>(Quadratic<double>{}) : scene.fluxes()[0];
  problem.ends = scene.spec().is_periodic  ? Ends::periodic
                 : scene.spec().is_neumann ? Ends::neumann
                                           : Ends::no_flux;
  const Coefficients at(scene);
  const std::vector<double> knots = scene.knots();
  const double width = problem.width();
  const auto edge = [&](std::size_t i) {
    return i == n_cells ? scene.top() : scene.bottom() + width * static_cast<double>(i);
  };
  auto knot = knots.begin();
  for (std::size_t i = 0; i <= n_cells; ++i) {
    const double face = edge(i), begin = std::max(scene.bottom(), face - width / 2);
    const double end = std::min(scene.top(), face + width / 2);
    while (knot != knots.end() && *knot <= begin) ++knot;
    if (knot == knots.end() || *knot >= end) {
      problem.rate.push_back(at.rate(face));
      problem.diffusivity.push_back(at.diffusivity(face));
      continue;
    }
    double rate = 0, resistance = 0, from = begin;
    const auto add = [&](double to) {
      const double middle = from + (to - from) / 2;
      rate += at.rate(middle) * (to - from);
      resistance += (to - from) / at.diffusivity(middle);
      from = to;
    };
    for (; knot != knots.end() && *knot < end; ++knot) add(*knot);
    add(end);
    problem.rate.push_back(rate / (end - begin));
    problem.diffusivity.push_back((end - begin) / resistance);
  }
  if (problem.ends == Ends::periodic) {
    problem.rate.back() = problem.rate.front() = (problem.rate.front() + problem.rate.back()) / 2;
    problem.diffusivity.back() = problem.diffusivity.front() =
        2 / (1 / problem.diffusivity.front() + 1 / problem.diffusivity.back());
  }
  for (std::size_t j = 0; j < n_cells; ++j)
    problem.initial.push_back(scene.initial_amount(edge(j), edge(j + 1)) / (edge(j + 1) - edge(j)));
  return problem;
}

Profile<double> profile_of(const Problem& problem, std::span<const double> states) {
  const StateRange<double> range = range_of(problem);
  std::vector<double> half(problem.n_cells);
  for (std::size_t j = 0; j < half.size(); ++j) {
    const double room = std::max(0.0, std::min(states[j] - range.lowest, range.highest - states[j]));
    half[j] = std::clamp(rise(problem, states, j), -room, room);
  }
  return lines(problem, states, half);
}

Profile<double> profile_tangent(const Problem& problem, std::span<const double> states,
                                std::span<const double> tangent) {
  const StateRange<double> range = range_of(problem);
  std::vector<double> half(problem.n_cells);
  for (std::size_t j = 0; j < half.size(); ++j) {
    const double below = states[j] - range.lowest, above = range.highest - states[j];
    const double room = std::max(0.0, std::min(below, above)), wanted = rise(problem, states, j);
    const double room_grows = room == 0 ? 0 : below < above ? tangent[j] : -tangent[j];
    half[j] = std::abs(wanted) <= room ? rise(problem, tangent, j) : wanted > 0 ? room_grows : -room_grows;
  }
  return lines(problem, tangent, half);
}

}  // namespace shearfront::diffusion
