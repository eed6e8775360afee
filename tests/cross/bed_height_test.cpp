// SPDX-License-Identifier: BSD-3-Clause
// Height of the bed and entropy of mixing: the exact integrals against those of every other solver, closed
// forms, and a(z) found from heights alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/lowest_bed.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/any_flux.hpp"
#include "support/fit_scenes.hpp"
#include "support/solid_scene.hpp"
#include "support/table_bed.hpp"

namespace shearfront {
namespace {

using support::Grains, support::SceneMaker;

constexpr double kSteady = std::numeric_limits<double>::infinity();

SceneSpec<double> may() { return support::small_above_large({0.29}, {2.4, 0.31}); }

template <class AnySolver>
std::vector<double> heights(const Scene<double>& scene, const std::vector<double>& times,
                            const typename AnySolver::Options& options = {}) {
  const BedHeight bed(scene);
  SolverRequest request;
  request.times = times;
  request.integrand = bed.integrand();
  std::vector<double> all = solve<AnySolver>(scene, request, options).integrals;
  for (double& x : all) x = bed.height(x);
  return all;
}

template <class AnySolver>
std::vector<double> integrals(const Scene<double>& scene, const std::vector<double>& times, ShareFunction g,
                              const typename AnySolver::Options& options = {}) {
  SolverRequest request;
  request.times = times;
  request.integrand = std::move(g);
  return solve<AnySolver>(scene, request, options).integrals;
}

// Until a wave meets the interface or a wall, the fan from z0 has the width 2 s a t and phi runs linearly in
// it from 0 to 1: H = 1 - 2 a t (1 - int_0^1 c_rcp(0) / c_rcp(x) dx).
TEST(BedHeight, SinksInStepWithTheFan) {
  const SceneSpec<double> spec = support::small_above_large({}, {0.8});
  const PackingPolynomial<double> law;
  double mean = 0;  // by Simpson's rule
  const int n = 2000;
  for (int i = 0; i <= n; ++i)
    mean += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * law.value(0) / law.value(i / double(n)) / (3.0 * n);
  const std::vector<double> times{0, 0.125, 0.25, 0.5};
  const auto found = heights<ExactSolver>(Scene<double>(spec), times);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(found[i], 1 - 2 * 0.8 * times[i] * (1 - mean), 1e-12);
}

// The same for the entropy: int_0^1 e(x) dx = 1/2.
TEST(BedHeight, EntropyGrowsInStepWithTheFan) {
  const Scene<double> scene(support::small_above_large({}, {0.8}));
  const auto found = integrals<ExactSolver>(scene, {0.125, 0.5}, entropy_function());
  EXPECT_NEAR(found[0], 2 * 0.8 * 0.125 / 2, 1e-10);
  EXPECT_NEAR(found[1], 2 * 0.8 * 0.5 / 2, 1e-10);
}

TEST(BedHeight, MayBedSinksThenRises) {
  const Scene<double> scene(may());
  std::vector<double> times;
  for (int i = 0; i <= 260; ++i) times.push_back(i / 40.0);
  const auto found = heights<ExactSolver>(scene, times);
  const auto lowest = std::min_element(found.begin(), found.end());
  EXPECT_TRUE(std::is_sorted(found.begin(), lowest + 1, std::greater<>()));
  EXPECT_TRUE(std::is_sorted(lowest, found.end()));
  EXPECT_EQ(found.front(), 1);
  EXPECT_NEAR(heights<ExactSolver>(scene, {kSteady})[0], 1, 1e-15);
  const auto by = [&](const auto& solve) { return lowest_bed(solve, 6.5); };
  const auto exact = by([&](const auto& t) { return heights<ExactSolver>(scene, t); });
  const FrontTrackingSolver::Options options{.resolution = 0.001};
  const auto tracked = by([&](const auto& t) { return heights<FrontTrackingSolver>(scene, t, options); });
  ASSERT_TRUE(exact && tracked);
  EXPECT_NEAR(exact->t, times[std::size_t(lowest - found.begin())], 0.025);
  EXPECT_NEAR(exact->height, tracked->height, 1e-7);
  EXPECT_NEAR(exact->t, tracked->t, 5e-3);  // H is flat there: 1e-7 in H is 3e-3 in t
}

// A parabola whose least value lies on, beside and between the times that are tried; and at the ends.
TEST(BedHeight, LowestBedIsFoundWhereverItIs) {
  for (const double t0 : {0.0, 1.0, 1.0 + 1e-5, 1.4142, 2.9999, 4.0}) {
    const auto lowest = lowest_bed(
        [&](const std::vector<double>& t) {
          std::vector<double> h;
          for (const double x : t) h.push_back(0.75 + (x - t0) * (x - t0));
          return h;
        },
        4);
    ASSERT_TRUE(lowest);
    EXPECT_NEAR(lowest->t, t0, 1e-7);
    EXPECT_NEAR(lowest->height, 0.75, 1e-14);
  }
}

TEST(BedHeight, LowestBedOfABedThatStaysIsItsStart) {
  const auto flat = [](const std::vector<double>& t) { return std::vector<double>(t.size(), 1.0); };
  const auto lowest = lowest_bed(flat, 3);
  ASSERT_TRUE(lowest);
  EXPECT_EQ(lowest->t, 0);
  EXPECT_EQ(lowest->height, 1);
  EXPECT_FALSE(lowest_bed([](const auto&) { return std::vector<double>(); }, 3));
}

// Random layers, packings, temperatures, both kinds of grains, every law: exact, tracked and on a grid.
TEST(BedHeight, AllSolversAgreeOnRandomBeds) {
  for (int number = 0; number < 30; ++number) {
    SCOPED_TRACE("bed " + std::to_string(number));
    SceneMaker maker(support::seed_of(9100 + std::uint64_t(number)));
    SceneSpec<double> spec;
    if (number % 2 == 0) {
      spec = maker.data(maker.integer(1, 5), maker.order(), 6);
    } else {
      spec = support::solid_data(maker, number % 4 == 1 ? Grains::small : Grains::large);
      for (auto* profile : {&*spec.solid_fraction, &*spec.temperature})
        *profile = maker.layers(2, SceneMaker::Order::random);
    }
    if (number % 3 == 1) spec.close_packing = PackingUpperBound<double>{0.6};
    if (number % 3 == 2) spec.close_packing = PackingTable<double>::samples()[1];
    const Scene<double> scene(spec);
    const std::vector<double> times{0, 0.02, 0.3, 1.1, 4, kSteady};
    const auto exact = heights<ExactSolver>(scene, times);
    const FrontTrackingSolver::Options options{.resolution = 0.005};
    const auto tracked = heights<FrontTrackingSolver>(scene, times, options);
    const auto on_grid = heights<GodunovSolver>(scene, {0.3, 1.1}, {{.cells = 1600}});
    ASSERT_EQ(exact.size(), times.size());
    ASSERT_EQ(tracked.size(), times.size());
    ASSERT_EQ(on_grid.size(), 2u);
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(exact[i], tracked[i], 2e-5) << times[i];
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(exact[i + 2], on_grid[i], 4e-3) << times[i + 2];
    EXPECT_NEAR(exact.back(), scene.top() - scene.bottom(), 1e-13);
    const auto entropy = integrals<ExactSolver>(scene, times, entropy_function());
    const auto tracked_entropy = integrals<FrontTrackingSolver>(scene, times, entropy_function(), options);
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(entropy[i], tracked_entropy[i], 2e-4) << times[i];
  }
}

// The integral of phi itself is the amount of grains, that of 1 the solid, whatever the flux.
TEST(BedHeight, IntegralsOfTheShareAndOfOneAreConserved) {
  for (const Flux<double>& flux : {Flux<double>(Cubic<double>{0.4}), Flux<double>(Lwr<double>{}),
                                   Flux<double>(Lwr<double>{}), Flux<double>(Quadratic<double>{})}) {
    SCOPED_TRACE(support::name_of(flux));
    SceneMaker maker(support::seed_of(9200));
    SceneSpec<double> spec = support::draw(maker, flux, 3, 4);
    spec.solid_fraction = maker.layers(2, SceneMaker::Order::random);
    const Scene<double> scene(spec);
    ASSERT_EQ(exact::refusal(scene), "");
    for (const double share :
         integrals<ExactSolver>(scene, {0, 0.1, 0.7, 3, kSteady}, {[](double x) { return x; }, {}}))
      EXPECT_NEAR(share, scene.mass(), 1e-11);
    for (const double solid :
         integrals<ExactSolver>(scene, {0, 0.1, 0.7, 3, kSteady}, {[](double) { return 1.0; }, {}}))
      EXPECT_NEAR(solid, scene.solid(scene.bottom(), scene.top()), 1e-12);
  }
}

TEST(BedHeight, OpenBedsAndStatesThatAreNoSharesAreRefused) {
  SceneSpec<double> spec = may();
  EXPECT_EQ(BedHeight::refusal(Scene<double>(spec)), "");
  spec.outside_top = OutsideState<double>{{}, {0.5}};
  EXPECT_NE(BedHeight::refusal(Scene<double>(spec)), "");
  spec.outside_top.reset();
  spec.is_periodic = true;
  spec.fluxes = {Burgers<double>{}};
  EXPECT_NE(BedHeight::refusal(Scene<double>(spec)), "");
}

ObservationPlan every_tenth() {
  ObservationPlan plan;
  plan.quantity = Quantity::bed_height;
  for (int i = 1; i <= 80; ++i) plan.times.push_back(i / 10.0);
  return plan;
}

TEST(BedHeightFit, FindsBothRatesAndTheirInterface) {
  const auto data = support::observed(may(), every_tenth(), 0, 1, false);
  const auto spec = support::fit_of(may(), data, {"shear_rate.values", "shear_rate.breaks"}, {1.5, 0.6, 0.4});
  const fit::Estimate estimate = fit::fit(spec);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  EXPECT_NEAR(estimate.parameters[0].estimate, 2.4, 1e-9);
  EXPECT_NEAR(estimate.parameters[1].estimate, 0.31, 1e-11);
  EXPECT_NEAR(estimate.parameters[2].estimate, 0.29, 1e-10);
}

// Heights of another solver, and the law of solid fraction unknown as well.
TEST(BedHeightFit, FindsTheSameThroughFrontTracking) {
  const auto data = support::observed(may(), every_tenth(), 0, 1, false);
  auto spec = support::fit_of(may(), data, {"shear_rate.values", "shear_rate.breaks"}, {2.2, 0.35, 0.3});
  spec.forward.method = Method::of<FrontTrackingSolver>();
  const fit::Estimate estimate = fit::fit(spec);
  EXPECT_NEAR(estimate.parameters[0].estimate, 2.4, 0.02);
  EXPECT_NEAR(estimate.parameters[1].estimate, 0.31, 2e-4);
  EXPECT_NEAR(estimate.parameters[2].estimate, 0.29, 1e-3);
}

TEST(BedHeightFit, FindsThePackingOfOneKindOfGrains) {
  SceneSpec<double> truth = may();
  truth.close_packing = PackingPolynomial<double>{0.6};
  const auto data = support::observed(truth, every_tenth(), 0, 1, false);
  const fit::Estimate estimate =
      fit::fit(support::fit_of(truth, data, {"shear_rate.values", "close_packing.pure"}, {1.8, 0.5, 0.64}));
  EXPECT_NEAR(estimate.parameters[0].estimate, 2.4, 1e-8);
  EXPECT_NEAR(estimate.parameters[1].estimate, 0.31, 1e-10);
  EXPECT_NEAR(estimate.parameters[2].estimate, 0.6, 1e-9);
}

TEST(BedHeightFit, OtherDataDoNotSayHowHighTheBedIs) {
  ObservationPlan plan{{0.5, 1}, {0.25, 0.75}, Quantity::point, 0};
  auto spec = support::fit_of(may(), support::observed(may(), plan, 0, 1, false), {"shear_rate.values"});
  spec.misfit.quantity = "bed-height";
  EXPECT_THROW((void)fit::fit(spec), InputError);
  spec = support::fit_of(may(), support::observed(may(), every_tenth(), 0, 1, false), {"shear_rate.values"});
  for (const char* quantity : {"point", "bin", "cumulative"}) {
    spec.misfit.quantity = quantity;
    EXPECT_THROW((void)fit::fit(spec), InputError) << quantity;
  }
}

// 95 % intervals under noise of 2e-4: how often they hold the truth. 200 replicates, 3 parameters; the
// binomial deviation of a rate is 1.5 %.
TEST(SlowBedHeightFit, IntervalsCover) {
  const Observations exact = support::observed(may(), every_tenth(), 0, 1, false);
  auto spec = support::fit_of(may(), exact, {"shear_rate.values", "shear_rate.breaks"}, {2.4, 0.31, 0.29});
  const double truth[] = {2.4, 0.31, 0.29};
  constexpr int n = 200;
  int covered[3] = {};
  for (int b = 0; b < n; ++b) {
    spec.observations = exact;
    add_noise(spec.observations, 2e-4, 23, static_cast<std::uint64_t>(b));
    const fit::Estimate e = fit::fit(spec);
    for (std::size_t i = 0; i < 3; ++i)
      covered[i] += e.parameters[i].ci95 && e.parameters[i].ci95->low <= truth[i] &&
                    truth[i] <= e.parameters[i].ci95->high;
  }
  for (const int count : covered) {
    EXPECT_GE(count, 0.95 * n - 4 * 3.1);
    EXPECT_LE(count, 0.95 * n + 4 * 3.1);
  }
}

/// A table of 12 points at 40 times: states that are neither 0 nor 1 in linear pieces, where phi may fall between shocks, so that a
/// rule that takes equal ends for a constant, or one cut for all, would be off. Against sums over 4000 heights, and fronts.
TEST(BedHeight, OfATableIsThatOfSumsAndOfFronts) {
  auto spec = support::bed_of_42_mm();
  spec.close_packing = PackingPolynomial<double>{};
  const Scene<double> scene(spec);
  const BedHeight bed(scene);
  const double t_star = *exact_timeline(scene).t_star;
  std::vector<double> times;
  for (int i = 1; i <= 40; ++i) times.push_back(t_star * i / 40);
  const auto exact = heights<ExactSolver>(scene, times);
  FrontTrackingSolver::Options fine;
  fine.resolution = 0.01;
  const auto tracked = heights<FrontTrackingSolver>(scene, times, fine);
  const ExactSolution<double> solution(scene);
  constexpr int kHeights = 4000;
  for (std::size_t i = 0; i < times.size(); ++i) {
    double sum = 0;
    for (int k = 0; k < kHeights; ++k)
      sum += bed.integrand().value(solution.phi(42 * (k + 0.5) / kHeights, times[i])) * (42.0 / kHeights);
    // A shock costs the sum half a step at most.
    EXPECT_NEAR(exact[i], bed.height(sum), 1e-3) << "t " << times[i];
    EXPECT_NEAR(exact[i], tracked[i], 42 * 1e-4) << "t " << times[i];
  }
}

}  // namespace
}  // namespace shearfront
