// SPDX-License-Identifier: BSD-3-Clause
// Prints what curved fronts cost and how near they come in the exponential bed of the source paper (Example 2): levels, events,
// nanoseconds per event, exactly integrated L1 errors of the states between fronts and of the lines through the fans, and the
// error of t*. Arguments: the finest resolution; "smooth": the same in beds that parts stand for.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/model/flux/all.hpp"
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

struct NamedBed {
  const char* name;
  SceneSpec<double> spec;
};
std::vector<NamedBed> smooth_beds() {
  SceneSpec<double> base = support::example_2().spec();
  SceneSpec<double> T = base, c = base, own = base, fluxes = base;
  T.temperature = Table<double>{{0, 1}, {1, 1.5}};
  c.solid_fraction = Table<double>{{0, 0.5, 1}, {0.62, 0.55, 0.4}};
  Kinetic<double> kinetic;
  kinetic.amplitude = 2, kinetic.length = 0.3, kinetic.load = 0.5, kinetic.lid = 1.2;
  own.shear_rate = kinetic;
  fluxes.fluxes = {Cubic<double>{0.3}, Quadratic<double>{}};
  fluxes.flux_breaks = {0.55};
  return {{"T", T}, {"c", c}, {"kinetic", own}, {"two fluxes", fluxes}};
}

void smooth_table(double finest) {
  constexpr double kTime = 0.4;
  std::printf(
      "| bed | resolution | pieces | levels | events | ms | steps | lines | M |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [name, spec] : smooth_beds()) {
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    for (double resolution = 0.04; resolution >= finest * 0.999; resolution /= 2) {
      TrackOptions steps, lines;
      steps.resolution = lines.resolution = resolution;
      lines.reconstruct = Reconstruction::linear;
      const std::clock_t begin = std::clock();
      Tracking stepped(scene, steps);
      stepped.advance(kTime);
      const double ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      Tracking joined(scene, lines);
      joined.advance(kTime);
      const auto field = stepped.field(scene);
      double M = 0;
      for (int i = 1; i < 40; ++i)
        M = std::max(M, std::abs(field->at(i / 40.0).M - exact.M(i / 40.0, kTime)));
      const Summary summary = stepped.summary();
      std::printf("| %s | %g | %llu | %llu | %llu | %.2g | %.2g | %.2g | %.2g |\n", name, resolution,
                  static_cast<unsigned long long>(summary.layers),
                  static_cast<unsigned long long>(summary.levels),
                  static_cast<unsigned long long>(summary.collisions), ms,
                  errors_against(exact, stepped.profile(), kTime).l1,
                  errors_against(exact, joined.profile(), kTime).l1, M);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace shearfront

int main(int argc, char** argv) {
  using namespace shearfront;
  const double finest = argc > 1 ? std::atof(argv[1]) : 1e-3;
  if (argc > 2) {
    smooth_table(finest);
    return 0;
  }
  const Scene<double> scene = support::example_2();
  const ExactSolution<double> exact(scene);
  const double t_star = *exact_timeline(exact).t_star;
  std::printf(
      "| resolution | levels | events | ms | ns per event | t = 0.1 | t = 0.6 | t = 1 | t* |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (double resolution = 0.08; resolution >= finest * 0.999; resolution /= 2)
    row(scene, exact, t_star, resolution);
}
