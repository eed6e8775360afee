// SPDX-License-Identifier: BSD-3-Clause
// A solver refuses a scene if and only if its scope leaves it out.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "shearfront/solver/all.hpp"
#include "support/any_scene.hpp"

namespace shearfront {
namespace {

TEST(Scopes, TellWhichScenesAreRefused) {
  support::SceneMaker maker(support::seed_of(7501));
  int n_scenes = 0;
  while (n_scenes < 600) {
    SceneSpec<double> spec = support::any_scene(maker, 2);
    if (!find_complaints(spec).empty()) continue;
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
