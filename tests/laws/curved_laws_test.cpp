// SPDX-License-Identifier: BSD-3-Clause
// What must hold for curved fronts in any bed: mass, order, range, restart, scaling, symmetry, an end. The soak checks the same on as
// many beds as wanted.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "shearfront/track/track.hpp"
#include "soak/curved.hpp"
#include "support/curved_scenes.hpp"

namespace shearfront {
namespace {

void check_many(soak::CurvedKind kind, std::uint64_t from, std::uint64_t n, double resolution) {
  soak::CurvedWorst worst;
  soak::Findings total;
  for (std::uint64_t i = 0; i < n && !testing::Test::HasFailure(); ++i) {
    soak::CurvedTrial trial = soak::draw_curved(kind, support::seed_of(from + i));
    if (resolution > 0) trial.resolution = resolution;
    const soak::Findings findings = soak::check_curved(trial, &worst);
    for (const auto& [law, places] : findings.violations())
      ADD_FAILURE() << law << ": " << places.front() << "\n" << soak::text_of(trial);
    total.add(findings);
  }
  EXPECT_EQ(total.n_scenes, n);
  EXPECT_GT(total.n_checked, 30 * n);
  EXPECT_GT(total.n_collisions, n);
  std::printf("%llu scenes, %llu events: mass to %.1e, order to %.1e, mirror image to %.1e\n",
              static_cast<unsigned long long>(n), static_cast<unsigned long long>(total.n_collisions),
              worst.mass, worst.order, worst.mirror);
}

constexpr double kAnyResolution = 0;

TEST(CurvedLaws, HoldAtAnyResolution) { check_many(soak::CurvedKind::parabola, 1, 200, kAnyResolution); }
TEST(CurvedLaws, HoldOnFineLevels) { check_many(soak::CurvedKind::parabola, 100'001, 10, 0.006); }
TEST(CurvedLaws, HoldOnCoarseLevels) { check_many(soak::CurvedKind::parabola, 200'001, 300, 0.5); }
TEST(CurvedLaws, HoldForOtherFluxes) { check_many(soak::CurvedKind::any_flux, 400'001, 100, kAnyResolution); }
TEST(SlowCurvedLaws, HoldAtAnyResolution) {
  check_many(soak::CurvedKind::parabola, 300'001, 3'000, kAnyResolution);
}
TEST(SlowCurvedLaws, HoldForOtherFluxes) {
  check_many(soak::CurvedKind::any_flux, 500'001, 1'000, kAnyResolution);
}

// A front came to where another turned at the same time: rounding decided whether they met, and which way up the bed was.
TEST(CurvedLaws, HoldWhereFrontsMeetAtATurn) {
  for (const std::uint64_t seed :
       {2494U, 4894U, 5156U, 5568U, 6278U, 7858U, 8188U, 10738U, 10855U, 11216U, 12488U, 12798U})
    check_many(soak::CurvedKind::parabola, seed, 1, kAnyResolution);
}

// Pieces of slopes of 1e-11, levels a few roundings apart, a front that hardly moves before it meets another: each once lost mass.
TEST(CurvedLaws, HoldInHostileBeds) {
  for (const std::uint64_t seed : {2U, 235U, 552U, 1152U, 1242U, 1245U, 2406U, 2868U, 2882U})
    check_many(soak::CurvedKind::hostile, seed, 1, kAnyResolution);
}

// Levels 1e-5 to 1e-14 of their flux apart whose fronts set out next to the heights where they turn: differences of both areas lose all
// that is between them.
TEST(CurvedLaws, HoldNextToTheTopOfTheFlux) {
  soak::Findings total;
  for (std::uint64_t i = 0; i < 300 && !testing::Test::HasFailure(); ++i) {
    soak::CurvedTrial trial = soak::draw_curved(
        i % 2 == 0 ? soak::CurvedKind::any_flux : soak::CurvedKind::parabola, support::seed_of(600'001 + i));
    support::SceneMaker maker(support::seed_of(700'001 + i));
    const double top = Scene<double>(trial.spec).fluxes().front().extrema().front();
    for (double& value : trial.spec.initial_values)
      if (value > 0 && value < 1)
        value = top * (1 + (maker.integer(0, 1) == 0 ? -1 : 1) * std::pow(10.0, maker.uniform(-7, -2.5)));
    trial.resolution = maker.uniform(0.01, 0.05);
    const soak::Findings findings = soak::check_curved(trial);
    for (const auto& [law, places] : findings.violations())
      ADD_FAILURE() << law << ": " << places.front() << "\n" << soak::text_of(trial);
    total.add(findings);
  }
  EXPECT_GT(total.n_checked, 9000U);
  const soak::Findings once = soak::check_curved(soak::draw_curved(930021502U));
  for (const auto& [law, places] : once.violations()) ADD_FAILURE() << law << ": " << places.front();
}

TEST(CurvedLaws, EqualInputGivesEqualOutput) {
  const Scene<double> scene(support::random_curved_spec(support::seed_of(5)));
  Tracking a(scene, {.resolution = 0.01, .history = true}), b(scene, {.resolution = 0.01, .history = true});
  a.advance(0.7);
  b.advance(0.7);
  EXPECT_EQ(a.profile().z(), b.profile().z());
  EXPECT_EQ(a.fronts().size(), b.fronts().size());
  EXPECT_EQ(a.collisions().size(), a.summary().collisions);
}

}  // namespace
}  // namespace shearfront
