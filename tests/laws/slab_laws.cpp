// SPDX-License-Identifier: BSD-3-Clause
// Laws of slabs phi(x, z, t): what a step may not change, and what it has to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/slab/rows.hpp"
#include "shearfront/slab/slab_march.hpp"
#include "support/slab_scenes.hpp"

namespace shearfront {
namespace {

using slab::Settings, slab::SlabMarch;

struct Kind {
  const char* name;
  SceneSpec<double> spec;
};
/// With and without diffusion, of both signs of u.
std::vector<Kind> kinds() {
  std::vector<Kind> all{{"the source", support::source_slab()}};
  SceneSpec<double> spec = support::source_slab();
  spec.diffusion.reset();
  spec.velocity = LinearVelocity<double>{-1, 2};
  all.push_back({"no diffusion, u of both signs", spec});
  spec.fluxes = {Cubic<double>{}};
  spec.shear_rate = Piecewise<double>{{0.3}, {1, 2}};
  all.push_back({"cubic flux, layers", spec});
  spec.diffusion = Diffusion<double>{};
  spec.diffusion->D = 0.02;
  spec.diffusion->follows_shear_rate = true;
  spec.slab->length = 2.5;
  all.push_back({"D that varies, long slab", spec});
  return all;
}

double sum(const std::vector<double>& xs) {
  double all = 0;
  for (const double x : xs) all += x;
  return all;
}
double largest_distance(const std::vector<double>& xs, const std::vector<double>& ys) {
  double most = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) most = std::max(most, std::abs(xs[i] - ys[i]));
  return most;
}
double l1_distance_of(const std::vector<double>& xs, const std::vector<double>& ys) {
  double all = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) all += std::abs(xs[i] - ys[i]);
  return all / static_cast<double>(xs.size());
}
constexpr Settings kGrid{24, 32, 0, 1};

TEST(SlabLaws, KeepsTheGrainsAndTheirRange) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Scene<double> scene(kind.spec);
    SlabMarch march(scene, kGrid);
    const double mass = sum(march.states());
    EXPECT_NEAR(mass / (24 * 32), scene.mass(), 1e-14);
    for (const double t : {0.05, 0.3, 1.0}) {
      ASSERT_EQ(march.advance_to(t), Status::ok);
      EXPECT_NEAR(sum(march.states()), mass, 1e-11 * mass);
      const auto [least, most] = std::minmax_element(march.states().begin(), march.states().end());
      EXPECT_GE(*least, -1e-12);
      EXPECT_LE(*most, 1 + 1e-12);
    }
  }
}

TEST(SlabLaws, AreTheSameForAnyNumberOfThreads) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Scene<double> scene(kind.spec);
    std::vector<double> first;
    for (const std::size_t threads : {1u, 2u, 4u}) {
      Settings settings = kGrid;
      settings.threads = threads;
      SlabMarch march(scene, settings);
      ASSERT_EQ(march.advance_to(0.1), Status::ok);
      if (first.empty()) first = march.states();
      EXPECT_EQ(march.states(), first);
    }
  }
}

TEST(SlabLaws, TranslationOfTheStartTranslatesTheSolution) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Scene<double> scene(kind.spec);
    SlabMarch here(scene, kGrid), there(scene, kGrid);
    const auto turned = [&](const std::vector<double>& states) {
      std::vector<double> moved = states;
      std::rotate(moved.begin(), moved.begin() + 5 * 24, moved.end());
      return moved;
    };
    there.set_states(turned(there.states()));
    ASSERT_EQ(here.advance_to(0.5), Status::ok);
    ASSERT_EQ(there.advance_to(0.5), Status::ok);
    EXPECT_LE(largest_distance(turned(here.states()), there.states()), 1e-14);
  }
}

TEST(SlabLaws, AStartThatDoesNotDependOnXGivesABed) {
  SceneSpec<double> spec = support::source_slab();
  spec.initial_block.reset();
  spec.initial_breaks = {0.3, 0.7};
  spec.initial_values = {0.9, 0.2, 0.6};
  const Scene<double> scene(spec);
  SlabMarch march(scene, {24, 16, 0.01, 1});
  ASSERT_EQ(march.advance_to(0.4), Status::ok);
  diffusion::Options options;
  options.dt = 0.01, options.scheme = diffusion::Scheme::raised, options.smoothed_steps = 0;
  options.iteration_tolerance = 1e-14;
  diffusion::CrankNicolson bed(diffusion::problem_of(scene, 24), options);
  std::vector<diffusion::TimeStep> steps(41, {0.01, 0.5});
  steps.front().length = steps.back().length = 0.005;
  ASSERT_EQ(bed.repeat(steps), Status::ok);
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t j = 0; j < 24; ++j) {
      EXPECT_EQ(march.states()[i * 24 + j], march.states()[j]);
      EXPECT_NEAR(march.states()[i * 24 + j], bed.states()[j], 1e-13);
    }
}

