// SPDX-License-Identifier: BSD-3-Clause
// Prints a table of docs/evidence/accuracy.md: the Engquist-Osher flux as printed in Buerger, Martinez & Villada
// (2023) beside the consistent one, on their Example 1.
#include <cstdio>

#include "shearfront/exact/l1_error.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/cell_states.hpp"
#include "support/printed_engquist_osher.hpp"

int main() {
  using namespace shearfront;
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  const ExactSolution<double> exact(scene);
  constexpr double kPaper[2][4] = {{8.71e-3, 5.34e-3, 1.58e-3, 9.11e-4},
                                   {6.39e-2, 6.10e-2, 5.87e-2, 5.81e-2}};
  constexpr std::size_t kCells[4] = {200, 400, 2000, 4000};
  constexpr double kTimes[2] = {0.5, 6};
  std::printf(
      "| t | cells | paper | flux as printed | mass of it | consistent flux |\n|---|---|---|---|---|---|\n");
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 4; ++k) {
      const auto printed =
          support::profile_of(scene, support::printed_engquist_osher(scene, kTimes[i], kCells[k]));
      EngquistOsherSolver::Options options;
      options.cells = kCells[k];
      SolverRequest request;
      request.times = {kTimes[i]};
      request.profiles = true;
      const auto result = solve<EngquistOsherSolver>(scene, request, options);
      std::printf("| %g | %zu | %.2e | %.2e | %.4f | %.2e |\n", kTimes[i], kCells[k], kPaper[i][k],
                  errors_against(exact, printed, kTimes[i]).l1, printed.mass(),
                  errors_against(exact, result.profiles.at(0), kTimes[i]).l1);
    }
}
