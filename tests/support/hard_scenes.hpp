// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

/// Scenes that are hard for a computer, by name: what the stability table and the tests of hard cases run.
namespace shearfront::support {

[[nodiscard]] inline Scene<double> layered_scene(std::vector<double> breaks, std::vector<double> rates,
                                                 std::vector<double> jumps, std::vector<double> values,
                                                 double scale = 1) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{std::move(breaks), std::move(rates)};
  spec.scale = scale;
  spec.initial_breaks = std::move(jumps);
  spec.initial_values = std::move(values);
  return Scene<double>(std::move(spec));
}

/// The shear cell of May et al. (2010) with another time scale.
[[nodiscard]] inline Scene<double> shear_cell(double scale = 1) {
  return layered_scene({0.29}, {2.4, 0.31}, {0.5}, {0, 1}, scale);
}

/// `n` layers of equal height with random rates, small grains above large ones inside one of them.
[[nodiscard]] inline Scene<double> many_layers(int n, std::uint64_t seed) {
  SceneMaker maker(seed_of(seed));
  Piecewise<double> a;
  for (int i = 0; i < n; ++i) {
    if (i > 0) a.breaks.push_back(static_cast<double>(i) / n);
    a.values.push_back(std::exp(maker.uniform(-1, 1)));
  }
  return layered_scene(a.breaks, a.values, {0.45678}, {0, 1});
}

/// The shear cell with `n` random initial states.
[[nodiscard]] inline Scene<double> many_jumps(int n, std::uint64_t seed) {
  SceneMaker maker(seed_of(seed));
  std::vector<double> jumps, values;
  for (int i = 0; i < n; ++i) {
    if (i > 0) jumps.push_back(static_cast<double>(i) / n);
    values.push_back(maker.uniform(0, 1));
  }
  return layered_scene({0.29}, {2.4, 0.31}, jumps, values);
}

/// `n` equal cells 0 | 1 | 0 | 1 ... in one layer: all of them do the same at the same time.
[[nodiscard]] inline Scene<double> equal_cells(int n) {
  std::vector<double> jumps, values;
  for (int i = 0; i < n; ++i) {
    if (i > 0) jumps.push_back(static_cast<double>(i) / n);
    values.push_back(i % 2);
  }
  return layered_scene({}, {1}, jumps, values);
}

/// A bed 1e-6 high whose rates s a are denormal numbers: its times are of the order 1e304.
[[nodiscard]] inline Scene<double> denormal_scene() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.3e-6}, {2, 1}};
  spec.scale = 1e-310;
  spec.initial_breaks = {0.5e-6};
  spec.initial_values = {0, 1};
  spec.top = 1e-6;
  return Scene<double>(std::move(spec));
}

/// Two fronts with a relative speed of about 1e-15 that meet at a time of order 0.1: a shock behind the one
/// step of a fan whose far side has nearly the shock's own state. Resolution 1 keeps the step in one piece.
[[nodiscard]] inline Scene<double> nearly_parallel_fronts() {
  const double z = 0.4, state = 0.7;
  double behind = state;
  for (int i = 0; i < 9; ++i) behind = std::nextafter(behind, 1.0);
  return layered_scene({}, {0.83}, {z, std::nextafter(z, 1.0)}, {behind, 0.45, state});
}

/// Random scene number `number`: even ones a step, odd ones up to 20 jumps; 1 to 8 layers.
[[nodiscard]] inline Scene<double> random_scene(std::uint64_t number) {
  SceneMaker maker(seed_of(number));
  const int n_layers = maker.integer(1, 8);
  const auto order = maker.order();
  return Scene<double>(number % 2 == 0 ? maker.step(n_layers, order) : maker.data(n_layers, order, 20));
}

/// The scene in 50 digits with every number moved by up to the rounding of a double (2^-53 of itself, or half
/// the least denormal number), equal numbers alike. Pure states stay pure: one kind of grain is not a rounded
/// number.
[[nodiscard]] inline Scene<Real110> perturbed(const Scene<double>& scene, std::uint64_t seed) {
  SceneMaker maker(seed);
  SceneSpec<Real110> spec = scene_cast<Real110>(scene).spec();
  std::map<Real110, Real110> moved;
  const auto move = [&](Real110& x) {
    const auto [entry, is_new] = moved.try_emplace(x, x);
    if (is_new)
      entry->second +=
          Real110(maker.uniform(-1, 1)) * std::max(Real110(x * Real110(0x1p-53)), Real110(0x1p-1074) / 2);
    x = entry->second;
  };
  if (auto* layers = std::get_if<Piecewise<Real110>>(&spec.shear_rate)) {
    for (Real110& x : layers->breaks) move(x);
    for (Real110& x : layers->values) move(x);
  } else if (auto* smooth = std::get_if<Exponential<Real110>>(&spec.shear_rate)) {
    move(smooth->amplitude);
    move(smooth->decay);
  }
  move(spec.scale);
  for (Real110& x : spec.initial_breaks) move(x);
  for (Real110& x : spec.initial_values)
    if (x > 0 && x < 1) move(x);
  return Scene<Real110>(std::move(spec));
}

