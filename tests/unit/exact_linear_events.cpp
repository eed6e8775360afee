// SPDX-License-Identifier: BSD-3-Clause
// Event times in beds that are linear in pieces: closed forms, the engine of constant layers, and more digits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"
#include "support/table_scenes.hpp"

namespace shearfront {
namespace {

using support::table_scene;

/// With 1 above 0 in one segment t* = (4 / |b|) artanh(|b| m / a(m)); from 1 to e with the jump at 1/2 it is 2 ln(1 / e) / (1 -
/// e), where the flux at the end is of the order of e.
TEST(LinearEvents, KeepTheirDigitsWhereTheFluxIsTiny) {
  for (const double least : {1e-2, 1e-5, 1e-8, 1e-11}) {
    const auto events = exact_timeline(Scene<double>(table_scene({{0, 1}, {1, least}}, {0.5}, {0, 1})));
    const double t = 2 * std::log(1 / least) / (1 - least);
    EXPECT_NEAR(*events.t_star, t, 2e-14 * t) << least;
  }
}

TEST(LinearEvents, ListTheKnots) {
  const auto events = exact_timeline(
      Scene<double>(table_scene({{0, 0.2, 0.4, 0.8, 1}, {2, 1, 1, 3, 0.5}}, {0.3, 0.9}, {0, 1, 0.4})));
  ASSERT_EQ(events.interfaces.size(), 3u);
  EXPECT_EQ(events.interfaces[0].z, 0.2);
  EXPECT_NEAR(*events.interfaces[0].first, 0.1, 1e-15);  // 0s below the jump: in the flat piece
  EXPECT_NEAR(*events.interfaces[1].first, 0.1, 1e-15);
  // int dz / a from 0.3 over 0.4, where the slope is 5.
  EXPECT_NEAR(*events.interfaces[2].first, 0.1 + std::log(3) / 5, 1e-15);
  // A state that is neither 0 nor 1 changes at once where a slopes.
  const auto mixed = exact_timeline(Scene<double>(table_scene({{0, 0.5, 1}, {2, 1, 1}}, {}, {0.4})));
  EXPECT_EQ(*mixed.interfaces[0].first, 0);
  // Nothing passes a height with only 1 below it.
  const auto still =
      exact_timeline(Scene<double>(table_scene({{0, 0.2, 1}, {2, 1, 3}}, {0.5, 0.7}, {1, 0, 1})));
  EXPECT_FALSE(still.interfaces[0].first.has_value());
}

/// Constant on both sides of its jumps, a table is a stack of layers.
TEST(LinearEvents, AreThoseOfLayers) {
  support::SceneMaker make(support::seed_of(7731));
  for (int n = 0; n < 60; ++n) {
    const int count = make.integer(2, 5);
    const auto order = make.order();
    auto spec = n % 2 == 0 ? make.step(count, order) : make.data(count, order, 4);
    const Scene<double> layered(spec);
    const auto layers = std::get<Piecewise<double>>(spec.shear_rate);
    Table<double> table{{layered.bottom()}, {layers.values.front()}};
    for (std::size_t i = 0; i < layers.breaks.size(); ++i)
      for (const std::size_t side : {i, i + 1}) {
        table.z.push_back(layers.breaks[i]);
        table.values.push_back(layers.values[side]);
      }
    table.z.push_back(layered.top());
    table.values.push_back(layers.values.back());
    spec.shear_rate = table;
    const auto expected = exact_timeline(layered), events = exact_timeline(Scene<double>(spec));
    EXPECT_NEAR(*events.t_star, *expected.t_star, 1e-11 * *expected.t_star) << "scene " << n;
    ASSERT_EQ(events.interfaces.size(), expected.interfaces.size());
    for (std::size_t i = 0; i < events.interfaces.size(); ++i) {
      const auto &a = events.interfaces[i], &b = expected.interfaces[i];
      const std::string where = "scene " + std::to_string(n) + " z " + std::to_string(a.z);
      ASSERT_EQ(a.first.has_value(), b.first.has_value()) << where;
      EXPECT_NEAR(a.first.value_or(-1), b.first.value_or(-1), 1e-9 * (1 + b.first.value_or(0))) << where;
      ASSERT_EQ(a.last.has_value(), b.last.has_value()) << where;
      EXPECT_NEAR(a.last.value_or(-1), b.last.value_or(-1), 1e-11 * (1 + b.last.value_or(0))) << where;
    }
  }
}

TEST(LinearEvents, AreThoseOfMoreDigits) {
  support::SceneMaker make(support::seed_of(7732));
  for (int n = 0; n < 12; ++n) {
    std::vector<double> z{0, make.uniform(0.1, 0.4), make.uniform(0.5, 0.9), 1}, a;
    for (int k = 0; k < 4; ++k) a.push_back(std::exp(make.uniform(-9, 1)));
    const Scene<double> scene(
        table_scene({z, a}, {make.uniform(0.2, 0.8)}, {make.uniform(0, 0.4), make.uniform(0.6, 1)}));
    const auto events = exact_timeline(scene);
    const auto precise = exact_timeline(scene_cast<Real110>(scene));
    EXPECT_NEAR(*events.t_star, to_double(*precise.t_star), 1e-12 * *events.t_star) << "scene " << n;
    for (std::size_t i = 0; i < events.interfaces.size(); ++i)
      EXPECT_NEAR(*events.interfaces[i].last, to_double(*precise.interfaces[i].last),
                  1e-12 * *events.interfaces[i].last)
          << "scene " << n << " knot " << i;
  }
}

}  // namespace
}  // namespace shearfront
