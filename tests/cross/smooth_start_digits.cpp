// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of smooth starts against differences in many digits, over every shear rate.
#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/digits/real110.hpp"
#include "support/scene_cast.hpp"
#include "support/start_differences.hpp"

namespace shearfront {
namespace {

using support::for_each_smooth_scene;
using support::SceneMaker;
using support::StartDifference;

/// In 110 digits, where a difference has twenty of its own.
TEST(SlowSmoothStartDerivatives, AreThoseOfDifferencesInManyDigits) {
  StartDifference<Real110> check{Real110("1e-20"), Real110("1e-18"), 4};
  for_each_smooth_scene(support::seed_of(5303), 1, [&](const SceneSpec<double>& spec, SceneMaker& make) {
    const Scene<Real110> scene = scene_cast<Real110>(Scene<double>(spec));
    const double t = std::exp(make.uniform(-4, -1)) / 2;
    check.compare(scene, Real110(make.uniform(0.1, 0.9)), Real110(t));
  });
  EXPECT_GT(check.compared, 30);
  EXPECT_GT(check.from_start, 10);
}

}  // namespace
}  // namespace shearfront
