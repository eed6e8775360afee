// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "support/random_scene.hpp"

namespace shearfront::support {

inline SceneSpec<double> bed_with(DepthFunction<double> rate, InitialState<double> start) {
  SceneSpec<double> spec;
  spec.shear_rate = std::move(rate);
  spec.initial_state = std::move(start);
  return spec;
}

inline TableInitial<double> table_start(std::vector<double> z, std::vector<double> values) {
  return {std::move(z), std::move(values)};
}

/// A start of any kind with states from `lowest` to `highest`: one of each model of the list, tables most often, with states at
/// both ends of the range and flats.
inline InitialState<double> random_start(SceneMaker& make, double lowest = 0, double highest = 1) {
  const auto state = [&] {
    const int kind = make.integer(0, 5);
    return kind == 0 ? lowest : kind == 1 ? highest : make.uniform(lowest, highest);
  };
  switch (make.integer(0, 4)) {
    case 0: {
      const double a = state(), b = state();
      return KinkInitial<double>{a, b, make.uniform(-0.1, 1.1), make.uniform(0.01, 0.3)};
    }
    case 1: {
      const double mean = make.uniform(lowest, highest), room = std::min(mean - lowest, highest - mean);
      return SineInitial<double>{mean, make.uniform(-room, room), make.uniform(0.2, 2), make.uniform(0, 1)};
    }
    default: {
      TableInitial<double> table;
      table.z = make.heights(make.integer(0, 8), 0, 1);
      table.z.insert(table.z.begin(), 0);
      table.z.push_back(1);
      for (std::size_t i = 0; i < table.z.size(); ++i)
        table.values.push_back(i > 0 && make.integer(0, 4) == 0 ? table.values.back() : state());
      return table;
    }
  }
}

/// A smooth start as n equal cells with its means, and how far M(z, t) can be off for it at any time: the largest difference of
/// M(z, 0), for the Lax-Hopf formula is a contraction of it.
struct CellStart {
  SceneSpec<double> spec;
  double M_bound = 0;
};
inline CellStart as_cells(SceneSpec<double> spec, int n) {
  CellStart result;
  const auto start = *std::exchange(spec.initial_state, std::nullopt);
  const double height = spec.top - spec.bottom;
  std::visit(
      [&](const auto& model) {
        for (int i = 0; i < n; ++i) {
          const double lo = spec.bottom + height * i / n,
                       hi = i + 1 == n ? spec.top : spec.bottom + height * (i + 1) / n;
          if (i > 0) spec.initial_breaks.push_back(lo);
          const double mean = std::clamp(model.integral(lo, hi) / (hi - lo), model.lowest(), model.highest());
          spec.initial_values.push_back(mean);
          double least = mean, most = mean;
          std::vector<double> places = model.knots(lo, hi);
          places.insert(places.end(), {lo, hi});
          for (const double z : places) {
            least = std::min(least, model.value(z));
            most = std::max(most, model.value(z));
          }
          // Of a deviation between two values with mean 0.
          result.M_bound = std::max(result.M_bound, (most - least) * (hi - lo) / 4);
        }
      },
      start);
  result.spec = std::move(spec);
  return result;
}

}  // namespace shearfront::support
