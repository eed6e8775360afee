// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/fit.hpp"

/// Identification problems: Examples 3 to 6 of Buerger, Martinez, Villada (2023), and exact data for them.
namespace shearfront::support {

struct Identification {
  std::string name;
  SceneSpec<double> truth;
  std::vector<std::string> parameters{"shear_rate.values"};
  std::vector<double> start, times, heights;
  bool is_exponential = false;

  /// Sum of |k - k_true|; for the exponential a(z) in k1 = amplitude decay and k2 = decay.
  [[nodiscard]] double error(const fit::Estimate& estimate) const {
    if (!estimate.usable()) return INFINITY;
    const auto at = [&](std::size_t i) { return estimate.parameters[i].estimate; };
    if (is_exponential) {
      const auto& a = std::get<Exponential<double>>(truth.shear_rate);
      return std::abs(at(0) * at(1) - a.amplitude * a.decay) + std::abs(at(1) - a.decay);
    }
    const auto& values = std::get<Piecewise<double>>(truth.shear_rate).values;
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += std::abs(at(i) - values[i]);
    return sum;
  }
};

/// first, first + step, ..., in numbers of two decimals.
inline std::vector<double> decimals(double first, double last, double step) {
  std::vector<double> all;
  for (int i = 0; first + i * step < last + step / 2; ++i)
    all.push_back(std::round((first + i * step) * 100) / 100);
  return all;
}

inline SceneSpec<double> half_filled(DepthFunction<double> rate) {
  SceneSpec<double> spec;
  spec.shear_rate = std::move(rate);
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}

inline Identification example_3() {
  return {"3",
          half_filled(Piecewise<double>{{0.29}, {3.15, 0.5}}),
          {"shear_rate.values"},
          {2.5, 0.7},
          decimals(0.5, 10, 0.5),
          decimals(0.01, 0.99, 0.01)};
}

inline Identification example_4() {
  return {"4",
          half_filled(Piecewise<double>{{0.2, 0.4, 0.6, 0.8}, {3.25, 2.32, 1.63, 1.05, 0.53}}),
          {"shear_rate.values"},
          {3.3, 2.5, 1.7, 1.1, 0.5},
          decimals(0.5, 10, 0.5),
          decimals(0.01, 0.99, 0.01)};
}

inline Identification example_5() {
  return {"5",
          half_filled(Exponential<double>{0.87 / 0.205, 0.205}),
          {"shear_rate.amplitude", "shear_rate.decay"},
          {1.0 / 0.2, 0.2},
          decimals(1, 10, 1),
          decimals(0.05, 0.95, 0.05),
          true};
}

inline Identification example_6() {
  Piecewise<double> a;
  a.breaks = decimals(0.1, 0.9, 0.1);
  for (int i = 1; i <= 10; ++i) a.values.push_back(0.87 / 0.205 * std::exp(-0.1 * i / 0.205));
  return {"6",
          half_filled(a),
          {"shear_rate.values"},
          {3, 2, 1, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1},
          decimals(1, 10, 1),
          decimals(0.05, 0.95, 0.05)};
}

/// What the exact solution shows at the times and heights; bins as wide as the first two heights are apart.
inline Observations exact_data(const Identification& problem, Quantity quantity) {
  const ExactSolution<double> solution{Scene<double>(problem.truth)};
  Observations data;
  data.quantity = quantity;
  const double width = problem.heights[1] - problem.heights[0];
  for (const double t : problem.times)
    for (const double z : problem.heights) {
      Observation o;
      o.t = t;
      o.z = z;
      if (quantity == Quantity::bin) {
        o.width = width;
        o.value = (solution.M(z + width / 2, t) - solution.M(z - width / 2, t)) / width;
      } else {
        o.value = quantity == Quantity::point ? solution.phi(z, t) : solution.M(z, t);
      }
      data.rows.push_back(o);
    }
  return data;
}

inline fit::FitSpec fit_of(const Identification& problem, Observations data) {
  fit::UnknownSpec unknown;
  unknown.parameters = problem.parameters;
  unknown.start = problem.start;
  return {problem.name, Scene<double>(problem.truth), std::move(data), unknown, {}, {}, {}, {}};
}

}  // namespace shearfront::support
