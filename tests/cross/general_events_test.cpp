// SPDX-License-Identifier: BSD-3-Clause
// Event times at interfaces for fluxes other than parabolas: against those of parabolas, and of front
// tracking.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/layered_medium.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/solver.hpp"
#include "support/checked.hpp"
#include "support/flux_scenes.hpp"

namespace shearfront {
namespace {

using support::FluxShape;
using support::SceneMaker;

TEST(GeneralEvents, FirstWavesOfParabolasAreThoseOfTheClosedForms) {
  support::Checked checked({""}, 200);
  SceneMaker make(support::seed_of(5401));
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene(make.data(make.integer(2, 5), make.order(), 5));
    const Timeline<double> times = exact_timeline(scene);
    const exact::CanonicalForm<double> form(std::make_shared<const Scene<double>>(scene), 1);
    const exact::LayeredMedium<double, exact::UnimodalLaw<double>> medium(
        exact::unimodal_law(form), {form.initial_breaks(), form.initial_values(), form.boundaries()},
        form.mass());
    for (std::size_t i = 0; i < times.interfaces.size(); ++i) {
      const auto first = medium.first_wave(i + 1);
      ASSERT_EQ(first.has_value(), times.interfaces[i].first.has_value()) << "interface " << i;
      if (!first) continue;
      checked.count();
      EXPECT_NEAR(*first, *times.interfaces[i].first, 1e-9 * (1 + *first)) << "interface " << i;
    }
  }
}

class GeneralEvents : public testing::TestWithParam<FluxShape> {};

// A fan of front tracking starts with a secant: first waves come late, by up to the resolution.
TEST_P(GeneralEvents, AreThoseOfFrontTracking) {
  support::Checked checked({"t0", "t1", "t*", "first", "last"}, 10);
  SceneMaker make(support::seed_of(5402));
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    const Scene<double> scene(support::random_flux_scene(make, GetParam()));
    SolverRequest request;
    request.timeline = true;
    const SolverResult tracked = solve<FrontTrackingSolver>(scene, request, {.resolution = 0.002});
    ASSERT_TRUE(tracked.summary.usable()) << tracked.summary.message;
    const Timeline<double> exact = exact_timeline(scene);
    ASSERT_EQ(exact.interfaces.size(), tracked.timeline->interfaces.size());
    const auto same = [&](const std::optional<double>& a, const std::optional<double>& b, const char* what) {
      ASSERT_EQ(a.has_value(), b.has_value()) << what;
      if (!a) return;
      checked.count(what);
      EXPECT_NEAR(*a, *b, 0.02 * (1 + *a)) << what;
    };
    same(exact.t0, tracked.timeline->t0, "t0");
    same(exact.t1, tracked.timeline->t1, "t1");
    same(exact.t_star, tracked.timeline->t_star, "t*");
    for (std::size_t i = 0; i < exact.interfaces.size(); ++i) {
      const auto &a = exact.interfaces[i], &b = tracked.timeline->interfaces[i];
      EXPECT_NEAR(a.z, b.z, 1e-14);
      same(a.first, b.first, "first");
      same(a.last, b.last, "last");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, GeneralEvents,
                         testing::Values(FluxShape::convex_parabolas, FluxShape::concave_parabolas,
                                         FluxShape::convex, FluxShape::concave));

}  // namespace
}  // namespace shearfront
