// SPDX-License-Identifier: BSD-3-Clause
// Exact solutions of smooth starts next to the peak of the flux, to a throat and to a flat or thin piece.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/track.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

using support::bed_with;
using support::table_start;

// Starts of which the place does not say where their paths come: found by an attack with Godunov's scheme and starts in cells.

SceneSpec<double> attacked(Flux<double> flux, Table<double> rate, InitialState<double> start) {
  SceneSpec<double> spec = bed_with(std::move(rate), std::move(start));
  spec.fluxes = {std::move(flux)};
  return spec;
}
const FluxTable<double> kBentTable{{0, 0.25, 0.5, 0.75, 1}, {0, -0.1875, -0.25, -0.1875, 0}};

/// Towards a throat H may rise and fall again in one part of a start. It was missed at every number of parts that was tried, with an
/// error of 0: M = 0.368314 and t* = 0.842351; Godunov's on 16,000 cells is 0.36809.
TEST(SmoothStart, AThroatIsReachedFromBothSidesOfACrest) {
  const double peak = 0.45686728696493449;
  const Scene<double> scene(
      attacked(Cubic<double>{0.3}, {{0, 0.5, 1}, {6, 1, 6}},
               table_start({0, 0.47, 0.5, 1}, {peak + 0.25, peak + 0.25, peak + 0.1, peak + 0.1})));
  const ExactSolution<double> solution(scene), fine(scene, {256});
  EXPECT_NEAR(solution.M(0.5, 0.08), fine.M(0.5, 0.08), 1e-13);
  EXPECT_NEAR(solution.M(0.5, 0.08), 0.36809, 1e-5);
  EXPECT_NEAR(*exact_timeline(solution).t_star, *exact_timeline(fine).t_star, 1e-12);
}

/// A state at the peak stays, M = M(z, 0) + a |f| t, in a flat bed and for a while in one with a slope; M was 0 or the mass.
TEST(SmoothStart, PlateausAtThePeakStay) {
  int n = 0;
  for (const double slope : {0.0, 1e-16, -1e-16, 1e-13, 1e-9, 1e-3}) {
    const double t = slope == 1e-3 ? 1e-6 : slope == 1e-9 ? 1e-2 : 0.1;
    for (const bool has_breaks : {false, true}) {
      SceneSpec<double> spec =
          attacked(kBentTable, {{0, 1}, {0.3, 0.3 * (1 + slope)}}, table_start({0, 0.4, 1}, {0.2, 0.5, 0.5}));
      if (has_breaks) {
        spec.initial_state.reset();
        spec.initial_breaks = {0.4};
        spec.initial_values = {0.35, 0.5};
      }
      const ExactSolution<double> solution{Scene<double>(spec)};
      for (const double z : {0.55, 0.7, 0.85}) {
        EXPECT_NEAR(solution.M(z, t), 0.14 + 0.5 * (z - 0.4) + 0.3 * (1 + slope * z) * 0.25 * t, 1e-12)
            << slope << ' ' << z;
        EXPECT_NEAR(solution.phi(z, t), 0.5, 1e-8) << slope << ' ' << z;
        ++n;
      }
    }
  }
  EXPECT_EQ(n, 36);
}

/// The crest of a wave that touches the peak in a flat bed, and a plateau that differs from it by less than H can tell.
TEST(SmoothStart, CrestsAtThePeakStay) {
  const SineInitial<double> wave{0.4, 0.1, 0.5, 0};
  const Scene<double> scene(attacked(kBentTable, {{0, 1}, {1, 1}}, wave));
  const ExactSolution<double> solution(scene);
  const double at_crest = wave.integral(0, 0.125) + 0.25 * 0.1;
  for (const double away : {0.0, 1e-15, -1e-12, -1e-9, 1e-9, -1e-7})
    EXPECT_NEAR(solution.M(0.125 + away, 0.1), at_crest + 0.5 * away, 1e-13) << away;
  for (const double off : {0.0, 1e-14, -1e-12, 1e-10, -1e-9}) {
    const Scene<double> plateau(attacked(Cubic<double>{1e-9}, {{0, 0.3, 1}, {0.5, 1, 1}},
                                         table_start({0, 0.3, 0.4, 1}, {0.2, 0.2, 0.5 + off, 0.5 + off})));
    const ExactSolution<double> exact(plateau);
    for (const double z : {0.8, 0.84375, 0.85, 0.85 - 1e-7})
      EXPECT_NEAR(exact.M(z, 0.05), 0.095 + 0.5 * (z - 0.4) + 0.25 * 0.05, 2e-9) << off << ' ' << z;
  }
}

