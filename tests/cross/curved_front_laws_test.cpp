// SPDX-License-Identifier: BSD-3-Clause
// Curved fronts of other fluxes and in any smooth bed, against the exact solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/track.hpp"
#include "support/curved_scenes.hpp"

namespace shearfront {
namespace {

// Any parabola, with or without layers of temperature, whichever grains it counts.
TEST(CurvedFronts, OtherParabolas) {
  SceneSpec<double> spec = support::random_curved_spec(support::seed_of(3));
  spec.initial_breaks = {0.3, 0.6};
  spec.initial_values = {0.2, 0.9, 0.4};
  spec.temperature = Piecewise<double>{{0.45}, {1.3, 0.8}};
  int n = 0;
  for (const Flux<double>& flux :
       {Flux<double>(Quadratic<double>{}), Flux<double>(Lwr<double>{1}), Flux<double>(Lwr<double>{0.4})}) {
    spec.fluxes = {flux};
    if (flux.range().highest < 1) spec.initial_values = {0.05, 0.35, 0.1};
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    ASSERT_TRUE(exact.is_exact()) << flux.name();
    Tracking tracking(scene, {.resolution = 0.002});
    EXPECT_LE(tracking.summary().layers, 10u) << flux.name();  // no staircase
    tracking.advance(0.2);
    const auto field = tracking.field(scene);
    for (int i = 0; i <= 20; ++i)
      EXPECT_NEAR(field->at(i / 20.0).M, exact.M(i / 20.0, 0.2), 1e-4) << flux.name();
    EXPECT_NEAR(field->at(1).M, scene.mass(), 1e-13);
    ++n;
  }
  EXPECT_EQ(n, 3);
}

/// Error of M of steps and lines at t = 0.3 and of the first arrivals, in a bed of one flux with 0 above and below a jump.
struct OtherFluxErrors {
  double steps, lines, arrivals;
};
OtherFluxErrors other_flux_errors(const Scene<double>& scene, const ExactSolution<double>& exact,
                                  double resolution) {
  OtherFluxErrors errors{0, 0, 0};
  for (const Reconstruction kind : {Reconstruction::constant, Reconstruction::linear}) {
    Tracking tracking(scene, {.resolution = resolution, .reconstruct = kind});
    EXPECT_LE(tracking.summary().layers, 10u);  // no staircase
    tracking.advance(0.3);
    const auto field = tracking.field(scene);
    double& largest = kind == Reconstruction::constant ? errors.steps : errors.lines;
    for (int i = 1; i < 40; ++i)
      largest = std::max(largest, std::abs(field->at(i / 40.0).M - exact.M(i / 40.0, 0.3)));
    EXPECT_NEAR(field->at(1).M, scene.mass(), 1e-13);
    const Timeline<double> tracked = *tracking.timeline(), timeline = exact_timeline(exact);
    errors.arrivals = std::max({errors.arrivals, std::abs(*tracked.t0 / *timeline.t0 - 1),
                                std::abs(*tracked.t1 / *timeline.t1 - 1)});
  }
  return errors;
}

// Convex and concave fluxes that are no parabolas, with and without layers of the solid fraction.
TEST(CurvedFronts, OtherFluxes) {
  int n = 0;
  double coarse = 0, fine = 0;
  for (const Flux<double>& flux : {Flux<double>(Cubic<double>{0.25}), Flux<double>(Cubic<double>{0.5}),
                                   Flux<double>(LwrCubic<double>{0.8, 0.4})})
    for (const DepthFunction<double>& rate :
         {DepthFunction<double>(Exponential<double>{2, 0.4}),
          DepthFunction<double>(Table<double>{{0, 0.4, 0.7, 1}, {1, 2, 0.6, 1.4}})})
      for (const bool has_layers_of_c : {false, true}) {
        SceneSpec<double> spec;
        spec.fluxes = {flux};
        spec.shear_rate = rate;
        spec.initial_breaks = {0.5};
        const double most = flux.range().highest;
        spec.initial_values = {0, most};
        if (flux.value(flux.extrema().front()) > 0) spec.initial_values = {most, 0};
        if (has_layers_of_c) spec.solid_fraction = Piecewise<double>{{0.35}, {0.62, 0.5}};
        const Scene<double> scene(spec);
        const ExactSolution<double> exact(scene);
        ASSERT_TRUE(exact.is_exact());
        const OtherFluxErrors a = other_flux_errors(scene, exact, 0.02),
                              b = other_flux_errors(scene, exact, 0.0025);
        EXPECT_LE(b.arrivals, 1e-12) << flux.name();
        EXPECT_LE(b.steps, 2e-5) << flux.name();
        EXPECT_LE(b.lines, 2e-5) << flux.name();
        coarse += std::log2(a.steps);
        fine += std::log2(b.steps);
        ++n;
      }
  EXPECT_EQ(n, 12);
  EXPECT_GE((coarse - fine) / n / 3, 1.7);
}

struct SmoothBedErrors {
  double steps = 0, lines = 0, M = 0, mass = 0, arrival = 0;
};
SmoothBedErrors smooth_bed_errors(const Scene<double>& scene, const ExactSolution<double>& exact,
                                  double resolution, double t) {
  Tracking steps(scene, {.resolution = resolution}),
      lines(scene, {.resolution = resolution, .reconstruct = Reconstruction::linear});
  steps.advance(t);
  lines.advance(t);
  SmoothBedErrors errors;
  const auto field = steps.field(scene);
  for (int i = 1; i < 40; ++i)
    errors.M = std::max(errors.M, std::abs(field->at(i / 40.0).M - exact.M(i / 40.0, t)));
  const Profile<double> of_steps = steps.profile(), of_lines = lines.profile();
  errors.steps = errors_against(exact, of_steps, t).l1;
  errors.lines = errors_against(exact, of_lines, t).l1;
  errors.mass = std::max(std::abs(of_steps.mass() - scene.mass()), std::abs(of_lines.mass() - scene.mass()));
  errors.arrival = std::abs(*steps.timeline()->t1 / *exact_timeline(exact).t1 - 1);
  return errors;
}

/// Beds that pieces stand for: T, c and a vary as tables and exponentials and in ways of their own; and two fluxes in a bed of one piece.
std::vector<std::pair<std::string, SceneSpec<double>>> smooth_beds() {
  SceneSpec<double> base;
  base.shear_rate = Exponential<double>{2, 0.4};
  base.initial_breaks = {0.5};
  base.initial_values = {0, 1};
  SceneSpec<double> T = base, c = base, both = base, own = base, fluxes = base;
  T.temperature = Table<double>{{0, 1}, {1, 1.5}};
  c.solid_fraction = Table<double>{{0, 0.5, 1}, {0.62, 0.55, 0.4}};
  both.temperature = T.temperature;
  both.solid_fraction = Exponential<double>{0.6, 3};
  Kinetic<double> kinetic;
  kinetic.amplitude = 2, kinetic.length = 0.3, kinetic.load = 0.5, kinetic.lid = 1.2;
  own.shear_rate = kinetic;
  fluxes.fluxes = {Cubic<double>{0.3}, Quadratic<double>{}};
  fluxes.flux_breaks = {0.55};
  return {{"T", T}, {"c", c}, {"c and T", both}, {"kinetic", own}, {"two fluxes", fluxes}};
}

// No stairs where a, c or T vary in any way: what stands for the bed costs no more than the levels do. Lines are of order 3/2, for they
// know less of the cell in which characteristics turn just now.
TEST(CurvedFronts, AnySmoothBed) {
  constexpr double kCoarse = 0.02, kFine = 0.0025, kTime = 0.4;
  for (const auto& [name, spec] : smooth_beds()) {
    SCOPED_TRACE(name);
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    const SmoothBedErrors coarse = smooth_bed_errors(scene, exact, kCoarse, kTime),
                          fine = smooth_bed_errors(scene, exact, kFine, kTime);
    std::printf("%s: steps %.2g -> %.2g, lines %.2g -> %.2g, M %.2g -> %.2g\n", name.c_str(), coarse.steps,
                fine.steps, coarse.lines, fine.lines, coarse.M, fine.M);
    for (const SmoothBedErrors& errors : {coarse, fine}) EXPECT_LE(errors.mass, 1e-13);
    EXPECT_LE(coarse.arrival, kCoarse * kCoarse / 4);
    EXPECT_LE(fine.arrival, kFine * kFine);  // the exact one has pieces as well
    EXPECT_LE(fine.steps, coarse.steps / 4);
    EXPECT_LE(coarse.lines, 0.1 * coarse.steps);  // steps are of first order
    EXPECT_LE(fine.lines, 0.02 * fine.steps);
    EXPECT_LE(coarse.M, kCoarse * kCoarse / 2);
    EXPECT_LE(fine.M, kFine * kFine);
  }
}

// A flux with straight branches has contacts instead of fans: layers carry them.
TEST(CurvedFronts, StraightBranchesAreTrackedInLayers) {
  SceneSpec<double> spec;
  spec.fluxes = {Triangular<double>{0.25, 1}};
  spec.shear_rate = Exponential<double>{2, 0.4};
  spec.initial_breaks = {0.5};
  spec.initial_values = {1, 0};
  const Scene<double> scene(spec);
  Tracking tracking(scene, {.resolution = 0.02});
  EXPECT_GT(tracking.summary().layers, 50u);
  tracking.advance(0.6);
  EXPECT_NEAR(tracking.profile().mass(), scene.mass(), 1e-13);
}
}  // namespace
}  // namespace shearfront
