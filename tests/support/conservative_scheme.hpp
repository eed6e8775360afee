// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// An independent, deliberately naive solver for checks of the exact solution: first-order conservative
/// scheme u_j -= dt / dz_j (F_{j+1/2} - F_{j-1/2}) with the exact flux of the Riemann problem at every face,
///     F = max( s a_L f(max(u_L, 1/2)), s a_R f(min(u_R, 1/2)) ),   f(u) = u (u - 1),   F = 0 at the walls.
/// It knows nothing of paths, fans or interfaces; shares no code with the library.
namespace shearfront::support {

struct ConservativeScheme {
  std::vector<double> edge, rate, u;

  /// About `n_cells` cells, every layer and every piece of the initial data cut into equal cells.
  template <class Rate, class Initial>
  ConservativeScheme(std::vector<double> cuts, Rate&& s_times_a, Initial&& phi, std::size_t n_cells) {
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    const double height = cuts.back() - cuts.front();
    edge.push_back(cuts.front());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double piece = cuts[i + 1] - cuts[i];
      const int n = std::max(1, static_cast<int>(std::lround(piece / height * static_cast<double>(n_cells))));
      for (int j = 1; j <= n; ++j) {
        const double lo = edge.back(), hi = j == n ? cuts[i + 1] : cuts[i] + piece * j / n;
        edge.push_back(hi);
        rate.push_back(s_times_a(0.5 * (lo + hi)));
        u.push_back(phi(0.5 * (lo + hi)));
      }
    }
  }

  void advance(double time) {
    double dt_max = time;
    for (std::size_t j = 0; j < u.size(); ++j)
      dt_max = std::min(dt_max, 0.95 * (edge[j + 1] - edge[j]) / rate[j]);
    const auto steps = static_cast<std::size_t>(std::ceil(time / dt_max));
    const double dt = time / static_cast<double>(steps);
    std::vector<double> flux(u.size() + 1, 0.0);
    const auto f = [](double p) { return p * (p - 1); };
    for (std::size_t n = 0; n < steps; ++n) {
      for (std::size_t j = 1; j < u.size(); ++j)
        flux[j] = std::max(rate[j - 1] * f(std::max(u[j - 1], 0.5)), rate[j] * f(std::min(u[j], 0.5)));
      for (std::size_t j = 0; j < u.size(); ++j)
        u[j] -= dt / (edge[j + 1] - edge[j]) * (flux[j + 1] - flux[j]);
    }
  }

  /// int_bottom^z u at the cell edges.
  [[nodiscard]] std::vector<double> cumulative() const {
    std::vector<double> M{0.0};
    for (std::size_t j = 0; j < u.size(); ++j) M.push_back(M.back() + u[j] * (edge[j + 1] - edge[j]));
    return M;
  }
};

}  // namespace shearfront::support
