// SPDX-License-Identifier: BSD-3-Clause
// Prints error against time of crank-nicolson for a uniform start between walls: equal cells with fixed
// steps, with adaptive steps, and cells that follow the fronts. Error: of the means of cells, the largest of
// four times.
//   shearfront_diffusion_speed_table
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "shearfront/diffusion/cole_hopf_uniform.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

const std::vector<double> kTimes{0.1, 0.5, 1, 2};

double error_of(const diffusion::UniformStart<double>& exact, const std::vector<Profile<double>>& profiles) {
  double largest = 0;
  for (std::size_t i = 0; i < kTimes.size(); ++i) {
    const std::vector<double>& z = profiles[i].z();
    double below = 0;
    for (std::size_t j = 0; j + 1 < z.size(); ++j) {
      const double M = exact.at(z[j + 1], kTimes[i]).cumulative;
      const double mean = (profiles[i].below()[j] + profiles[i].above()[j]) / 2;
      largest = std::max(largest, std::abs(mean - (M - below) / (z[j + 1] - z[j])));
      below = M;
    }
  }
  return largest;
}

/// Fastest of five runs: the machine may be busy with something else.
void print(double D, const std::string& kind, const CrankNicolsonSolver::Options& options) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.55};
  spec.diffusion = Diffusion<double>{D, {}, false};
  const Scene<double> scene(spec);
  // phi_t + (phi (phi - 1))_z: large grains rise, so r = 1.
  const diffusion::UniformStart<double> exact(0, 1, 1, D, 0.55);
  SolverResult result;
  double seconds = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    result = solve<CrankNicolsonSolver>(scene, {kTimes, {}, false, false, true}, options);
    seconds =
        std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  if (!result.summary.usable()) {
    std::printf("D = %g: %s\n", D, result.summary.message.c_str());
    return;
  }
  std::size_t most = 0;
  for (const auto& profile : result.profiles) most = std::max(most, profile.n_cells());
  std::printf("| %g | %s | %zu | %.1e | %.1f |\n", D, kind.c_str(), most, error_of(exact, result.profiles),
              1e3 * seconds);
  std::fflush(stdout);
}

void print_all() {
  std::printf("| D | steps and cells | cells | error | ms |\n|---|---|---|---|---|\n");
  for (const double D : {0.02, 0.002}) {
    for (std::size_t n = 500; n <= 4000; n *= 2) {
      CrankNicolsonSolver::Options options;
      options.cells = n;
      options.time_step = 0.2 / static_cast<double>(n);
      print(D, "fixed", options);
    }
    for (std::size_t n = 500; n <= 8000; n *= 2) {
      CrankNicolsonSolver::Options options;
      options.cells = n;
      options.tolerance = (D < 0.01 ? 500.0 : 5.0) / std::pow(static_cast<double>(n), 2);
      print(D, "adaptive", options);
    }
    for (double tolerance = 3e-2; tolerance > 1e-4; tolerance /= 4) {
      CrankNicolsonSolver::Options options;
      options.cells = 50;
      options.cell_tolerance = tolerance;
      options.tolerance = 0.03 * tolerance;
      print(D, "adaptive, cells follow fronts", options);
    }
  }
}

}  // namespace
}  // namespace shearfront

int main() { shearfront::print_all(); }
