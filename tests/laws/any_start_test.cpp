// SPDX-License-Identifier: BSD-3-Clause
// What every solver keeps on general scenes from every kind of start: any flux, solid fraction and temperature, walls, open and
// joined ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/any_scene.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

template <class Check>
void for_starts(std::uint64_t stream, int n, Check&& check) {
  support::SceneMaker maker(support::seed_of(stream));
  for (int number = 0; number < n;) {
    SceneSpec<double> spec = support::any_scene(maker, 4);
    double lowest = -1e300, highest = 1e300;
    for (const auto& flux : spec.fluxes) {
      lowest = std::max(lowest, flux.range().lowest);
      highest = std::min(highest, flux.range().highest);
    }
    spec.initial_breaks.clear();
    spec.initial_values.clear();
    spec.initial_state = support::random_start(maker, lowest, highest);
    if (!find_complaints(spec).empty()) continue;
    SCOPED_TRACE("scene " + std::to_string(number++) + ", flux " + std::string(spec.fluxes[0].name()));
    check(Scene<double>(std::move(spec)));
  }
}

TEST(AnyStart, StaysInRangeKeepsItsMassAndBeginsWithItself) {
  support::Checked checked;
  SolverList::for_each([&]<class S>() {
    const Guarantees promised = S::guarantees();
    if (promised.diffusion || promised.has_slab) return;
    if (promised.bounded) checked.expect(std::string(S::kName) + " stays in range");
    if (promised.conservative) checked.expect(std::string(S::kName) + " keeps its mass");
  });
  const support::OptionNumbers numbers{{"resolution", 0.05}, {"cells", 100}};
  for_starts(7701, 40, [&](const Scene<double>& scene) {
    checked.count();
    SolverList::for_each([&]<class S>() {
      const Guarantees promised = S::guarantees();
      const auto options = support::options_of<S>(numbers);
      if (!S::refusal(scene, options).empty()) return;
      SCOPED_TRACE(std::string(S::kName));
      SolverRequest request{{0, 0.3}, {}};
      for (int i = 0; i <= 50; ++i) request.heights.push_back(i / 50.0);
      const SolverResult result = solve<S>(scene, request, options);
      if (!promised.bounded && result.summary.status == Status::diverged) return;
      ASSERT_TRUE(result.summary.usable()) << result.summary.message;
      double largest = 1;
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < request.heights.size(); ++j) {
          const double z = request.heights[j], phi = result.phi(i, j);
          largest = std::max(largest, std::abs(phi));
          if (!promised.bounded) continue;
          // A cell may reach over a jump of c, and c varies inside it.
          double least = 1e300, most = -1e300;
          for (const double place : {z - 0.02, z, z + 0.02}) {
            const StateRange<double> range = scene.range_at(std::clamp(place, scene.bottom(), scene.top()));
            least = std::min(least, range.lowest);
            most = std::max(most, range.highest);
          }
          ASSERT_GE(phi, least - 1e-9 * largest) << "z " << z;
          ASSERT_LE(phi, most + 1e-9 * largest) << "z " << z;
          checked.count(std::string(S::kName) + " stays in range");
        }
      // M of the start, to the cells or the steps that stand for it.
      for (std::size_t j = 0; j < request.heights.size(); ++j) {
        const double M = scene.initial_amount(scene.bottom(), request.heights[j]);
        EXPECT_NEAR(result.M(0, j), M, promised.exact ? 1e-5 * largest : 0.02 * largest)
            << "z " << request.heights[j];
      }
      EXPECT_NEAR(result.M(0, 50), scene.mass(), 1e-12 * largest);
      if (promised.conservative && (scene.has_walls() || scene.spec().is_periodic)) {
        EXPECT_NEAR(result.M(1, 50), scene.mass(), 1e-12 * largest);
        checked.count(std::string(S::kName) + " keeps its mass");
      }
    });
  });
}

}  // namespace
}  // namespace shearfront
