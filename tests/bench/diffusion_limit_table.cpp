// SPDX-License-Identifier: BSD-3-Clause
// Prints how the diffusive bed of May et al. (2010) tends to front tracking as D -> 0:
//   shearfront_diffusion_limit_table [least D, default 1e-6]
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

constexpr std::array<double, 3> kTimes{0.5, 2, 6};

SceneSpec<double> may() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

/// Cells that follow the fronts. The fan, which is all there is at t = 0.5, needs phi to about D; the fronts
/// that come later force short steps for any tolerance.
CrankNicolsonSolver::Options refined(bool has_fronts, double cell_tolerance = 1e-2) {
  CrankNicolsonSolver::Options options;
  options.cells = 400;
  options.cell_tolerance = has_fronts ? cell_tolerance : 0.1 * cell_tolerance;
  options.tolerance = has_fronts ? 1e-3 : 1e-5;
  return options;
}
/// Equal cells of 2/5 of the width D / (s a) of the sharpest front.
CrankNicolsonSolver::Options equal(double D) {
  CrankNicolsonSolver::Options options;
  options.cells = static_cast<std::size_t>(std::max(2000.0, 1 / D));
  options.tolerance = 1e-3;
  return options;
}

/// The bed with this D at the three times, with the solver's account of each run.
struct Run {
  std::vector<Profile<double>> profiles;
  double cell_updates = 0, seconds = 0;

  template <class OptionsOf>
  Run(double D, const OptionsOf& options_of) {
    SceneSpec<double> spec = may();
    spec.diffusion = Diffusion<double>{D, {}, false};
    const std::clock_t begin = std::clock();  // of the processor: the machine may be busy with something else
    for (const bool has_fronts : {false, true}) {
      const std::vector<double> times =
          has_fronts ? std::vector<double>{kTimes[1], kTimes[2]} : std::vector<double>{kTimes[0]};
      auto result = solve<CrankNicolsonSolver>(Scene<double>(spec), {times, {}, false, false, true},
                                               options_of(has_fronts));
      if (!result.summary.usable()) {
        std::printf("D = %g: %s\n", D, result.summary.message.c_str());
        std::exit(1);
      }
      for (auto& profile : result.profiles) profiles.push_back(std::move(profile));
      cell_updates += static_cast<double>(result.summary.cell_updates);
    }
    seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
};

/// The larger relative difference at t = 2 and t = 6, in per cent.
std::string difference(const Run& a, const Run& b, const std::vector<Profile<double>>& limit) {
  double most = 0;
  for (std::size_t i = 1; i < kTimes.size(); ++i)
    most = std::max(
        most, std::abs(l1_distance(a.profiles[i], limit[i]) / l1_distance(b.profiles[i], limit[i]) - 1));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f %%", 100 * most);
  return text.data();
}

void print(double least) {
  const Scene<double> limit(may());
  const ExactSolution<double> exact(limit);
  FrontTrackingSolver::Options tracking;
  tracking.resolution = 1e-5;
  tracking.reconstruct = Reconstruction::linear;
  const auto tracked =
      solve<FrontTrackingSolver>(limit, {{kTimes.begin(), kTimes.end()}, {}, false, false, true}, tracking);
  std::printf(
      "| D | cells at t = 2 | cell updates | seconds | t = 0.5 | order | t = 2 | order | t = 6 | order | "
      "from exact "
      "| narrower cells | equal cells |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::array<double, 3> last{};
  for (double D = 1e-2; D > 0.9 * least; D /= 10) {
    const Run run(D, [](bool has_fronts) { return refined(has_fronts); });
    std::printf("| %.0e | %zu | %.1e | %.2f |", D, run.profiles[1].n_cells(), run.cell_updates, run.seconds);
    double worst = 0;
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
      const double l1 = l1_distance(run.profiles[i], tracked.profiles[i]);
      worst = std::max(worst, std::abs(l1 - errors_against(exact, run.profiles[i], kTimes[i]).l1));
      std::printf(" %.3e | %s |", l1,
                  last[i] > 0 ? std::to_string(std::log10(last[i] / l1)).substr(0, 4).c_str() : "");
      last[i] = l1;
    }
    std::string narrower, with_equal;
    if (D > 0.9e-5)
      narrower = difference(run, Run(D, [](bool has_fronts) { return refined(has_fronts, 2.5e-3); }),
                            tracked.profiles);
    if (D > 0.9e-4) with_equal = difference(run, Run(D, [&](bool) { return equal(D); }), tracked.profiles);
    std::printf(" %.0e | %s | %s |\n", worst, narrower.c_str(), with_equal.c_str());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace shearfront

int main(int argc, char** argv) {
  shearfront::print(argc > 1 ? std::atof(argv[1]) : 1e-6);
  return 0;
}
