// SPDX-License-Identifier: BSD-3-Clause
// What every solver keeps on general scenes: any flux, solid fraction and temperature, walls, open and joined ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/any_scene.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"

namespace shearfront {
namespace {

constexpr double kTime = 0.3;  // later than the change of the state outside

SolverRequest request() {
  SolverRequest request{{kTime}, {}};
  request.profiles = true;
  return request;
}

const support::OptionNumbers kOptions{{"resolution", 0.02}, {"cells", 200}};

template <class Check>
void for_scenes(std::uint64_t stream, int n, Check&& check) {
  support::SceneMaker maker(support::seed_of(stream));
  for (int number = 0; number < n;) {
    SceneSpec<double> spec = support::any_scene(maker, 4);
    if (!find_complaints(spec).empty()) continue;
    SCOPED_TRACE("scene " + std::to_string(number++) + ", flux " + std::string(spec.fluxes[0].name()));
    check(maker, Scene<double>(std::move(spec)));
  }
}

/// Lowest and highest states of all layers: of phi / c times c.
void expect_in_range(const Scene<double>& scene, const Profile<double>& profile) {
  const bool is_layered =
      !scene.spec().solid_fraction || std::holds_alternative<Piecewise<double>>(*scene.spec().solid_fraction);
  for (std::size_t i = 0; i < profile.n_cells(); ++i) {
    const double lo = profile.z()[i], hi = profile.z()[i + 1];
    if (!(hi > lo)) continue;
    // The flux in the middle, c at the ends.
    const StateRange<double> states = scene.flux_at(lo + (hi - lo) / 2).range();
    const double c_lo = scene.solid_fraction_at(is_layered ? lo + (hi - lo) / 2 : lo);
    const double c_hi = scene.solid_fraction_at(is_layered ? lo + (hi - lo) / 2 : hi);
    const double slack = 1e-15 * std::max(states.highest, -states.lowest);
    ASSERT_GE(profile.below()[i], c_lo * states.lowest - slack) << "z = " << lo;
    ASSERT_LE(profile.below()[i], c_lo * states.highest + slack) << "z = " << lo;
    ASSERT_GE(profile.above()[i], c_hi * states.lowest - slack) << "z = " << hi;
    ASSERT_LE(profile.above()[i], c_hi * states.highest + slack) << "z = " << hi;
  }
}

TEST(AnyScene, StaysInRangeAndKeepsItsMass) {
  support::Checked checked;
  SolverList::for_each([&]<class S>() {
    const Guarantees promised = S::guarantees();
    if (promised.diffusion || promised.has_slab || !promised.has_profiles) return;
    if (promised.bounded) checked.expect(std::string(S::kName) + " stays in range");
    if (promised.conservative) checked.expect(std::string(S::kName) + " keeps its mass");
  });
  for_scenes(7601, 60, [&](support::SceneMaker&, const Scene<double>& scene) {
    checked.count();
    SolverList::for_each([&]<class S>() {
      const Guarantees promised = S::guarantees();
      const auto options = support::options_of<S>(kOptions);
      if (!S::refusal(scene, options).empty() || !promised.has_profiles) return;
      SCOPED_TRACE(std::string(S::kName));
      const SolverResult result = solve<S>(scene, request(), options);
      if (!promised.bounded && result.summary.status == Status::diverged) return;
      ASSERT_TRUE(result.summary.usable()) << result.summary.message;
      const Profile<double>& profile = result.profiles[0];
      if (promised.bounded) {
        expect_in_range(scene, profile);
        checked.count(std::string(S::kName) + " stays in range");
      }
      if (promised.conservative && (scene.has_walls() || scene.spec().is_periodic)) {
        double largest = 1;  // schemes that overshoot may do so by much
        for (const double phi : profile.below()) largest = std::max(largest, std::abs(phi));
        EXPECT_NEAR(profile.mass(), scene.mass(), 1e-12 * largest);
        checked.count(std::string(S::kName) + " keeps its mass");
      }
    });
  });
}

// Two roads to one solution: what is between them vanishes as both are refined.
TEST(SlowAnyScene, FrontTrackingAgreesWithGodunov) {
  support::Checked checked({"coarse", "fine"});
  for_scenes(7602, 100, [&](support::SceneMaker&, const Scene<double>& scene) {
    const StateRange<double> range = scene.range_at(0.5);
    const auto distance = [&](support::OptionNumbers numbers) {
      const auto cells = support::options_of<GodunovSolver>(numbers);
      const auto fronts = support::options_of<FrontTrackingSolver>(numbers);
      if (!GodunovSolver::refusal(scene, cells).empty() ||
          !FrontTrackingSolver::refusal(scene, fronts).empty())
        return std::optional<double>();
      const SolverResult on_cells = solve<GodunovSolver>(scene, request(), cells);
      const SolverResult tracked = solve<FrontTrackingSolver>(scene, request(), fronts);
      EXPECT_TRUE(on_cells.summary.usable()) << on_cells.summary.message;
      EXPECT_TRUE(tracked.summary.usable()) << tracked.summary.message;
      return std::optional(l1_distance(on_cells.profiles.at(0), tracked.profiles.at(0)) /
                           (range.highest - range.lowest));
    };
    const auto coarse = distance(kOptions);
    if (!coarse) return;
    checked.count("coarse");
    if (*coarse <= 0.02) return;
    support::OptionNumbers fine = kOptions;
    fine["cells"] *= 16;
    fine["resolution"] /= 4;
    EXPECT_LE(*distance(fine), 0.03);  // contacts of triangles spread over sqrt(dz) = 0.018 of the height
    checked.count("fine");
  });
}

// L1 contraction and comparison of the first-order schemes, the states outside being the same.
TEST(AnyScene, SchemesOfFirstOrderContract) {
  support::Checked checked({GodunovSolver::kName, EngquistOsherSolver::kName}, 10);
  for_scenes(7603, 100, [&](support::SceneMaker& maker, const Scene<double>& scene) {
    SceneSpec<double> other = scene.spec();
    double highest = 1e300;
    for (const auto& flux : other.fluxes) highest = std::min(highest, flux.range().highest);
    for (double& share : other.initial_values) share += (highest - share) * maker.uniform(0, 1);
    const Scene<double> higher(std::move(other));
    const auto check = [&]<class S>(const S&) {
      const auto options = support::options_of<S>(kOptions);
      if (!S::refusal(scene, options).empty() || !S::refusal(higher, options).empty()) return;
      SolverRequest both = request();
      both.times = {0, kTime};
      const SolverResult u = solve<S>(scene, both, options), v = solve<S>(higher, both, options);
      ASSERT_TRUE(u.summary.usable()) << S::kName << ": " << u.summary.message;
      ASSERT_TRUE(v.summary.usable()) << S::kName << ": " << v.summary.message;
      EXPECT_LE(l1_distance(u.profiles[1], v.profiles[1]), l1_distance(u.profiles[0], v.profiles[0]) + 1e-13)
          << S::kName;
      for (std::size_t i = 0; i < u.profiles[1].n_cells(); ++i)
        ASSERT_LE(u.profiles[1].below()[i], v.profiles[1].below()[i] + 1e-14) << S::kName << ", cell " << i;
      checked.count(S::kName);
    };
    // With open ends more may flow in where the bed holds less: contraction is that of beds without.
    if (!scene.has_walls() && !scene.spec().is_periodic) return;
    check(GodunovSolver{});
    check(EngquistOsherSolver{});
  });
}

}  // namespace
}  // namespace shearfront
