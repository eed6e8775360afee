// SPDX-License-Identifier: BSD-3-Clause
// What every solver keeps on general scenes: any flux, solid fraction and temperature, walls, open and joined ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "shearfront/solver/all.hpp"
#include "support/any_scene.hpp"

namespace shearfront {
namespace {

constexpr double kTime = 0.3;  // later than the change of the state outside

SolverRequest request() {
  SolverRequest request{{kTime}, {}};
  request.profiles = true;
  return request;
}

SolverOptions options() {
  SolverOptions options;
  options.resolution = 0.02;
  options.cells = 200;
  return options;
}

template <class Check>
void for_scenes(std::uint64_t stream, int n, Check&& check) {
  support::SceneMaker maker(support::seed_of(stream));
  for (int number = 0; number < n;) {
    SceneSpec<double> spec = support::any_scene(maker, 4);
    if (!find_complaints(spec).empty()) continue;
    SCOPED_TRACE("scene " + std::to_string(number++) + ", flux " +
                 std::visit([](const auto& f) { return std::string(f.kName); }, spec.fluxes[0]));
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
    const StateRange<double> states =
        std::visit([](const auto& f) { return f.range(); }, scene.flux_at(lo + (hi - lo) / 2));
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
  for_scenes(7601, 40, [](support::SceneMaker&, const Scene<double>& scene) {
    SolverList::for_each([&]<class S>() {
      const Guarantees promised = S::guarantees();
      if (!promised.scope.covers(scene) || !promised.has_profiles) return;
      const SolverResult result = S::solve(scene, request(), options());
      ASSERT_TRUE(result.summary.usable()) << S::kName << ": " << result.summary.message;
      SCOPED_TRACE(std::string(S::kName));
      if (!promised.bounded) return;  // schemes that overshoot may do so without end
      expect_in_range(scene, result.profiles[0]);
      if (scene.has_walls() || scene.spec().is_periodic) {
        EXPECT_NEAR(result.profiles[0].mass(), scene.mass(), 1e-12);
      }
    });
  });
}

// Two roads to one solution: what is between them vanishes as both are refined.
TEST(SlowAnyScene, FrontTrackingAgreesWithGodunov) {
  for_scenes(7602, 100, [](support::SceneMaker&, const Scene<double>& scene) {
    const StateRange<double> range = scene.range_at(0.5);
    const auto distance = [&](const SolverOptions& options) {
      const SolverResult cells = GodunovSolver::solve(scene, request(), options);
      const SolverResult fronts = FrontTrackingSolver::solve(scene, request(), options);
      if (!cells.summary.usable() || !fronts.summary.usable()) return 0.0;
      return l1_distance(cells.profiles[0], fronts.profiles[0]) / (range.highest - range.lowest);
    };
    if (distance(options()) <= 0.02) return;
    SolverOptions fine = options();
    fine.cells *= 16;
    fine.resolution /= 4;
    EXPECT_LE(distance(fine), 0.03);  // contacts of triangles spread over sqrt(dz) = 0.018 of the height
  });
}

// L1 contraction and comparison of the first-order schemes, the states outside being the same.
TEST(AnyScene, SchemesOfFirstOrderContract) {
  for_scenes(7603, 100, [](support::SceneMaker& maker, const Scene<double>& scene) {
    SceneSpec<double> other = scene.spec();
    double highest = 1e300;
    for (const auto& flux : other.fluxes)
      highest = std::min(highest, std::visit([](const auto& f) { return f.range().highest; }, flux));
    for (double& share : other.initial_values) share += (highest - share) * maker.uniform(0, 1);
    const Scene<double> higher(std::move(other));
    const auto check = [&]<class S>(const S&) {
      SolverRequest both = request();
      both.times = {0, kTime};
      const SolverResult u = S::solve(scene, both, options()), v = S::solve(higher, both, options());
      if (!u.summary.usable() || !v.summary.usable()) return;
      EXPECT_LE(l1_distance(u.profiles[1], v.profiles[1]), l1_distance(u.profiles[0], v.profiles[0]) + 1e-13)
          << S::kName;
      for (std::size_t i = 0; i < u.profiles[1].n_cells(); ++i)
        ASSERT_LE(u.profiles[1].below()[i], v.profiles[1].below()[i] + 1e-14) << S::kName << ", cell " << i;
    };
    // With open ends more may flow in where the bed holds less: contraction is that of beds without.
    if (!scene.has_walls() && !scene.spec().is_periodic) return;
    check(GodunovSolver{});
    check(EngquistOsherSolver{});
  });
}

}  // namespace
}  // namespace shearfront
