// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"

/// Random beds whose rate varies smoothly in pieces: tables with throats, humps, flats and jumps, exponentials falling and rising,
/// chutes with a kink, one linear piece; initial states with pure parts, 1/2, and whatever lies between.
namespace shearfront::support {

inline DepthFunction<double> random_curved_rate(SceneMaker& maker) {
  const auto value = [&] { return std::exp(maker.uniform(std::log(0.2), std::log(4.0))); };
  switch (maker.integer(0, 4)) {
    case 0:
      return Exponential<double>{maker.uniform(0.5, 4), maker.uniform(0.15, 2)};
    case 1:
      return Chute<double>{maker.uniform(0.3, 2), maker.uniform(0.2, 2), maker.uniform(-0.3, 1.3)};
    case 2:
      return Table<double>{{0, 1}, {value(), value()}};
    default:
      break;
  }
  Table<double> table{{0}, {value()}};
  const int inner = maker.integer(1, 5);
  for (const double z : maker.heights(inner, 0, 1)) {
    const bool is_flat = maker.integer(0, 4) == 0;
    table.z.push_back(z);
    table.values.push_back(is_flat ? table.values.back() : value());
    if (maker.integer(0, 5) != 0) continue;
    table.z.push_back(z);  // a jump
    table.values.push_back(value());
  }
  table.z.push_back(1);
  table.values.push_back(value());
  return table;
}

inline SceneSpec<double> random_curved_spec(std::uint64_t seed) {
  SceneMaker maker(seed);
  SceneSpec<double> spec;
  spec.shear_rate = random_curved_rate(maker);
  spec.scale = std::exp(maker.uniform(-1, 1));
  if (maker.integer(0, 3) == 0) {
    spec.initial_breaks = maker.heights(1, 0, 1);
    spec.initial_values = {0, 1};
    return spec;
  }
  const int jumps = maker.integer(0, 4);
  spec.initial_breaks = maker.heights(jumps, 0, 1);
  if (const auto* table = std::get_if<Table<double>>(&spec.shear_rate); table && maker.integer(0, 4) == 0)
    for (double& z : spec.initial_breaks)  // on a kink
      if (table->z.size() > 2 && spec.initial_breaks.size() == 1) z = table->z[1];
  for (int i = 0; i <= jumps; ++i) {
    const int kind = maker.integer(0, 5);
    spec.initial_values.push_back(kind <= 1 ? kind : kind == 2 ? 0.5 : maker.uniform(0, 1));
  }
  return spec;
}

/// The same with another flux, convex or concave, and in half of them layers of the solid fraction.
inline SceneSpec<double> random_curved_flux_spec(std::uint64_t seed) {
  SceneMaker maker(seed);
  SceneSpec<double> spec = random_curved_spec(seed);
  switch (maker.integer(0, 2)) {
    case 0:
      spec.fluxes = {Cubic<double>{maker.uniform(0.01, 0.5)}};
      break;
    case 1:
      spec.fluxes = {LwrCubic<double>{maker.uniform(0.3, 1), maker.uniform(0.01, 0.5)}};
      break;
    default:  // its slope changes slowly, but not smoothly
      spec.fluxes = {FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.18, -0.24, -0.18, 0}}};
  }
  const Flux<double>& flux = spec.fluxes.front();
  for (double& value : spec.initial_values)
    value = value == 0.5 ? flux.extrema().front() : value * flux.range().highest;
  if (maker.integer(0, 1) == 0)
    spec.solid_fraction = Piecewise<double>{maker.heights(1, 0.1, 0.9), {maker.uniform(0.4, 0.7), 0.6}};
  return spec;
}

/// The same where pieces have to stand for the rate: a, c or T vary in another way than it can follow, or all of them; half of them with
/// two fluxes.
inline SceneSpec<double> random_smooth_spec(std::uint64_t seed) {
  SceneMaker maker(seed ^ 0x5eedULL);
  SceneSpec<double> spec = random_curved_spec(seed);
  const auto table = [&](double least, double most) {
    Table<double> points{{0}, {maker.uniform(least, most)}};
    for (const double z : maker.heights(maker.integer(0, 2), 0.1, 0.9)) {
      points.z.push_back(z);
      points.values.push_back(maker.uniform(least, most));
    }
    points.z.push_back(1);
    points.values.push_back(maker.uniform(least, most));
    return points;
  };
  const int what = maker.integer(0, 3);
  if (what == 0) {
    Kinetic<double> kinetic;
    kinetic.amplitude = maker.uniform(0.5, 2);
    kinetic.length = maker.uniform(0.3, 1);
    kinetic.load = maker.uniform(0.3, 1);
    kinetic.lid = 1.2;
    spec.shear_rate = kinetic;
  }
  if (what == 1 || what == 3) spec.temperature = table(0.5, 2);
  if (what == 2) spec.solid_fraction = Exponential<double>{0.6, maker.uniform(1, 4)};
  if (what == 3) spec.solid_fraction = table(0.4, 0.7);
  if (maker.integer(0, 1) == 0) return spec;
  spec.fluxes = {Cubic<double>{maker.uniform(0.01, 0.5)}, Quadratic<double>{}};
  if (maker.integer(0, 1) == 0) std::swap(spec.fluxes[0], spec.fluxes[1]);
  spec.flux_breaks = maker.heights(1, 0.1, 0.9);
  return spec;
}

