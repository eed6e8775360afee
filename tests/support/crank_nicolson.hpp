// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

namespace shearfront::support {

/// phi_t + (r phi (phi - 1))_z = D phi_zz on [0, 1] between no-flux walls from a uniform start: cell means at
/// time `end` by the plainest conservative scheme, central in space, four Newton passes in each step (from
/// 1e-3 quadratically below rounding). The first two steps are four half steps backward: the start does not
/// satisfy the wall condition, and Crank-Nicolson would keep that as an oscillation.
/// Error O(1 / n^2 + step^2).
inline std::vector<double> plain_crank_nicolson(double r, double diffusivity, double start, double end,
                                                std::size_t n, std::size_t n_steps) {
  const double dz = 1 / double(n), dt = end / double(n_steps), k = diffusivity / dz;
  std::vector<double> phi(n, start), low(n), diagonal(n), high(n), rest(n);
  const auto step = [&](double length, double theta) {
    const std::vector<double> old = phi;
    for (int pass = 0; pass < 4; ++pass) {
      std::vector<double> p(n);
      for (std::size_t i = 0; i < n; ++i) {
        p[i] = theta * phi[i] + (1 - theta) * old[i];
        low[i] = high[i] = 0;
        diagonal[i] = 1;
        rest[i] = old[i] - phi[i];
      }
      for (std::size_t i = 0; i + 1 < n; ++i) {  // the face between cells i and i + 1
        const double mean = (p[i] + p[i + 1]) / 2, slope = r * (2 * mean - 1) / 2, s = length / dz;
        const double flux = r * mean * (mean - 1) - k * (p[i + 1] - p[i]);
        rest[i] -= s * flux;
        rest[i + 1] += s * flux;
        diagonal[i] += s * theta * (slope + k);
        high[i] += s * theta * (slope - k);
        diagonal[i + 1] -= s * theta * (slope - k);
        low[i + 1] -= s * theta * (slope + k);
      }
      for (std::size_t i = 1; i < n; ++i) {
        const double factor = low[i] / diagonal[i - 1];
        diagonal[i] -= factor * high[i - 1];
        rest[i] -= factor * rest[i - 1];
      }
      for (std::size_t i = n; i-- > 0;) {
        if (i + 1 < n) rest[i] -= high[i] * rest[i + 1];
        rest[i] /= diagonal[i];
        phi[i] += rest[i];
      }
    }
  };
  for (int half = 0; half < 4; ++half) step(dt / 2, 1);
  for (std::size_t i = 2; i < n_steps; ++i) step(dt, 0.5);
  return phi;
}

}  // namespace shearfront::support
