// SPDX-License-Identifier: BSD-3-Clause
// A solver refuses a scene if and only if its scope leaves it out.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "shearfront/solver/all.hpp"
#include "support/packed_scene.hpp"

namespace shearfront {
namespace {

/// Any sample of any flux, alone or with another, with or without packing and temperature, any ends.
SceneSpec<double> any_scene(support::SceneMaker& maker) {
  std::vector<Flux<double>> fluxes;
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples()) fluxes.push_back(flux);
  });
  const auto draw = [&] {
    return fluxes[static_cast<std::size_t>(maker.integer(0, static_cast<int>(fluxes.size()) - 1))];
  };
  SceneSpec<double> spec;
  spec.fluxes = {draw()};
  spec.shear_rate = maker.layers(maker.integer(1, 2), maker.order());
  if (maker.integer(0, 3) == 0) {
    spec.fluxes.push_back(draw());
    spec.flux_breaks = {0.4};
  }
  if (maker.integer(0, 2) == 0) spec.packing = support::random_profile(maker, 0.3, 0.7);
  if (maker.integer(0, 2) == 0) spec.temperature = support::random_profile(maker, 0.5, 2);
  double lowest = -1e300, highest = 1e300;
  for (const auto& flux : spec.fluxes)
    std::visit(
        [&](const auto& f) {
          lowest = std::max(lowest, f.range().lowest);
          highest = std::min(highest, f.range().highest);
        },
        flux);
  const auto state = [&] { return lowest + (highest - lowest) * maker.uniform(0, 1); };
  spec.initial_breaks = {0.5};
  spec.initial_values = {state(), state()};
  const int ends = maker.integer(0, 3);
  spec.is_periodic = ends == 1;
  if (ends >= 2) spec.outside_bottom = OutsideState<double>{{}, {state()}};
  if (ends == 3) spec.outside_top = OutsideState<double>{{}, {state()}};
  return spec;
}

TEST(Scopes, TellWhichScenesAreRefused) {
  support::SceneMaker maker(support::seed_of(7501));
  int n_scenes = 0;
  while (n_scenes < 600) {
    SceneSpec<double> spec = any_scene(maker);
    if (!find_problems(spec).empty()) continue;
    SCOPED_TRACE("scene " + std::to_string(n_scenes++));
    const Scene<double> scene(std::move(spec));
    SolverList::for_each([&]<class S>() {
      SolverOptions options;
      options.resolution = 0.2;
      options.cells = 20;
      options.layers = 8;
      const SolverResult result = S::solve(scene, SolverRequest{{0.1}, {0.3}}, options);
      EXPECT_EQ(result.summary.status != Status::unsupported, S::guarantees().scope.covers(scene))
          << S::kName << " on " << std::visit([](const auto& f) { return f.kName; }, scene.fluxes()[0])
          << ": " << result.summary.message;
    });
  }
}

}  // namespace
}  // namespace shearfront
