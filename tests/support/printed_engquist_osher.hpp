// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"

/// The Engquist-Osher scheme of Buerger, Martinez & Villada (2023) with the flux as it is printed there,
///
///     F_{j+1/2} = s a(z_{j+1/2}) ( f(max(u_j, 1/2)) + f(min(u_{j+1}, 1/2)) ),   f(u) = u (u - 1),
///
/// that is without - f(1/2) = + 1/4, and phi = 1 below the bottom, 0 above the top. The missing term cancels
/// where a is constant and only there: at a jump of a, grains appear or vanish, in any number of cells. Here
/// to show that, not to be used.
namespace shearfront::support {

/// Cell averages at time t on n equal cells, at half the largest stable time step.
inline std::vector<double> printed_engquist_osher(const Scene<double>& scene, double t, std::size_t n) {
  const auto f = [](double u) { return u * (u - 1); };
  const double dz = (scene.top() - scene.bottom()) / static_cast<double>(n);
  std::vector<double> u(n), flux(n + 1), rate(n + 1);
  double fastest = 0;
  for (std::size_t j = 0; j <= n; ++j) {
    const double z = std::min(scene.top(), scene.bottom() + static_cast<double>(j) * dz);
    rate[j] = scene.scale() * scene.shear_rate_at(z);
    fastest = std::max(fastest, rate[j]);
  }
  for (std::size_t j = 0; j < n; ++j)
    u[j] = scene.initial_phi(scene.bottom() + (static_cast<double>(j) + 0.5) * dz);
  const double steps = std::ceil(t * fastest / (0.5 * dz)), dt = t / steps;
  for (double step = 0; step < steps; ++step) {
    for (std::size_t j = 0; j <= n; ++j) {
      const double below = j == 0 ? 1 : u[j - 1], above = j == n ? 0 : u[j];
      flux[j] = rate[j] * (f(std::max(below, 0.5)) + f(std::min(above, 0.5)));
    }
    for (std::size_t j = 0; j < n; ++j) u[j] -= dt / dz * (flux[j + 1] - flux[j]);
  }
  return u;
}

}  // namespace shearfront::support