/// Beds next to what a double can hold: rates over 20 decades, pieces 1e-12 high, rates that differ by 1e-15, states 1e-15 from
/// pure ones or from 1/2.
inline SceneSpec<double> hostile_curved_spec(std::uint64_t seed) {
  SceneMaker maker(seed);
  const auto decades = [&](double lo, double hi) { return std::pow(10.0, maker.uniform(lo, hi)); };
  SceneSpec<double> spec;
  const int shape = maker.integer(0, 5);
  if (shape == 0) {
    spec.shear_rate = Exponential<double>{decades(-3, 3), decades(-1.4, 13)};
  } else if (shape == 1) {
    spec.shear_rate = Chute<double>{decades(-3, 3), decades(-1.4, 13), maker.uniform(0, 1)};
  } else {
    const double range = maker.integer(0, 1) == 0 ? 10 : 1;
    Table<double> table{{0}, {decades(-range, range)}};
    const auto next = [&] {
      switch (maker.integer(0, 3)) {
        case 0:
          return table.values.back() * (1 + maker.integer(-20, 20) * 1e-16);
        case 1:
          return table.values.back() * (1 + maker.uniform(-1, 1) * decades(-14, 0) / 2);
        default:
          return decades(-range, range);
      }
    };
    for (const double z : maker.heights(maker.integer(1, 4), 0, 1)) {
      table.z.push_back(z);
      table.values.push_back(next());
      if (maker.integer(0, 2) != 0) continue;
      const double higher = z + (maker.integer(0, 2) == 0 ? 0 : decades(-13, -4));
      table.z.push_back(higher);
      table.values.push_back(next());
    }
    table.z.push_back(1);
    table.values.push_back(next());
    spec.shear_rate = table;
  }
  const int jumps = maker.integer(0, 3);
  spec.initial_breaks = maker.heights(jumps, 0, 1);
  for (int i = 0; i <= jumps; ++i) {
    const double little = decades(-16, -1) / 2, sign = maker.integer(0, 1) == 0 ? -1 : 1;
    const int kind = maker.integer(0, 5);
    spec.initial_values.push_back(kind == 0   ? 0
                                  : kind == 1 ? 1
                                  : kind == 2 ? little
                                  : kind == 3 ? 1 - little
                                  : kind == 4 ? 0.5 + sign * little * maker.integer(0, 1)
                                              : maker.uniform(0, 1));
  }
  return spec;
}

/// The same bed upside down, with large and small grains exchanged. Its rates are those of a table through the same values.
inline SceneSpec<double> turned_over(const SceneSpec<double>& spec) {
  SceneSpec<double> turned = spec;
  turned.initial_breaks.clear();
  turned.initial_values.clear();
  for (std::size_t i = spec.initial_breaks.size(); i-- > 0;)
    turned.initial_breaks.push_back(1 - spec.initial_breaks[i]);
  for (std::size_t i = spec.initial_values.size(); i-- > 0;)
    turned.initial_values.push_back(1 - spec.initial_values[i]);
  if (auto* chute = std::get_if<Chute<double>>(&turned.shear_rate)) chute->centre = 1 - chute->centre;
  if (const auto* falling = std::get_if<Exponential<double>>(&spec.shear_rate))
    turned.shear_rate = Chute<double>{falling->value(1), falling->decay, 0};  // rising from the bottom
  if (auto* table = std::get_if<Table<double>>(&turned.shear_rate)) {
    const auto& old = std::get<Table<double>>(spec.shear_rate);
    for (std::size_t i = 0; i < old.z.size(); ++i) {
      table->z[i] = 1 - old.z[old.z.size() - 1 - i];
      table->values[i] = old.values[old.z.size() - 1 - i];
    }
  }
  return turned;
}

}  // namespace shearfront::support