/// A scene to be tracked at a resolution, with times to look at it.
struct HardCase {
  std::string name;
  Scene<double> scene;
  double resolution;
  std::vector<double> times;
  int n_moves = 4;            ///< how often its numbers are moved, to see what that changes
  double rounding = 0x1p-53;  ///< of the numbers it is computed with
};

[[nodiscard]] inline std::vector<HardCase> hard_cases() {
  const double z_c = 0.29, next = std::nextafter(z_c, 1.0), before = std::nextafter(z_c, 0.0);
  const std::vector<double> one{0.5}, late{1.3e-12, 1.3e-3, 0.77, 1.7e3};
  std::vector<HardCase> cases{
      {"shear cell of May et al. (2010)", shear_cell(), 0.01, {0.5, 6}},
      {"contrast 1e12, fast layer below", layered_scene({z_c}, {1e12, 1}, one, {0, 1}), 0.01, late},
      {"contrast 1e12, fast layer above", layered_scene({z_c}, {1, 1e12}, one, {0, 1}), 0.01, late},
      {"contrast 1e12, slow layer between", layered_scene({z_c, 0.6}, {1e6, 1e-6, 1e6}, one, {0, 1}), 0.01,
       late},
      {"layer of width 1e-12, fast",
       layered_scene({0.3, 0.3 + 1e-12}, {1, 3, 1}, one, {0, 1}),
       0.01,
       {0.1, 1}},
      {"layer of width 1e-12, slow",
       layered_scene({0.3, 0.3 + 1e-12}, {1, 0.2, 1}, one, {0, 1}),
       0.01,
       {0.1, 1}},
      {"layer one ulp high",
       layered_scene({0.3, std::nextafter(0.3, 1.0)}, {1, 0.2, 1}, one, {0, 1}),
       0.05,
       {1}},
      {"jump one ulp below an interface",
       layered_scene({z_c}, {2.4, 0.31}, {before}, {0, 1}),
       0.01,
       {0.3, 2}},
      {"jump one ulp above an interface", layered_scene({z_c}, {2.4, 0.31}, {next}, {0, 1}), 0.01, {0.3, 2}},
      {"jump one ulp below the top",
       layered_scene({z_c}, {2.4, 0.31}, {std::nextafter(1.0, 0.0)}, {0, 1}),
       0.01,
       {0.3, 2}},
      {"s = 1e-300", shear_cell(1e-300), 0.01, {0.5e300, 6e300}},
      {"s = 1e300", shear_cell(1e300), 0.01, {0.5e-300, 6e-300}},
      {"s = 7e307", shear_cell(7e307), 0.01, {0.5 / 7e307, 6 / 7e307}},
      {"denormal s a = 1e-310, bed 1e-6 high", denormal_scene(), 0.01, {1e303, 1e304}, 4, 2e-13},
      {"t* = 2e15", layered_scene({}, {1e-15}, one, {0, 1}), 0.01, {1e14, 1e15}},
      {"t* = 1e15, one layer of two", layered_scene({0.3}, {1, 1e-15}, one, {0, 1}), 0.01, {1e14, 1e15}},
      {"rates one ulp apart",
       layered_scene({0.3, 0.7}, {0.8, std::nextafter(0.8, 1.0), 0.8}, {0.4}, {0, 1}),
       0.01,
       {0.2, 0.9}},
      {"flux levels 1e-16 and 1e-15 apart",
       layered_scene({0.5}, {1, 2}, {0.2, 0.4, 0.6, 0.8}, {0.3, 0.7, 0.3 + 1e-15, 0.7, 0.3}),
       0.013,
       {0.1, 0.9}},
      {"states 1e-15 from 1/2",
       layered_scene({z_c}, {2.4, 0.31}, {0.4, 0.7}, {0.5 + 1e-15, 0.5, 0.5 - 1e-15}),
       0.01,
       {0.1, 1, 4}},
      {"traces, phi = 1e-15", layered_scene({z_c}, {2.4, 0.31}, {}, {1e-15}), 0.01, {0.1, 1}},
      {"traces, phi = 1e-300", layered_scene({z_c}, {2.4, 0.31}, {}, {1e-300}), 0.01, {0.1, 1}},
      {"relative speed 1e-15, fan and shock", nearly_parallel_fronts(), 1, {0.01, 0.03, 1}},
      {"relative speed 1e-15, weak shocks",
       layered_scene({}, {1}, {0.4, std::nextafter(0.4, 1.0)}, {0.3 + 2e-15, 0.3 + 1e-15, 0.3}),
       0.09,
       {0.01, 1}},
      {"1024 cells, collisions at bitwise equal times", equal_cells(1024), 0.05, {0.0001, 0.2}, 1},
      {"1000 cells, collisions at equal times up to rounding", equal_cells(1000), 0.05, {0.0001, 0.2}, 1},
      {"1000 random layers", many_layers(1000, 11), 0.1, {0.03}, 1},
  };
  return cases;
}

/// Those that take seconds to minutes in 50 digits.
[[nodiscard]] inline std::vector<HardCase> slow_hard_cases() {
  return {
      {"10000 random layers", many_layers(10000, 12), 0.25, {0.03}, 1},
      {"resolution 1e-6", shear_cell(), 1e-6, {0.5, 6}, 1},
      {"1e6 jumps", many_jumps(1000000, 13), 0.1, {1e-4}, 1},
  };
}

}  // namespace shearfront::support