/// Nearly flat, the wedge of a triangular flux is that of a flat bed; and of a start that is nearly a jump.
TEST(SmoothStart, AKinkSpreadsAsInAFlatBed) {
  int n = 0;
  for (const double slope : {1e-15, 1e-12, -1e-10, 1e-8})
    for (const double z : {0.493, 0.495, 0.5, 0.505, 0.508}) {
      const Scene<double> scene(
          attacked(Triangular<double>{}, {{0, 1}, {1, 1 + slope}}, table_start({0, 1}, {0.9, 0.1})));
      EXPECT_NEAR(ExactSolution<double>(scene).M(z, 0.01), 0.345 + (z - 0.5) / 2, 1e-8) << slope << ' ' << z;
      ++n;
    }
  for (const double ramp : {1e-6, 1e-9, 1e-11, 1e-13})
    for (const double z : {0.42, 0.45, 0.5, 0.55}) {
      const Scene<double> scene(attacked(Triangular<double>{}, {{0, 0.2, 0.8, 1}, {2, 1, 1, 2}},
                                         table_start({0, 0.5, 0.5 + ramp, 1}, {0.9, 0.9, 0.1, 0.1})));
      EXPECT_NEAR(ExactSolution<double>(scene).M(z, 0.1), 0.4 + (z - 0.5) / 2, ramp) << ramp << ' ' << z;
      ++n;
    }
  EXPECT_EQ(n, 36);
}

/// At the slow end of a ramp of a(z) that is nearly a jump M grows with the capacity there; it had no path.
TEST(SmoothStart, ThinSteepPiecesLetAsMuchThroughAsTheyCan) {
  for (const double ramp : {1e-9, 1e-10, 1e-12})
    for (const double t : {1e-4, 1e-3}) {
      const double knot = 0.5 + ramp;
      const ExactSolution<double> solution(Scene<double>(
          bed_with(Table<double>{{0, 0.5, knot, 1}, {2, 2, 1, 0.2}}, table_start({0, 1}, {0.49, 0.512}))));
      EXPECT_NEAR(solution.M(knot, t), 0.49 * knot + 0.011 * knot * knot + 0.25 * t, 1e-9)
          << ramp << ' ' << t;
    }
}

/// A kink of width w differs from its jump by no more than the amount between them, 0.55 w. A height is known to half of 2^-53, a state
/// there to 0.4 / w times that, and M to second order: by half of dH/dp dT/dp, less than 100 short of the peak. It was of first order.
TEST(SmoothStart, SteepKinksAreNearlyJumps) {
  const Table<double> rate{{0, 0.3, 0.6, 1}, {1, 2, 0.7, 1.2}};
  SceneSpec<double> jump = bed_with(rate, table_start({0, 1}, {0, 1}));
  jump.initial_state.reset();
  jump.initial_breaks = {0.41};
  jump.initial_values = {0.1, 0.9};
  const ExactSolution<double> of_jump{Scene<double>(jump)};
  for (const double width : {1e-3, 1e-6, 1e-9, 1e-11, 1e-12}) {
    const ExactSolution<double> kink(
        Scene<double>(bed_with(rate, KinkInitial<double>{0.1, 0.9, 0.41, width})));
    const double state = 0.4 / width * 0x1p-54, bound = 0.6 * width + 2e-15 + 100 * state * state;
    for (const double t : {0.01, 0.05, 0.2, 0.5})
      for (int i = 1; i < 25; ++i)
        EXPECT_NEAR(kink.M(0.04 * i, t), of_jump.M(0.04 * i, t), bound) << width << ' ' << i;
  }
}

/// A piece whose slope is one of rounding ends in a steep one: what leaves the knot between them is what its capacity lets through. From
/// starts in the flat piece it would have to come within 1e-10 of the knot, and M was 0.0063 off.
TEST(SmoothStart, NearlyFlatPiecesEndAsFlatOnesDo) {
  for (const double slope : {0.0, 1e-15, 1e-12, 1e-9}) {
    const Table<double> rate{{0, 0.2, 0.5, 0.51, 1}, {0.8, 0.8, 0.8 * (1 + slope), 3.4, 1.4}};
    const auto start = table_start({0, 0.35, 0.6, 1}, {0.9, 1, 0.125, 0.8});
    const ExactSolution<double> solution(Scene<double>(bed_with(rate, start)));
    const support::CellStart cells = support::as_cells(bed_with(rate, start), 400);
    const ExactSolution<double> steps{Scene<double>(cells.spec)};
    for (const double t : {0.05, 0.12, 0.3})
      for (const double z : {0.49, 0.4999999, 0.5, 0.5000001, 0.502, 0.509, 0.51, 0.52, 0.6})
        EXPECT_NEAR(solution.M(z, t), steps.M(z, t), cells.M_bound + 1e-8) << slope << ' ' << t << ' ' << z;
  }
}

}  // namespace
}  // namespace shearfront
