// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "shearfront/scene/scene.hpp"

/// Random scenes for property tests: seeds are fixed, and printed by the tests that fail. SHEARFRONT_SEED
/// shifts them all.
namespace shearfront::support {

inline std::uint64_t seed_of(std::uint64_t number) {
  const char* shift = std::getenv("SHEARFRONT_SEED");
  return number + (shift ? std::strtoull(shift, nullptr, 10) : 0);
}

class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed) : engine_(seed) {}

  double uniform(double lo, double hi) {
    // Not std::uniform_real_distribution: its numbers differ between standard libraries.
    return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int integer(int lo, int hi) {
    return lo + static_cast<int>(engine_() % static_cast<std::uint64_t>(hi - lo + 1));
  }

  /// `n` distinct heights inside (bottom, top), ascending, at least 1e-3 of the domain apart.
  std::vector<double> heights(int n, double bottom, double top) {
    std::vector<double> z;
    while (static_cast<int>(z.size()) < n) {
      const double x = uniform(bottom, top);
      if (std::all_of(z.begin(), z.end(),
                      [&](double y) { return std::abs(x - y) > 1e-3 * (top - bottom); }) &&
          x - bottom > 1e-3 * (top - bottom) && top - x > 1e-3 * (top - bottom))
        z.push_back(x);
    }
    std::sort(z.begin(), z.end());
    return z;
  }

  enum class Order { falling, rising, random };
  /// Layers with a in [0.1, 4].
  Piecewise<double> layers(int n, Order order, double bottom = 0, double top = 1) {
    Piecewise<double> a;
    a.breaks = heights(n - 1, bottom, top);
    for (int i = 0; i < n; ++i) a.values.push_back(std::exp(uniform(std::log(0.1), std::log(4.0))));
    if (order == Order::falling) std::sort(a.values.rbegin(), a.values.rend());
    if (order == Order::rising) std::sort(a.values.begin(), a.values.end());
    return a;
  }
  Order order() { return static_cast<Order>(integer(0, 2)); }

  /// Small grains above large ones, z0 random.
  SceneSpec<double> step(int n_layers, Order order) {
    SceneSpec<double> spec;
    spec.shear_rate = layers(n_layers, order);
    spec.initial_breaks = heights(1, 0.1, 0.9);
    spec.initial_values = {0, 1};
    return spec;
  }
  /// Random piecewise constant data with up to `max_jumps` jumps; every third value is 0 or 1.
  SceneSpec<double> data(int n_layers, Order order, int max_jumps) {
    SceneSpec<double> spec;
    spec.shear_rate = layers(n_layers, order);
    const int jumps = integer(0, max_jumps);
    spec.initial_breaks = heights(jumps, 0, 1);
    for (int i = 0; i <= jumps; ++i)
      spec.initial_values.push_back(integer(0, 2) == 0 ? double(integer(0, 1)) : uniform(0, 1));
    return spec;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace shearfront::support
