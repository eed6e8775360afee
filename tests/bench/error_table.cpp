// SPDX-License-Identifier: BSD-3-Clause
// Prints the error tables of docs/accuracy.md: front tracking against the exact solution, with the median
// time of a run.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "shearfront/hopf_lax/l1_error.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"

namespace shearfront {
namespace {

constexpr int kRuns = 5;

void table(const char* title, const Scene<double>& scene, double t, const std::vector<double>& resolutions) {
  const ExactSolution<double> exact(scene);
  std::printf(
      "%s, t = %g\n\n| R | layers | collisions | time [ms] | L1, steps | L1, lines | largest error of M |\n",
      title, t);
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const double resolution : resolutions) {
    std::vector<double> seconds;
    for (int run = 0;; ++run) {
      const auto begin = std::chrono::steady_clock::now();
      const TrackingSetup<double> setup(scene, resolution);
      Tracker<LevelGrid<double>> tracker(setup.grid, setup.pieces);
      tracker.advance_to(t);
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      if (run + 1 < kRuns && seconds.back() < 1) continue;
      std::sort(seconds.begin(), seconds.end());
      const auto steps = errors_against(exact, tracker.profile(), t);
      const auto lines = errors_against(exact, linear_profile(tracker), t);
      std::printf("| %g | %zu | %llu | %.3g | %.1e | %.1e | %.1e |\n", resolution, setup.stack.n_layers(),
                  static_cast<unsigned long long>(tracker.n_collisions()), 1e3 * seconds[seconds.size() / 2],
                  steps.l1, lines.l1, steps.M_max);
      break;
    }
  }
  std::printf("\n");
}

}  // namespace
}  // namespace shearfront

int main() {
  using namespace shearfront;
  SceneSpec<double> spec;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  const std::vector<double> resolutions{0.1, 0.01, 0.001, 0.0001};
  table("Example 1", Scene<double>(spec), 0.5, resolutions);
  table("Example 1", Scene<double>(spec), 6, resolutions);
  spec.shear_rate = Exponential<double>{0.87 / 0.205, 0.205};
  spec.scale = 13.60;
  table("Example 2", Scene<double>(spec), 0.9, {0.1, 0.05, 0.04, 0.02, 0.01, 0.005});
}
