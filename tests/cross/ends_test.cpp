// SPDX-License-Identifier: BSD-3-Clause
// Front tracking in beds without walls: open and periodic ends.
#include <gtest/gtest.h>

#include <vector>

#include "shearfront/track/solver.hpp"
#include "support/any_flux.hpp"

namespace shearfront {
namespace {

using support::draw;
using support::name_of;
using support::SceneMaker;
using support::unimodal_fluxes;

/// n copies of the bed on top of each other, as many layers and jumps.
SceneSpec<double> repeated(const SceneSpec<double>& spec, int n) {
  SceneSpec<double> all = spec;
  auto& a = std::get<Piecewise<double>>(all.shear_rate);
  const auto& one = std::get<Piecewise<double>>(spec.shear_rate);
  all.is_periodic = false;
  all.top = n;
  for (int i = 1; i < n; ++i) {
    a.breaks.push_back(i), all.initial_breaks.push_back(i);
    for (const double z : one.breaks) a.breaks.push_back(i + z);
    for (const double z : spec.initial_breaks) all.initial_breaks.push_back(i + z);
    a.values.insert(a.values.end(), one.values.begin(), one.values.end());
    all.initial_values.insert(all.initial_values.end(), spec.initial_values.begin(),
                              spec.initial_values.end());
  }
  return all;
}

// What the walls do has not reached the middle copy yet.
TEST(Ends, APeriodicBedIsTheMiddleOfManyCopies) {
  SceneMaker maker(support::seed_of(8104));
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 4; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      SceneSpec<double> spec = draw(maker, flux, 1 + number, 2);
      for (double& a : std::get<Piecewise<double>>(spec.shear_rate).values) a = maker.uniform(0.5, 1);
      spec.is_periodic = true;
      const int n = 11;
      SolverRequest request{{0.4, 2.5}, {}, false, false, false}, many = request;
      for (int i = 0; i < 50; ++i) request.depths.push_back((i + 0.31) / 50);
      for (const double z : request.depths) many.depths.push_back(z + 5);
      SolverOptions options;
      options.resolution = 0.05;
      const auto periodic = FrontTrackingSolver::solve(Scene<double>(spec), request, options);
      const auto copies = FrontTrackingSolver::solve(Scene<double>(repeated(spec, n)), many, options);
      ASSERT_EQ(periodic.samples.size(), 100u) << periodic.summary.message;
      ASSERT_EQ(copies.samples.size(), 100u) << copies.summary.message;
      for (std::size_t i = 0; i < 100; ++i)
        EXPECT_NEAR(periodic.samples[i].phi, copies.samples[i].phi, 1e-12) << i;
    }
}

// The bed goes on beyond its ends in the state that lies outside: then the ends are not there.
TEST(Ends, AnOpenEndNextToItsOwnStateIsNotThere) {
  SceneMaker maker(support::seed_of(8105));
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 4; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      SceneSpec<double> spec = draw(maker, flux, 1 + number, 3), wide = spec;
      const double fastest = 4 * 2.5, t = 0.8;  // of a up to 4; |f'| <= 2.5 on all samples
      wide.bottom = -fastest * t, wide.top = 1 + fastest * t;
      spec.outside_bottom = OutsideState<double>{{}, {spec.initial_values.front()}};
      spec.outside_top = OutsideState<double>{{}, {spec.initial_values.back()}};
      SolverRequest request{{0.2, t}, {}, false, false, false};
      for (int i = 0; i < 50; ++i) request.depths.push_back((i + 0.31) / 50);
      SolverOptions options;
      options.resolution = 0.05;
      const auto open = FrontTrackingSolver::solve(Scene<double>(spec), request, options);
      const auto all = FrontTrackingSolver::solve(Scene<double>(wide), request, options);
      ASSERT_EQ(open.samples.size(), 100u) << open.summary.message;
      ASSERT_EQ(all.samples.size(), 100u) << all.summary.message;
      for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(open.samples[i].phi, all.samples[i].phi, 1e-12) << i;
    }
}

// Red and green: cars wait behind a light at the upper end (state outside: jam while it is red), and the
// queue dissolves in a fan from 1 to 1/2 when it turns green.
TEST(Ends, TrafficLight) {
  SceneSpec<double> spec;
  spec.fluxes = {Lwr<double>{}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.2};
  spec.outside_bottom = OutsideState<double>{{}, {0.2}};
  spec.outside_top = OutsideState<double>{{1}, {1, 0}};
  SolverRequest request{{0.5, 1, 1.4}, {}, false, false, true};
  SolverOptions options;
  options.resolution = 0.001;
  const auto result = FrontTrackingSolver::solve(Scene<double>(spec), request, options);
  ASSERT_EQ(result.profiles.size(), 3u);
  // The end of the queue moves with (0 - 0.16) / (1 - 0.2) = -0.2.
  EXPECT_NEAR(result.profiles[0].at(0.89).phi, 0.2, 1e-15);
  EXPECT_NEAR(result.profiles[0].at(0.91).phi, 1, 1e-15);
  EXPECT_NEAR(result.profiles[0].mass(), 0.2 * 0.9 + 0.1, 1e-14);
  EXPECT_NEAR(result.profiles[1].mass(), 0.2 * 0.8 + 0.2, 1e-14);
  // 0.4 later: the fan 1 - 2 rho = (z - 1) / 0.4 reaches down to 0.6, the queue is gone at 1.25, and where
  // the two meet the end of the queue speeds up: (z_q - 1) = 0.4 (1 - 2 rho_q) with z_q from the jump
  // condition.
  for (const double z : {0.85, 0.9, 0.95, 0.99})
    EXPECT_NEAR(result.profiles[2].at(z).phi, 0.5 * (1 - (z - 1) / 0.4), 2e-3) << z;
  // What has left: capacity 1/4 since t = 1; what came in: 0.16.
  EXPECT_NEAR(result.profiles[2].mass(), 0.2 + 0.16 * 1.4 - 0.25 * 0.4, 1e-13);
}

}  // namespace
}  // namespace shearfront
