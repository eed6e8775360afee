// SPDX-License-Identifier: BSD-3-Clause
// Fluxes without an extremum inside their range, against the construction of Welge (1952) and against their mirror
// images. The kind of fault: an interface problem that was asked to match two branches where there is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "oracles/verify.hpp"
#include "shearfront/model/flux/buckley_leverett.hpp"
#include "shearfront/model/flux/table.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"

namespace shearfront {
namespace {

/// Water driven into oil from the bottom, at speed 1: behind the shock, which moves with f'(u*) = f(u*) / u*, the state u
/// is at z = f'(u) t, and below z there is int_0^z u = z u + t (1 - f(u)).
struct Welge {
  BuckleyLeverett<double> flux;

  [[nodiscard]] double at_shock() const {
    return std::sqrt(flux.viscosity_ratio / (1 + flux.viscosity_ratio));
  }
  [[nodiscard]] double speed() const { return flux.derivative(at_shock()); }
  [[nodiscard]] double state(double z, double t) const {
    if (z > speed() * t) return 0;
    double lo = at_shock(), hi = 1;  // f' falls
    for (int i = 0; i < 60; ++i) {
      const double u = (lo + hi) / 2;
      (flux.derivative(u) * t > z ? lo : hi) = u;
    }
    return lo;
  }
  [[nodiscard]] double amount(double z, double t) const {
    const double u = state(z, t);
    return u == 0 ? t : z * u + t * (1 - flux.value(u));
  }
};

SceneSpec<> injection(const Flux<double>& flux, std::vector<double> breaks, std::vector<double> rates) {
  SceneSpec<> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{std::move(breaks), std::move(rates)};
  spec.initial_values = {0};
  spec.outside_bottom = OutsideState<double>{{}, {1}};
  spec.outside_top = OutsideState<double>{{}, {0}};
  return spec;
}

const std::vector<std::string> kMethods{"front-tracking", "godunov", "engquist-osher"};
constexpr double kFineness = 8;

/// Largest error of M over the bed.
double worst_amount(const std::string& method, const Scene<>& scene, const Welge& exact, double t,
                    const support::OptionNumbers& numbers) {
  SolverRequest request{{t}, {}};
  for (int i = 0; i <= 50; ++i) request.heights.push_back(i / 50.0);
  const SolverResult result = solve(scene, support::method_of(method, numbers), request);
  EXPECT_TRUE(result.summary.usable()) << method << ": " << result.summary.message;
  double worst = 0;
  for (std::size_t i = 0; i < result.samples.size(); ++i)
    worst = std::max(worst, std::abs(result.samples[i].M - exact.amount(request.heights[i], t)));
  return worst;
}

TEST(BuckleyLeverett, InjectionIsThatOfWelge) {
  EXPECT_NEAR(Welge{{1}}.speed(), (1 + std::sqrt(2.0)) / 2, 1e-14);
  for (const double ratio : {0.1, 1.0, 8.0}) {
    const Welge exact{{ratio}};
    const Scene<> scene(injection(exact.flux, {}, {1}));
    const double t = 0.8 / exact.speed();
    for (const std::string& method : kMethods) {
      SCOPED_TRACE(method + ", ratio " + std::to_string(ratio));
      const bool is_tracking = method == "front-tracking";
      const double coarse = worst_amount(method, scene, exact, t, {{"resolution", 0.04}, {"cells", 100}});
      const double fine = worst_amount(method, scene, exact, t,
                                       {{"resolution", 0.04 / kFineness}, {"cells", 100 * kFineness}});
      EXPECT_LT(fine, is_tracking ? 5e-5 : 1e-3);
      EXPECT_LT(fine, coarse / (is_tracking ? 20 : 4));  // second and first order
    }
  }
}

TEST(BuckleyLeverett, TheShockMovesWithItsSpeed) {
  const Welge exact{{1}};
  Tracking bed = track(Scene<>(injection(exact.flux, {}, {1})), {.resolution = 0.001});
  bed.advance(0.5);
  const Profile<double> profile = bed.profile();
  double largest = 0, place = 0;
  for (std::size_t i = 1; i < profile.n_cells(); ++i)
    if (const double jump = profile.above()[i - 1] - profile.below()[i]; jump > largest)
      largest = jump, place = profile.z()[i];
  EXPECT_NEAR(place, 0.5 * exact.speed(), 1e-6);
  EXPECT_NEAR(largest, exact.at_shock(), 1e-3);
}

// Two rocks, the upper one twice as fast: what arrives, f(u), leaves as the state v with 2 f(v) = f(u).
TEST(BuckleyLeverett, TwoRocks) {
  const Welge exact{{1}};
  const Scene<> scene(injection(exact.flux, {0.5}, {1, 2}));
  for (const double t : {0.6, 1.0, 3.0}) {
    const double f = exact.flux.value(exact.state(0.5, t));
    const double odds = std::sqrt(f / (2 - f)),
                 above = odds / (1 + odds);  // 2 f(v) = f: v^2 / (1 - v)^2 = f / (2 - f)
    if (t == 3) {
      EXPECT_NEAR(above, 0.49867, 1e-5);
    }
    for (const std::string& method : kMethods) {
      SCOPED_TRACE(method + ", t = " + std::to_string(t));
      const support::OptionNumbers numbers{{"resolution", 0.002}, {"cells", 2000}};
      const SolverResult result =
          solve(scene, support::method_of(method, numbers), SolverRequest{{t}, {0.5, 1}});
      ASSERT_TRUE(result.summary.usable()) << result.summary.message;
      EXPECT_NEAR(result.samples[0].phi, above, 1e-3);
      EXPECT_NEAR(result.samples[0].M, exact.amount(0.5, t), method == "front-tracking" ? 2e-5 : 5e-4);
    }
  }
}

TEST(BuckleyLeverett, TrackerKeepsTheLaws) {
  support::Checked checked({""}, 20);
  for (const BuckleyLeverett<double>& flux : BuckleyLeverett<double>::samples()) {
    SceneSpec<> spec = injection(flux, {0.3, 0.6}, {1, 2.5, 1.25});
    spec.solid_fraction = Piecewise<double>{{0.45}, {0.5, 0.75}};
    spec.initial_breaks = {0.1, 0.7};
    spec.initial_values = {0.25, 0.0625, 0.5};
    spec.outside_bottom = OutsideState<double>{{0.2, 0.4}, {0.875, 0.125, 1}};
    const Scene<> scene(spec);
    ASSERT_TRUE(FrontTrackingSolver::refusal(scene, {}).empty()) << FrontTrackingSolver::refusal(scene, {});
    const TrackingSetup<double, UnimodalGrid<double>> setup(scene, 0.05);
    Tracker<UnimodalGrid<double>> tracker(setup);
    for (double t = 0; t < 1.05; t += 0.1) {
      tracker.advance_to(t);
      for (const std::string& violation : verify(tracker, 1e-12, 1e-9)) ADD_FAILURE() << violation;
      checked.count();
    }
  }
}

// z -> 1 - z turns a flux that rises into one that falls.
TEST(BuckleyLeverett, FallingFluxesMirrorRisingOnes) {
  const BuckleyLeverett<double> flux{0.5};
  FluxTable<double> rising, falling;
  for (int i = 0; i <= 16; ++i) {
    rising.phi.push_back(i / 16.0);
    rising.values.push_back(flux.value(i / 16.0));
    falling.values.push_back(-flux.value(i / 16.0));
  }
  falling.phi = rising.phi;
  SceneSpec<> up = injection(rising, {0.25}, {1, 1.5}), down = injection(falling, {0.75}, {1.5, 1});
  up.initial_breaks = {0.5}, down.initial_breaks = {0.5};
  up.initial_values = {0.125, 0.5}, down.initial_values = {0.5, 0.125};
  std::swap(down.outside_bottom, down.outside_top);
  const Scene<> upward(up), downward(down);
  const SolverRequest request{{0.1, 0.3, 0.8}, {0.1013, 0.3013, 0.6013, 0.9013}};
  for (const std::string& method : kMethods) {
    SCOPED_TRACE(method);
    const support::OptionNumbers numbers{{"resolution", 0.02}, {"cells", 200}};
    SolverRequest mirrored = request;
    for (double& z : mirrored.heights) z = 1 - z;
    const SolverResult a = solve(upward, support::method_of(method, numbers), request);
    const SolverResult b = solve(downward, support::method_of(method, numbers), mirrored);
    ASSERT_TRUE(a.summary.usable() && b.summary.usable()) << a.summary.message << b.summary.message;
    // Front tracking fills its levels from the other side; its states are within a step of the same ones.
    const double tolerance = method == "front-tracking" ? 0.02 : 1e-9;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
      EXPECT_NEAR(a.samples[i].phi, b.samples[i].phi, tolerance) << i;
  }
}

TEST(BuckleyLeverett, ALayerMustTakeWhatComes) {
  // Behind the front 2 f passes through the lower rock; the upper one takes no more than 1.
  SceneSpec<> spec = injection(BuckleyLeverett<double>{1}, {0.5}, {2, 1});
  for (const std::string& method : kMethods) {
    const std::string why = Method(method).refusal(Scene<>(spec));
    EXPECT_NE(why.find("the layer above z = 0.5 has no state for the flux 2"), std::string::npos) << why;
  }
  spec.outside_bottom->values = {0.5};  // 2 f = 1
  for (const std::string& method : kMethods) EXPECT_EQ(Method(method).refusal(Scene<>(spec)), "") << method;
  const SolverResult result = solve(Scene<>(spec), "front-tracking", SolverRequest{{4}, {0.75}});
  EXPECT_GT(result.samples.at(0).phi, 0.9);
  EXPECT_LE(result.samples.at(0).phi, 1);
}

// What begins inside a stretch where a(z) falls must pass its narrow end too: front tracking searched for ever for states that
// no layer has, and the schemes printed what they had lost. Found by the soak.
TEST(BuckleyLeverett, ARateThatFallsMustTakeWhatBeginsBelow) {
  SceneSpec<> spec = injection(BuckleyLeverett<double>{1}, {}, {1});
  spec.shear_rate = Table<double>{{0, 1}, {2, 0.5}};
  spec.outside_bottom->values = {0};
  spec.initial_breaks.clear();
  spec.initial_values = {0.5};  // f = 1/2: 2 f = 1 at the bottom, at most 0.5 at the top
  for (const std::string& method : kMethods) {
    const std::string why = Method(method).refusal(Scene<>(spec));
    EXPECT_NE(why.find("has no state for the flux 1 that may come to it"), std::string::npos) << why;
  }
  // A quarter of it passes; and anything does where a rises.
  spec.initial_values = {1 - std::sqrt(0.75)};
  ASSERT_LT(2 * BuckleyLeverett<double>{1}.value(spec.initial_values[0]), 0.5);
  for (const std::string& method : kMethods) EXPECT_EQ(Method(method).refusal(Scene<>(spec)), "") << method;
  spec.shear_rate = Table<double>{{0, 1}, {0.5, 2}};
  spec.initial_values = {1};
  for (const std::string& method : kMethods) EXPECT_EQ(Method(method).refusal(Scene<>(spec)), "") << method;
}

}  // namespace
}  // namespace shearfront
