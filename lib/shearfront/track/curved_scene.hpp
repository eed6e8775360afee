// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/track/curved_start.hpp"
#include "shearfront/track/level_lines.hpp"
#include "shearfront/track/rate_piece.hpp"

namespace shearfront {

/// Heights z of a bed whose solid fraction c is constant in layers, as y = int c dz: in y the equation is that of c = 1, its rate
/// times c. Without layers y is z.
class SolidHeights {
 public:
  SolidHeights() = default;
  /// Layers between `ends`, ascending, from the bottom to the top of the bed.
  SolidHeights(std::vector<double> ends, std::vector<double> fractions);

  [[nodiscard]] double y_of(double z) const;
  [[nodiscard]] double z_of(double y) const;
  /// c at y; on an interface above it.
  [[nodiscard]] double fraction(double y) const;

 private:
  [[nodiscard]] static std::size_t layer_of(const std::vector<double>& ends, double height);

  std::vector<double> z_, y_, c_;
};

/// A scene with one flux as u_t - (r g(u) / 4)_y = 0: phi / c = lowest + width u for a flux with a minimum, highest - width u for
/// one with a maximum; g = 4 u (1 - u) or that of FluxBranches.
struct CurvedScene {
  CurvedProblem problem;
  SolidHeights heights;
  double bottom;         ///< as y
  double offset, slope;  ///< phi / c = offset + slope u

  [[nodiscard]] double share_of(double u) const { return offset + slope * u; }
  [[nodiscard]] double phi_of(double y, double u) const { return heights.fraction(y) * share_of(u); }
  /// int phi dz from the bottom up to y for int u dy.
  [[nodiscard]] double amount_of(double y, double amount) const {
    return offset * (y - bottom) + slope * amount;
  }
  /// Of lines in y and u.
  [[nodiscard]] Profile<double> profile_of(const Lines& lines) const;
};

/// Whether the rate of a scene varies and is constant, linear or exponential in pieces, as its models say, its one flux is convex
/// or concave between zeros and nowhere straight, and c and T are constant in layers; else a staircase stands for it.
[[nodiscard]] bool has_curved_fronts(const Scene<double>& scene);
/// Precondition: has_curved_fronts().
[[nodiscard]] CurvedScene curved_scene(const Scene<double>& scene);
/// About as many levels as it would have; without tables of its flux. Precondition: the same.
[[nodiscard]] double count_curved_levels(const Scene<double>& scene, double resolution);

}  // namespace shearfront
