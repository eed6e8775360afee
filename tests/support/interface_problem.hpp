// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "support/any_flux.hpp"

/// Riemann problems at an interface between any two fluxes of one kind, and a Godunov run of them.
namespace shearfront::support {

inline bool has_minimum(const Flux<double>& flux) { return flux.value(flux.extrema()[0]) < 0; }

/// One side of an interface: rate times flux, the initial state.
struct InterfaceSide {
  Flux<double> flux;
  double rate, state;

  [[nodiscard]] double value(double x) const { return rate * flux.value(x); }
  [[nodiscard]] double extremum() const { return flux.extrema()[0]; }
  [[nodiscard]] double steepest() const {
    const auto [lowest, highest] = flux.range();
    double most = 0;
    for (int i = 0; i <= 64; ++i)
      most = std::max(most, std::abs(flux.derivative(lowest + (highest - lowest) * i / 64)));
    return rate * most;
  }
};
struct InterfaceProblem {
  InterfaceSide below, above;
};

/// Fluxes of `fluxes` that both have a minimum or both a maximum, in both orders; states anywhere, half of
/// them pure or at the extremum.
inline InterfaceProblem random_interface(SceneMaker& maker, const std::vector<Flux<double>>& fluxes) {
  const auto any = [&] { return fluxes[std::size_t(maker.integer(0, int(fluxes.size()) - 1))]; };
  const Flux<double> first = any();
  Flux<double> second = any();
  while (has_minimum(second) != has_minimum(first)) second = any();
  const auto side = [&](const Flux<double>& flux) {
    const auto [lowest, highest] = flux.range();
    InterfaceSide made{flux, maker.uniform(0.1, 4), maker.uniform(lowest, highest)};
    const int kind = maker.integer(0, 5);
    if (kind == 0) made.state = lowest;
    if (kind == 1) made.state = highest;
    if (kind == 2) made.state = made.extremum();
    return made;
  };
  InterfaceSide below = side(first);
  return {std::move(below), side(second)};
}

/// Flux at an interface by supply and demand, on the fluxes themselves.
inline double supply_and_demand(const InterfaceSide& below, double l, const InterfaceSide& above, double r) {
  const double m_l = below.extremum(), m_r = above.extremum();
  if (has_minimum(below.flux)) return std::max(below.value(std::max(l, m_l)), above.value(std::min(r, m_r)));
  return std::min(below.value(std::min(l, m_l)), above.value(std::max(r, m_r)));
}

/// A Godunov run at Courant number 0.9. A Riemann problem has no length: n steps on cells of any size are a
/// run on n cells that gets finer with n.
struct InterfaceRun {
  double lowest, highest;  ///< flux through the interface, over all steps
  double below, above;     ///< flux through the faces next to it, in the last step
};

inline InterfaceRun godunov_run(const InterfaceProblem& complaint, int n_steps) {
  const bool minimum = has_minimum(complaint.below.flux);
  const double courant = 0.9 / std::max(complaint.below.steepest(), complaint.above.steepest());
  // Cells 0 ... n - 1 below and n ... 2 n - 1 above, as many as waves can reach; f(u) of each.
  const auto n = static_cast<std::size_t>(n_steps) + 1;
  std::vector<double> u(2 * n, complaint.below.state), f(2 * n, complaint.below.value(complaint.below.state));
  std::fill(u.begin() + std::ptrdiff_t(n), u.end(), complaint.above.state);
  std::fill(f.begin() + std::ptrdiff_t(n), f.end(), complaint.above.value(complaint.above.state));
  const double m[2] = {complaint.below.extremum(), complaint.above.extremum()};
  const double f_m[2] = {complaint.below.value(m[0]), complaint.above.value(m[1])};
  std::vector<double> flux(2 * n + 1);
  InterfaceRun run{1e300, -1e300, 0, 0};
  for (std::size_t step = 1; step < n; ++step) {
    const std::size_t first = n - step, last = n + step - 1;  // cells that can change
    for (std::size_t j = first; j <= last + 1; ++j) {         // face j is below cell j
      if (j == n) {
        const double from_below = (u[n - 1] > m[0]) == minimum ? f[n - 1] : f_m[0];
        const double from_above = (u[n] < m[1]) == minimum ? f[n] : f_m[1];
        flux[n] = minimum ? std::max(from_below, from_above) : std::min(from_below, from_above);
        continue;
      }
      // The least flux between the two states if they rise, the greatest one if they fall.
      const std::size_t side = j < n ? 0 : 1;
      const bool rises = u[j - 1] <= u[j];
      const double lo = std::min(u[j - 1], u[j]), hi = std::max(u[j - 1], u[j]);
      const bool turns = rises == minimum && lo < m[side] && m[side] < hi;
      flux[j] = turns ? f_m[side] : rises ? std::min(f[j - 1], f[j]) : std::max(f[j - 1], f[j]);
    }
    for (std::size_t j = first; j <= last; ++j) {
      const double change = courant * (flux[j + 1] - flux[j]);
      if (change == 0) continue;
      u[j] -= change;
      f[j] = (j < n ? complaint.below : complaint.above).value(u[j]);
    }
    run.lowest = std::min(run.lowest, flux[n]);
    run.highest = std::max(run.highest, flux[n]);
  }
  run.below = flux[n - 1];
  run.above = flux[n + 1];
  return run;
}

}  // namespace shearfront::support
