// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/flux_branches.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace shearfront::fv {

FluxBranches::Extent FluxBranches::extent(double a, double b) const {
  const double at_a = value(a), at_b = value(b);
  Extent extent{std::min(at_a, at_b), std::max(at_a, at_b)};
  for (std::size_t i = 1; i + 1 < turns.size(); ++i)
    if (std::min(a, b) < turns[i] && turns[i] < std::max(a, b)) {
      extent.least = std::min(extent.least, turn_values[i]);
      extent.most = std::max(extent.most, turn_values[i]);
    }
  return extent;
}

FluxBranches::Parts FluxBranches::parts(double x) const {
  Parts parts{0, 0};
  double last = turn_values[0];
  const auto go = [&](double to) {
    (to > last ? parts.rise : parts.fall) += to - last;
    last = to;
  };
  for (std::size_t i = 1; i + 1 < turns.size() && turns[i] < x; ++i) go(turn_values[i]);
  go(value(x));
  return parts;
}

FluxBranches flux_branches(const Flux<double>& flux) {
  constexpr int kSlopeSamples = 4096;  // both ends included, where a convex or concave f is steepest
  FluxBranches branches;
  std::visit(
      [&]<class Model>(const Model& model) {
        branches.lo = model.range().lowest;
        branches.hi = model.range().highest;
        branches.turns = model.extrema();
        branches.is_parabola = Model::kIsParabola;
        branches.value = [model](double x) { return model.value(x); };
        branches.largest_slope = 0;
        for (int i = 0; i <= kSlopeSamples; ++i) {
          const double x = branches.lo + (branches.hi - branches.lo) * i / kSlopeSamples;
          branches.largest_slope = std::max(branches.largest_slope, std::abs(model.derivative(x)));
        }
      },
      flux);
  branches.turns.insert(branches.turns.begin(), branches.lo);
  branches.turns.push_back(branches.hi);
  for (const double x : branches.turns) branches.turn_values.push_back(branches.value(x));
  branches.is_minimum = branches.turn_values[1] < branches.turn_values[0];
  branches.vanishes = branches.turn_values.front() == 0 && branches.turn_values.back() == 0;
  return branches;
}

}  // namespace shearfront::fv
