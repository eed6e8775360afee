// SPDX-License-Identifier: BSD-3-Clause
// First waves at interfaces between flat pieces of a bed whose other pieces slope: before them M there grows as that of the states at rest, at every
// one of many times, and soon after them it does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// A table that jumps at 0.5 from one level piece to another, with states of the same flux beside it, slopes and states of all kinds
/// farther away.
SceneSpec<double> bed_with_a_rest(SceneMaker& make) {
  SceneSpec<double> spec;
  const double low = std::exp(make.uniform(-1, 1)), high = std::exp(make.uniform(-1, 1));
  const double from = make.uniform(0.1, 0.4), to = make.uniform(0.6, 0.9);
  const auto rate = [&] { return std::exp(make.uniform(-1.5, 1.5)); };
  spec.shear_rate = Table<double>{{0, from, 0.5, 0.5, to, 1}, {rate(), low, low, high, high, rate()}};
  // 4 H of both, less than either capacity; each on the branch whose waves go towards the interface or away from it.
  const double h = std::min(low, high) * make.uniform(0.1, 0.95);
  const auto state = [&](double r) {
    const double q = std::sqrt(1 - h / r);
    return make.integer(0, 1) == 0 ? (1 - q) / 2 : (1 + q) / 2;
  };
  spec.initial_breaks = {make.uniform(0.01, from), from, 0.5, to, make.uniform(to, 0.99)};
  spec.initial_values = {make.uniform(0, 1), make.uniform(0, 1), state(low),
                         state(high),        make.uniform(0, 1), make.uniform(0, 1)};
  if (make.integer(0, 1) == 0) {  // a state next to the rest that is almost the same
    spec.initial_values[1] = spec.initial_values[2] + make.uniform(-0.05, 0.05);
    spec.initial_values[4] = spec.initial_values[3] + make.uniform(-0.05, 0.05);
  }
  for (double& phi : spec.initial_values) phi = std::clamp(phi, 0.0, 1.0);
  return spec;
}

TEST(FirstShock, NothingChangesBeforeIt) {
  SceneMaker make(support::seed_of(5610));
  int n_later = 0;
  for (int n = 0; n < 60; ++n) {
    const SceneSpec<double> spec = bed_with_a_rest(make);
    const ExactSolution<double> solution{Scene<double>(spec)};
    const auto times = exact_timeline(solution);
    const auto at = std::find_if(times.interfaces.begin(), times.interfaces.end(),
                                 [](const auto& i) { return i.z == 0.5; });
    ASSERT_NE(at, times.interfaces.end());
    if (!at->first || *at->first == 0) continue;
    ++n_later;
    SCOPED_TRACE("bed " + std::to_string(n) + ", first wave at " + std::to_string(*at->first));
    const double start = solution.M(0.5, 0), H0 = solution.at(0.5, 1e-9 * *at->first).H;
    constexpr int kTimes = 1500;
    for (int i = 1; i < kTimes; ++i) {
      const double t = *at->first * i / kTimes;
      ASSERT_NEAR(solution.M(0.5, t), start + H0 * t, 1e-13) << t;
    }
    // Later M does, or phi on one side: where the other side limits the flux it stays for longer.
    double change = 0;
    for (const double later : {1.01, 1.1, 1.5, 2.0}) {
      const double t = *at->first * later, beside = 1e-7;
      change = std::max({change, std::abs(start + H0 * t - solution.M(0.5, t)),
                         std::abs(solution.phi(0.5 - beside, t) - spec.initial_values[2]),
                         std::abs(solution.phi(0.5 + beside, t) - spec.initial_values[3])});
    }
    EXPECT_GT(change, 1e-9);
  }
  EXPECT_GT(n_later, 10);
}

}  // namespace
}  // namespace shearfront
