// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/riemann/state.hpp"
#include "shearfront/track/level_curves.hpp"

namespace shearfront {

/// Lines that stand for u(z), from the bottom up.
class Lines {
 public:
  explicit Lines(double bottom) : z_{bottom} {}

  [[nodiscard]] double end() const { return z_.back(); }
  /// A line from the end up to z; none if z is not above it.
  void add(double z, double at_end, double at_z) {
    if (!(z > z_.back())) return;
    z_.push_back(z);
    below_.push_back(at_end);
    above_.push_back(at_z);
  }
  /// The steady state of a level from the end up to z: lines no farther from it than `tolerance`, each of which holds what it
  /// does.
  void add_level(const LevelCurves& grid, std::size_t piece, State state, double z, double tolerance);

  /// The last line goes on to `top`, which rounding may have missed.
  void close(double top) { z_.back() = top; }
  [[nodiscard]] const std::vector<double>& ends() const { return z_; }
  [[nodiscard]] const std::vector<double>& below() const { return below_; }
  [[nodiscard]] const std::vector<double>& above() const { return above_; }

 private:
  std::vector<double> z_, below_, above_;
};

}  // namespace shearfront
