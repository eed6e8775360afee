// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

/// A naive first-order Godunov scheme, slow and short on purpose: the independent solution of the tests.
/// Fluxes are given per cell as functions; the numerical flux takes the minimum (maximum) over a fine
/// sampling of the states between, and at a jump of the coefficient the supply-demand form for fluxes with
/// one minimum.
namespace shearfront::support {

/// Cell averages for one layer with any flux f on [0, 1] with f(0) = f(1) = 0. What lies between samples is missed by
/// at most |f''| / (8 n_samples^2).
inline std::vector<double> godunov_any_flux(const std::function<double(double)>& f, double largest_speed,
                                            const std::function<double(double)>& initial, double t,
                                            int n_cells, int n_samples = 400) {
  std::vector<double> table;
  for (int i = 0; i <= n_samples; ++i) table.push_back(f(static_cast<double>(i) / n_samples));
  const auto face = [&](double l, double r) {
    double best = l <= r ? std::min(f(l), f(r)) : std::max(f(l), f(r));
    const auto lo = static_cast<std::size_t>(std::ceil(std::min(l, r) * n_samples));
    const auto hi = static_cast<std::size_t>(std::floor(std::max(l, r) * n_samples));
    for (std::size_t i = lo; i <= hi && i < table.size(); ++i)
      best = l <= r ? std::min(best, table[i]) : std::max(best, table[i]);
    return best;
  };
  const double dz = 1.0 / n_cells;
  std::vector<double> u(static_cast<std::size_t>(n_cells)), flux(u.size() + 1, 0.0);
  for (std::size_t j = 0; j < u.size(); ++j) u[j] = initial((static_cast<double>(j) + 0.5) * dz);
  const int n_steps = static_cast<int>(std::ceil(t * largest_speed / (0.9 * dz)));
  for (int step = 0; step < n_steps; ++step) {
    for (std::size_t j = 1; j < u.size(); ++j) flux[j] = face(u[j - 1], u[j]);
    for (std::size_t j = 0; j < u.size(); ++j) u[j] -= t / n_steps / dz * (flux[j + 1] - flux[j]);
  }
  return u;
}

}  // namespace shearfront::support
