// SPDX-License-Identifier: BSD-3-Clause
// Prints what curved fronts cost and how near they come in the exponential bed of the source paper (Example 2): levels, events,
// nanoseconds per event, exactly integrated L1 errors of the states between fronts and of the lines through the fans, and the
// error of t*.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/track/track.hpp"
#include "support/source_examples.hpp"

namespace shearfront {
namespace {

double seconds_to_steady(const Scene<double>& scene, const TrackOptions& options, double& events) {
  constexpr double kLeast = 0.05;
  const std::clock_t begin = std::clock();
  int n = 0;
  double elapsed = 0;
  do {
    Tracking tracking(scene, options);
    tracking.advance(infinity<double>());
    events = static_cast<double>(tracking.summary().collisions);
    ++n;
    elapsed = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  } while (elapsed < kLeast);
  return elapsed / n;
}

void row(const Scene<double>& scene, const ExactSolution<double>& exact, double t_star, double resolution) {
  TrackOptions steps;
  steps.resolution = resolution;
  double events = 0;
  const double seconds = seconds_to_steady(scene, steps, events);
  TrackOptions lines = steps;
  lines.reconstruct = Reconstruction::linear;
  Tracking stepped(scene, steps), joined(scene, lines);
  std::printf("| %g | %llu | %.0f | %.3g | %.0f |", resolution,
              static_cast<unsigned long long>(stepped.summary().levels), events, 1e3 * seconds,
              1e9 * seconds / events);
  for (const double t : {0.1, 0.6, 1.0}) {
    stepped.advance(t);
    joined.advance(t);
    std::printf(" %.2g / %.2g |", errors_against(exact, stepped.profile(), t).l1,
                errors_against(exact, joined.profile(), t).l1);
  }
  std::printf(" %.2g |\n", *stepped.timeline()->t_star - t_star);
  std::fflush(stdout);
}

}  // namespace
}  // namespace shearfront

int main(int argc, char** argv) {
  using namespace shearfront;
  const double finest = argc > 1 ? std::atof(argv[1]) : 1e-3;
  const Scene<double> scene = support::example_2();
  const ExactSolution<double> exact(scene);
  const double t_star = *exact_timeline(exact).t_star;
  std::printf(
      "| resolution | levels | events | ms | ns per event | t = 0.1 | t = 0.6 | t = 1 | t* |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (double resolution = 0.08; resolution >= finest * 0.999; resolution /= 2)
    row(scene, exact, t_star, resolution);
}