TEST(SlabLaws, WithoutSegregationAWaveIsCarriedAndFades) {
  // s -> 0: every row is q_t + u q_x = D q_xx (and D q_zz, small for smooth rows of equal u).
  SceneSpec<double> spec = support::source_slab();
  spec.scale = 1e-200;
  spec.velocity = UniformVelocity<double>{1.7};
  spec.initial_block.reset();
  spec.initial_breaks = {}, spec.initial_values = {0.5};
  const Scene<double> scene(spec);
  double last = 0;
  for (const std::size_t n : {16u, 32u, 64u}) {
    SlabMarch march(scene, {4, n, 0.64 / static_cast<double>(n * n), 1});
    constexpr double kWave = 2 * std::numbers::pi;
    const auto wave = [&](double x, double fade) { return 0.5 + 0.4 * fade * std::sin(kWave * x); };
    std::vector<double> states;
    for (std::size_t i = 0; i < n; ++i)
      states.insert(states.end(), 4, wave((static_cast<double>(i) + 0.5) / static_cast<double>(n), 1));
    march.set_states(states);
    ASSERT_EQ(march.advance_to(0.4), Status::ok);
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i)
      worst += std::abs(march.states()[4 * i] -
                        wave((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.68,
                             std::exp(-0.01 * kWave * kWave * 0.4))) /
               static_cast<double>(n);
    EXPECT_LT(worst, 0.02);
    if (last > 0) {
      EXPECT_LT(worst, 0.35 * last);  // second order, in L1
    }
    last = worst;
  }
}

TEST(SlabLaws, MovesSolutionsNoFartherApart) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    if (!kind.spec.diffusion) continue;  // MUSCL promises no contraction
    const Scene<double> scene(kind.spec);
    std::mt19937 random(7);
    SlabMarch one(scene, kGrid), other(scene, kGrid);
    std::vector<double> states = one.states();
    for (double& phi : states) phi = std::uniform_real_distribution<double>(0, 1)(random);
    other.set_states(states);
    double last = l1_distance_of(one.states(), states);
    for (int k = 1; k <= 20; ++k) {
      ASSERT_EQ(one.advance_to(0.05 * k), Status::ok);
      ASSERT_EQ(other.advance_to(0.05 * k), Status::ok);
      const double now = l1_distance_of(one.states(), other.states());
      EXPECT_LE(now, last + 1e-12);
      last = now;
    }
  }
}

TEST(SlabRows, WholePeriodsReturnTheRow) {
  std::mt19937 random(1);
  constexpr std::size_t kN = 17, kRows = 3;
  std::vector<double> states(kN * kRows);
  for (double& q : states) q = std::uniform_real_distribution<double>(0, 1)(random);
  std::vector<double> moved = states;
  const slab::Rows rows(kN, {17, -34, 0}, {0, 0, 0});
  rows.advance(moved.data(), kRows, 0, kRows);
  EXPECT_EQ(moved, states);
}

TEST(SlabRows, KeepTheirAmountAndMakeNoExtrema) {
  std::mt19937 random(2);
  constexpr std::size_t kN = 40;
  for (const double shift : {0.3, 0.999, -0.4, 7.5, -123.25})
    for (const double diffusion : {0.0, 0.2, 0.9, 4.0}) {
      std::vector<double> q(kN);
      for (double& x : q) x = std::uniform_real_distribution<double>(0, 1)(random);
      const auto [least, most] = std::minmax_element(q.begin(), q.end());
      const double low = *least, high = *most, amount = sum(q);
      const slab::Rows rows(kN, {shift}, {diffusion});
      rows.advance(q.data(), 1, 0, 1);
      EXPECT_NEAR(sum(q), amount, 1e-13 * amount);
      EXPECT_GE(*std::min_element(q.begin(), q.end()), low - 1e-15);
      EXPECT_LE(*std::max_element(q.begin(), q.end()), high + 1e-15);
    }
}

TEST(SlabRows, CarryLinesExactlyBetweenTheirEnds) {
  constexpr std::size_t kN = 64;
  std::vector<double> q(kN);
  for (std::size_t i = 0; i < kN; ++i)
    q[i] = i < 48 ? static_cast<double>(i) / 64 : 0.75 - 3 * static_cast<double>(i - 48) / 64;
  const slab::Rows rows(kN, {0.375}, {0});
  rows.advance(q.data(), 1, 0, 1);
  for (std::size_t i = 3; i < 46; ++i) EXPECT_NEAR(q[i], (static_cast<double>(i) - 0.375) / 64, 1e-15);
}

}  // namespace
}  // namespace shearfront
