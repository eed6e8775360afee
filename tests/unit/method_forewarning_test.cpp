// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "shearfront/shearfront.hpp"

namespace shearfront {
namespace {

/// n layers whose rate falls from 4 to 0.4: every front of the fan may cross every layer above.
Scene<> falling_layers(std::size_t n) {
  SceneSpec<double> spec;
  Piecewise<double> rate;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) rate.breaks.push_back(static_cast<double>(i) / static_cast<double>(n));
    rate.values.push_back(4 - 3.6 * static_cast<double>(i) / static_cast<double>(n));
  }
  spec.shear_rate = rate;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<>(spec);
}

// A run of n^2 collisions ends as it must, but its user should know before.
TEST(MethodForewarning, SaysWhereFrontsMayCrossManyLayers) {
  const Method tracking("front-tracking");
  EXPECT_EQ(tracking.forewarning(falling_layers(2)), "");
  EXPECT_EQ(tracking.forewarning(falling_layers(500)), "");
  EXPECT_NE(tracking.forewarning(falling_layers(20'000)).find("collisions"), std::string::npos);
  EXPECT_EQ(Method("exact").forewarning(falling_layers(20'000)), "");
  // Nor of what does not begin: its own refusal says why.
  Method few = tracking;
  few.set("max-fronts", std::uint64_t{10});
  EXPECT_EQ(few.forewarning(falling_layers(20'000)), "");
}

}  // namespace
}  // namespace shearfront
