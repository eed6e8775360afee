// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "shearfront/model/flux/all.hpp"

namespace shearfront::fv {

/// A flux f on [lo, hi] with any number of extrema, as the plain march sees it. f = f(lo) + rise + fall with
///
///   rise(x) = int_lo^x max(f', 0),   fall(x) = int_lo^x min(f', 0).
struct FluxBranches {
  double lo = 0, hi = 1;
  std::vector<double> turns;        ///< lo, the extrema, hi
  std::vector<double> turn_values;  ///< f there
  double largest_slope = 1;         ///< max |f'|
  bool is_minimum = true;           ///< of the extremum, if there is one
  bool vanishes = true;             ///< f(lo) == f(hi) == 0
  bool is_parabola = false;         ///< known beyond [lo, hi], too
  std::function<double(double)> value;

  [[nodiscard]] bool has_one_extremum() const { return turns.size() == 3; }
  [[nodiscard]] double extremum() const { return turns[1]; }
  /// Least and largest f between two states.
  struct Extent {
    double least, most;
  };
  [[nodiscard]] Extent extent(double a, double b) const;
  struct Parts {
    double rise, fall;
  };
  [[nodiscard]] Parts parts(double x) const;
};

[[nodiscard]] FluxBranches flux_branches(const Flux<double>& flux);

}  // namespace shearfront::fv
