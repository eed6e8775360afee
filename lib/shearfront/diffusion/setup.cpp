// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/setup.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include "shearfront/diffusion/cell_rise.hpp"
#include "shearfront/diffusion/solid_heights.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {
namespace {

/// r and D of the coordinate at a height inside a piece without a knot.
class Coefficients {
 public:
  Coefficients(const Scene<double>& scene, const SolidHeights& solid) : scene_(scene), solid_(solid) {
    if (scene.fluxes().size() > 1)
      for (const Flux<double>& flux : scene.fluxes()) signs_.push_back(unit_parabola_sign(flux));
  }
  [[nodiscard]] double rate(double z) const {
    const double r = scene_.scale() * scene_.rate_at(z) * solid_.density(z);
    return signs_.empty() ? r : signs_[scene_.flux_index(z)] * r;
  }
  [[nodiscard]] double diffusivity(double z) const {
    const double density = solid_.density(z);
    return scene_.diffusivity_at(z) * density * density;
  }

 private:
  const Scene<double>& scene_;
  const SolidHeights& solid_;
  std::vector<int> signs_;
};

StateRange<double> range_of(const Problem& problem) { return problem.flux.range(); }

/// Lines of shares through the middles of the cells, as lines of phi in the pieces.
Profile<double> lines_of_phi(const Problem& problem, std::span<const double> means,
                             std::span<const double> half_rises) {
  std::vector<double> z, below, above;
  for (const SolidPiece& piece : problem.pieces) {
    const double low = problem.face(piece.cell), high = problem.face(piece.cell + 1);
    const auto share = [&](double m) {
      return means[piece.cell] + half_rises[piece.cell] * ((2 * m - low - high) / (high - low));
    };
    const double x_below = share(piece.m_below), x_above = share(piece.m_above);
    const double height = piece.z_above - piece.z_below;
    double phi_below = piece.c_below * x_below, phi_above = piece.c_above * x_above;
    const double solid = problem.mean_solid_fraction * (piece.m_above - piece.m_below);
    const double missing = piece.c_below == piece.c_above
                               ? 0
                               : solid * ((x_below + x_above) / 2) / height - (phi_below + phi_above) / 2;
    z.push_back(piece.z_below);
    below.push_back(phi_below + missing);
    above.push_back(phi_above + missing);
  }
  z.push_back(problem.pieces.back().z_above);
  return {std::move(z), std::move(below), std::move(above)};
}

/// Lines through the middles of the cells.
Profile<double> lines(const Problem& problem, std::span<const double> means,
                      std::span<const double> half_rises) {
  if (!problem.pieces.empty()) return lines_of_phi(problem, means, half_rises);
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

/// The parts of the cells between the knots of the solid fraction.
void set_pieces(const Scene<double>& scene, const SolidHeights& solid, Problem& problem) {
  if (solid.is_identity()) return;
  problem.mean_solid_fraction = scene.solid(scene.bottom(), scene.top()) / (scene.top() - scene.bottom());
  const bool is_layered = is_constant_in_pieces<double>(scene.spec().solid_fraction);
  auto knot = solid.knots().begin();
  double from = scene.bottom();
  for (std::size_t j = 0; j < problem.n_cells; ++j) {
    const double top = j + 1 == problem.n_cells ? scene.top() : solid.height(problem.face(j + 1));
    const auto add = [&](double to) {
      if (!(to > from)) return;
      const double c = scene.solid_fraction_at(from);
      const auto [c_below, c_above] = is_layered
                                          ? EndValues<double>{c, c}
                                          : end_values_of<double>(*scene.spec().solid_fraction, from, to);
      problem.pieces.push_back({j, from, to, std::max(solid.coordinate(from), problem.face(j)),
                                std::min(solid.coordinate(to), problem.face(j + 1)), c_below, c_above});
      from = to;
    };
    for (; knot != solid.knots().end() && *knot < top; ++knot) add(*knot);
    add(top);
  }
}

void set_coefficients(const Scene<double>& scene, const SolidHeights& solid, Problem& problem) {
  const Coefficients at(scene, solid);
  const std::vector<double> knots = scene.knots();
  const std::size_t n = problem.n_cells;
  problem.rate.reserve(n + 1), problem.diffusivity.reserve(n + 1);
  auto knot = knots.begin();
  for (std::size_t i = 0; i <= n; ++i) {
    const double face = problem.face(i);
    const double begin = i > 0 ? face - problem.width(i - 1) / 2 : face;
    const double end = i < n ? face + problem.width(i) / 2 : face;
    const double z_begin = solid.height(begin), z_end = solid.height(end);
    while (knot != knots.end() && *knot <= z_begin) ++knot;
    if (knot == knots.end() || *knot >= z_end) {
      const double z = solid.height(face);
      problem.rate.push_back(at.rate(z));
      problem.diffusivity.push_back(at.diffusivity(z));
      continue;
    }
    double rate = 0, resistance = 0, from = z_begin;
    const auto add = [&](double to) {
      const double middle = from + (to - from) / 2;
      const double part = solid.density(middle) * (to - from) / at.diffusivity(middle);
      rate += at.rate(middle) * part;
      resistance += part;
      from = to;
    };
    for (; knot != knots.end() && *knot < z_end; ++knot) add(*knot);
    add(z_end);
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

void set_grid(const Scene<double>& scene, Problem& problem) {
  const SolidHeights solid(scene);
  set_coefficients(scene, solid, problem);
  set_pieces(scene, solid, problem);
}

void set_initial(const Scene<double>& scene, Problem& problem) {
  problem.initial.reserve(problem.n_cells);
  if (problem.pieces.empty()) {
    for (std::size_t j = 0; j < problem.n_cells; ++j) {
      const double below = problem.face(j), above = problem.face(j + 1);
      problem.initial.push_back(scene.initial_amount(below, above) / (above - below));
    }
    return;
  }
  std::vector<double> grains(problem.n_cells);
  for (const SolidPiece& piece : problem.pieces)
    grains[piece.cell] += scene.initial_amount(piece.z_below, piece.z_above);
  for (std::size_t j = 0; j < problem.n_cells; ++j)
    problem.initial.push_back(grains[j] / (problem.mean_solid_fraction * problem.width(j)));
}

}  // namespace

std::string refusal(const Scene<double>& scene) {
  if (!scene.has_diffusion()) return "grains do not diffuse in this bed (no D > 0)";
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
  set_grid(scene, problem);
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
  set_grid(scene, problem);
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
