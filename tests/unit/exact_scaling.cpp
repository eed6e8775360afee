// SPDX-License-Identifier: BSD-3-Clause
// The exact engine knows no units: heights times L and times times T, powers of two, odd ones as well, change exponents only.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/any_scene.hpp"
#include "support/scene_units.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

DepthFunction<double> smooth_rate(SceneMaker& maker) {
  const int kind = maker.integer(0, 3);
  if (kind == 0) return Exponential<double>{maker.uniform(0.3, 3), std::exp(maker.uniform(-3, 2))};
  if (kind == 1)
    return Chute<double>{maker.uniform(0.3, 3), std::exp(maker.uniform(-3, 2)), maker.uniform(0, 1)};
  Table<double> table{{0}, {}};
  for (const double z : maker.heights(maker.integer(0, 6), 0, 1)) table.z.push_back(z);
  table.z.push_back(1);
  for (std::size_t i = 0; i < table.z.size(); ++i) table.values.push_back(std::exp(maker.uniform(-3, 3)));
  return table;
}

/// Layers and smooth rates, most fluxes parabolas.
SceneSpec<double> scene_in(SceneMaker& maker) {
  SceneSpec<double> spec = support::any_scene(maker, 5);
  if (maker.integer(0, 3) > 0) spec.shear_rate = smooth_rate(maker);
  if (maker.integer(0, 2) > 0) {
    spec.fluxes = {Flux<double>(Quadratic<double>{})};
    spec.flux_breaks.clear();
    for (double& phi : spec.initial_values)
      phi = maker.integer(0, 2) == 0 ? maker.integer(0, 1) : maker.uniform(0, 0.3);
    if (maker.integer(0, 2) > 0) spec.solid_fraction.reset(), spec.temperature.reset();
  }
  spec.scale = std::exp(maker.uniform(-3, 3));
  return spec;
}

struct Units {
  double L, T;
};

void expect_same(const SceneSpec<double>& spec, const Units& units, SceneMaker& maker) {
  const double L = units.L, T = units.T;
  SCOPED_TRACE("L = " + std::to_string(L) + ", T = " + std::to_string(T));
  const SceneSpec<double> other = support::in_units(spec, L, T);
  const ExactSolution<double>::Options options{static_cast<std::size_t>(maker.integer(0, 1) * 16), 1e-3};
  const ExactSolution<double> plain(Scene<double>(spec), options), scaled(Scene<double>(other), options);
  ASSERT_EQ(plain.n_layers(), scaled.n_layers());
  const Derivatives<double> by(plain), scaled_by(scaled);
  const std::vector<Entry> all = entries(spec);
  const double pace = spec.scale * plain.scene().shear_rate_at(maker.uniform(0, 1));
  for (int i = 0; i < 12; ++i) {
    const double z = maker.uniform(0, 1), t = std::exp(maker.uniform(-4, 3)) / pace;
    SCOPED_TRACE("z = " + std::to_string(z) + ", t = " + std::to_string(t));
    const auto a = by.at(z, t), b = scaled_by.at(z * L, t * T);
    EXPECT_EQ(a.value.phi, b.value.phi);
    EXPECT_EQ(a.value.M * L, b.value.M);
    EXPECT_EQ(a.value.H * L / T, b.value.H);
    for (std::size_t n = 0; n < all.size(); ++n) {
      const double factor = support::unit_factor(all[n], L, T);
      EXPECT_EQ(a.M[n] * L / factor, b.M[n]) << all[n].name();
      EXPECT_EQ(a.phi[n] / factor, b.phi[n]) << all[n].name();
    }
  }
  const auto times = exact_timeline(plain), scaled_times = exact_timeline(scaled);
  const auto expect_time = [&](const std::optional<double>& a, const std::optional<double>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(*a * T, *b);
    }
  };
  expect_time(times.t0, scaled_times.t0);
  expect_time(times.t1, scaled_times.t1);
  expect_time(times.t_star, scaled_times.t_star);
  ASSERT_EQ(times.interfaces.size(), scaled_times.interfaces.size());
  for (std::size_t i = 0; i < times.interfaces.size(); ++i) {
    expect_time(times.interfaces[i].first, scaled_times.interfaces[i].first);
    expect_time(times.interfaces[i].last, scaled_times.interfaces[i].last);
  }
}

void check_scenes(std::uint64_t stream, int n) {
  SceneMaker maker(support::seed_of(stream));
  for (int number = 0; number < n;) {
    const SceneSpec<double> spec = scene_in(maker);
    if (!find_complaints(spec).empty() || !exact::refusal(Scene<double>(spec)).empty()) continue;
    SCOPED_TRACE("scene " + std::to_string(number++) + " of stream " + std::to_string(stream));
    const auto unit = [&] { return std::ldexp(1.0, 2 * maker.integer(-9, 9) + maker.integer(0, 1)); };
    expect_same(spec, {unit(), unit()}, maker);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(ExactScaling, PowersOfTwoChangeExponentsOnly) { check_scenes(5100, 40); }
TEST(SlowExactScaling, PowersOfTwoChangeExponentsOnlyInManyScenes) { check_scenes(5200, 2000); }

}  // namespace
}  // namespace shearfront
