// SPDX-License-Identifier: BSD-3-Clause
// Prints how the diffusive bed of May et al. (2010) tends to front tracking as D -> 0:
//   shearfront_diffusion_limit_table [least D, default 1e-5]
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "shearfront/diffusion/crank_nicolson_solver.hpp"
#include "shearfront/hopf_lax/exact_solution.hpp"
#include "shearfront/hopf_lax/l1_error.hpp"
#include "shearfront/track/solver.hpp"

namespace shearfront {
namespace {

SceneSpec<double> may() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

void print(double least) {
  const std::vector<double> times{0.5, 2, 6};
  const SolverRequest request{times, {}, false, false, true};
  const Scene<double> limit(may());
  const ExactSolution<double> exact(limit);
  SolverOptions tracking;
  tracking.resolution = 1e-4;
  tracking.reconstruct = Reconstruction::linear;
  const auto tracked = FrontTrackingSolver::solve(limit, request, tracking);
  std::printf(
      "| D | cells | steps | seconds | t = 0.5 | order | t = 2 | order | t = 6 | order | from exact |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<double> last(3, 0);
  for (double D = 1e-2; D > 0.9 * least; D /= 10) {
    SceneSpec<double> spec = may();
    spec.diffusion = Diffusion<double>{D, {}, false};
    SolverOptions options;
    // Cells of 2/5 of the width D / (s a) of the sharpest front; time steps whose error is far below the
    // distance.
    options.cells = static_cast<std::size_t>(std::max(2000.0, 1 / D));
    options.tolerance = 1e-2;
    const auto begin = std::chrono::steady_clock::now();
    const auto result = CrankNicolsonSolver::solve(Scene<double>(spec), request, options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (result.profiles.size() != 3) {
      std::printf("D = %g: %s\n", D, result.summary.message.c_str());
      return;
    }
    std::printf("| %.0e | %zu | %llu | %.2f |", D, options.cells,
                static_cast<unsigned long long>(result.summary.cell_updates / options.cells), seconds);
    double worst = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double l1 = l1_distance(result.profiles[i], tracked.profiles[i]);
      worst = std::max(worst, std::abs(l1 - errors_against(exact, result.profiles[i], times[i]).l1));
      std::printf(" %.3e | %s |", l1,
                  last[i] > 0 ? std::to_string(std::log10(last[i] / l1)).substr(0, 4).c_str() : "");
      last[i] = l1;
    }
    std::printf(" %.0e |\n", worst);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace shearfront

int main(int argc, char** argv) {
  shearfront::print(argc > 1 ? std::atof(argv[1]) : 1e-5);
  return 0;
}
