// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/track/curved_start.hpp"
#include "shearfront/track/flow_coordinate.hpp"
#include "shearfront/track/level_lines.hpp"

namespace shearfront {

/// A scene as u_t - (r g(u) / 4)_y = 0 in pieces, its time in a power of two of the scene's such that the largest rate is about 1:
/// products of rates neither overflow nor vanish, and nothing is rounded.
struct CurvedScene {
  CurvedProblem problem;
  FlowCoordinate heights;
  std::vector<std::size_t> flux_index;  ///< of the scene, per piece
  double time_unit = 1;                 ///< of the scene's time over that of the problem

  /// Of lines in y and u; each holds what it does in y.
  [[nodiscard]] Profile<double> profile_of(const Lines& lines) const;
};

/// Whether the rate s a c sqrt(T) of a scene varies, and its fluxes are all convex or all concave between zeros; else a staircase stands
/// for it.
[[nodiscard]] bool has_curved_fronts(const Scene<double>& scene);
/// Where the rate is constant, linear or exponential between knots, as the models say, these are the pieces. For any other rate curves
/// of these kinds through its values at the ends of layers, so thin that they leave it by less than R^2 / 2 of itself, R the
/// resolution; so does M then, by t times that. Precondition: has_curved_fronts().
[[nodiscard]] CurvedScene curved_scene(const Scene<double>& scene, double resolution);
/// About as many levels as it would have, times its pieces; without tables of its flux. Precondition: the same.
[[nodiscard]] double count_curved_entries(const Scene<double>& scene, double resolution);

}  // namespace shearfront
