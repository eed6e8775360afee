// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/track/curved_start.hpp"
#include "shearfront/track/rate_piece.hpp"

namespace shearfront {

/// A scene with one parabola for a flux as u_t - (r(z) u (1 - u))_z = 0: phi = lowest + width u for a flux with a
/// minimum, highest - width u for one with a maximum.
struct CurvedScene {
  CurvedProblem problem;
  double bottom;
  double offset, slope;  ///< phi = offset + slope u

  [[nodiscard]] double phi_of(double u) const { return offset + slope * u; }
  /// int_bottom^z phi dz for int u dz.
  [[nodiscard]] double amount_of(double z, double amount) const {
    return offset * (z - bottom) + slope * amount;
  }
};

/// The scene if its rate varies and is constant, linear or exponential in pieces, as its models say, one parabola is its flux,
/// and c = 1; else nothing: then a staircase stands for it.
[[nodiscard]] std::optional<CurvedScene> curved_scene(const Scene<double>& scene);

}  // namespace shearfront
