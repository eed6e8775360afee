// SPDX-License-Identifier: BSD-3-Clause
// Front tracking for every flux of the list: laws, and the finite volumes as an independent solution.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "oracles/verify.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/any_flux.hpp"
#include "support/checked.hpp"

namespace shearfront {
namespace {

using support::draw;
using support::name_of;
using support::SceneMaker;
using support::unimodal_fluxes;

template <class Grid>
void check_laws(const Scene<double>& scene, double resolution, const std::vector<double>& times) {
  const TrackingSetup<double, Grid> setup(scene, resolution);
  Tracker<Grid, NoObserver> tracker(setup);
  const double mass = scene.mass();
  for (const double t : times) {
    const Status status = tracker.advance_to(t);
    ASSERT_TRUE(status == Status::ok || status == Status::steady) << t;
    for (const std::string& violation : verify(tracker, 1e-12, 1e-9)) ADD_FAILURE() << violation;
    EXPECT_NEAR(tracker.mass(), mass, 1e-12) << t;
    const Profile<double> profile = tracker.profile();
    EXPECT_NEAR(profile.mass(), mass, 1e-12);
  }
  ASSERT_EQ(tracker.run_to_steady(), Status::steady);
  EXPECT_NEAR(tracker.mass(), mass, 1e-12);
  for (const std::string& violation : verify(tracker, 1e-12, 1e-9)) ADD_FAILURE() << violation;
  // All that was mixed has gone to its end of the bed.
  const double z = scene.steady_height();
  const Profile<double> last = tracker.profile();
  support::Checked checked;
  for (const double d : {-0.1, -1e-6, 1e-6, 0.1}) {
    if (z + d <= scene.bottom() || z + d >= scene.top()) continue;
    const StateRange<double> range = scene.range_at(z + d);
    const double phi = last.at(z + d).phi;
    EXPECT_EQ(phi, (d < 0) == setup.grid.is_reversed() ? range.lowest : range.highest) << d;
    checked.count();
  }
}

TEST(AnyFlux, TrackerKeepsTheLaws) {
  SceneMaker maker(support::seed_of(8101));
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 6; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      const Scene<double> scene(draw(maker, flux, 1 + number, 1 + number));
      check_laws<UnimodalGrid<double>>(scene, 0.1, {0.01, 0.3, 2});
      if (LevelGrid<double>::refusal(exact_layers(scene)).empty())
        check_laws<LevelGrid<double>>(scene, 0.1, {0.01, 0.3, 2});
    }
}

/// Pieces of a few coarse cells, where errors do not fall at once.
bool has_thin_pieces(const SceneSpec<double>& spec) {
  std::vector<double> ends = spec.initial_breaks;
  ends.insert(ends.begin(), spec.bottom);
  ends.push_back(spec.top);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (ends[i + 1] - ends[i] < 0.05) return true;
  return false;
}

TEST(AnyFlux, TrackerAgreesWithGodunov) {
  SceneMaker maker(support::seed_of(8102));
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 2; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      SceneSpec<double> spec = draw(maker, flux, 2 + number, 2);
      while (has_thin_pieces(spec)) spec = draw(maker, flux, 2 + number, 2);
      const Scene<double> scene(spec);
      const double height = flux.range().highest;
      SolverRequest request;
      request.times = {0.2, 1};
      for (int i = 1; i < 40; ++i) request.heights.push_back(i / 40.0);
      const auto tracked = solve<FrontTrackingSolver>(scene, request, {.resolution = 0.003});
      ASSERT_EQ(tracked.samples.size(), 78u) << tracked.summary.message;
      const auto error = [&](std::size_t cells) {
        const auto grid = solve<GodunovSolver>(scene, request, {{.cells = cells}});
        EXPECT_EQ(grid.samples.size(), 78u) << grid.summary.message;
        double largest = 0;
        for (std::size_t i = 0; i < grid.samples.size(); ++i)
          largest = std::max(largest, std::abs(grid.samples[i].M - tracked.samples[i].M) / height);
        return largest;
      };
      const double coarse_error = error(200), fine_error = error(800);
      // M of first order on the grid, of order 1/2 at contacts; 1e-5 from the tracker.
      const bool has_contacts = flux.as<Triangular<double>>() != nullptr;
      EXPECT_LT(fine_error, has_contacts ? 6e-3 : 4e-3);
      const double fall = has_contacts ? 0.6 : 0.45;
      // The largest error of a coarse grid may by chance be small; then twice the refinement, twice the fall.
      if (!(fine_error < fall * coarse_error + 2e-5)) {
        EXPECT_LT(error(3200), fall * fall * coarse_error + 2e-5);
      }
    }
}

/// Root of a function that changes sign between lo and hi.
template <class Function>
double root(const Function& f, double lo, double hi) {
  const bool rises = f(hi) > 0;
  for (int i = 0; i < 200; ++i) {
    const double x = lo + (hi - lo) / 2;
    ((f(x) > 0) == rises ? hi : lo) = x;
  }
  return lo;
}

// f = -phi (1 - phi)(1 - 0.9 phi) is concave above 0.70: the fan from 0 ends at the tangent to f from
// phi = 1, and a shock from there to 1 moves with its last speed.
TEST(AnyFlux, CompoundWaveOfANonConvexFlux) {
  const Cubic<double> flux{0.9};
  const double tangent =
      root([&](double phi) { return flux.derivative(phi) - flux.secant(phi, 1.0); }, 0.4, 0.7);
  const double a = 0.8, t = 0.4, z0 = 0.6;
  const auto exact = [&](double z) {
    const double speed = (z - z0) / (a * t);
    if (speed <= flux.derivative(0.0)) return 0.0;
    if (speed >= flux.derivative(tangent)) return 1.0;
    return root([&](double phi) { return flux.derivative(phi) - speed; }, 0.0, tangent);
  };
  SceneSpec<double> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{}, {a}};
  spec.initial_breaks = {z0};
  spec.initial_values = {0, 1};
  SolverRequest request{{t}, {}, false, false, true};
  constexpr int kPoints = 20000;
  std::vector<double> phi(kPoints);
  for (int i = 0; i < kPoints; ++i) phi[static_cast<std::size_t>(i)] = exact((i + 0.5) / kPoints);
  const auto l1_error = [&](const Profile<double>& profile) {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i)
      sum += std::abs(profile.at((i + 0.5) / kPoints).phi - phi[static_cast<std::size_t>(i)]);
    return sum / kPoints;
  };
  for (const double resolution : {0.1, 0.01, 0.001}) {
    const auto result = solve<FrontTrackingSolver>(Scene<double>(spec), request, {.resolution = resolution});
    ASSERT_EQ(result.profiles.size(), 1u);
    EXPECT_LT(l1_error(result.profiles[0]), 0.15 * resolution) << resolution;
  }
}

}  // namespace
}  // namespace shearfront
