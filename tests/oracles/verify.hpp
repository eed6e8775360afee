// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/interface.hpp"
#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// Checks everything a front-tracking solution promises at the current time; an empty result means that all
/// of it holds.
///
///   order       heights ascend from wall to wall (up to `position_slack`), fronts stay inside their layer
///   continuity  neighbours agree on the state between them
///   jump        every front moves with its Rankine-Hugoniot speed (up to `speed_slack` x the largest speed)
///   entropy     no state between the two of a front would split it: Oleinik's condition for the polygon
///   rest        flux is equal on both sides of every interface, and the two states are at rest (minimal jump)
///   walls       the flux next to both walls is 0
///
/// Cost: O(polygon vertices spanned by the fronts).
template <class AnyTracker>
[[nodiscard]] std::vector<std::string> verify(const AnyTracker& tracker,
                                              const typename AnyTracker::Scalar& position_slack,
                                              const typename AnyTracker::Scalar& speed_slack) {
  using Scalar = typename AnyTracker::Scalar;
  const auto& grid = tracker.grid();
  std::vector<std::string> violations;
  const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
  const auto complain = [&](const std::string& what, const Scalar& z) {
    violations.push_back(what + " at z = " + number_text(z) + ", t = " + number_text(tracker.time()));
  };
  const auto is_wall = [&](std::size_t end) { return !tracker.outside(end) && !tracker.is_periodic(); };
  Scalar last_z = grid.boundary(0);
  std::optional<State> state;
  tracker.for_each_node([&](bool is_boundary, const auto& node, const Scalar& z) {
    if (z < last_z - position_slack) complain("order: a front lies below the one before it", z);
    last_z = std::max(last_z, z);
    const std::size_t n_layers = grid.n_layers();
    const bool is_bottom = is_boundary && node.layer == 0, is_top = is_boundary && node.layer == n_layers;
    if (!is_bottom && state && node.below != *state)
      complain("continuity: neighbours disagree on the state", z);
    state = node.above;
    if (is_bottom) {
      if (is_wall(0) && grid.flux_rank(0, node.above) != grid.zero_flux_rank())
        complain("walls: flux through the bottom", z);
    } else if (is_top) {
      if (is_wall(1) && grid.flux_rank(n_layers - 1, node.below) != grid.zero_flux_rank())
        complain("walls: flux through the top", z);
    } else if (is_boundary) {
      const std::size_t below = node.layer - 1;
      if (grid.flux_rank(below, node.below) != grid.flux_rank(below + 1, node.above))
        complain("rest: flux jumps at an interface", z);
      if (solve_interface(grid, below, node.below, node.above) != StatePair{node.below, node.above})
        complain("rest: the states at an interface are not at rest", z);
    } else {
      const std::size_t k = node.layer;
      if (z < grid.boundary(k) - position_slack || z > grid.boundary(k + 1) + position_slack)
        complain("order: a front has left its layer", z);
      if (node.below == node.above) complain("jump: a front without a jump", z);
      const State last = grid.n_states(k) - 1;
      if (node.below < 0 || node.below > last || node.above < 0 || node.above > last) {
        complain("range: a state outside the grid", z);
        return;
      }
      const Scalar phi_l = grid.phi(k, node.below), phi_r = grid.phi(k, node.above);
      const Scalar flux_l = grid.flux(k, node.below), flux_r = grid.flux(k, node.above);
      const Scalar scale = std::max(size(node.speed), Scalar(size(flux_l) + size(flux_r)));
      if (size(node.speed * (phi_r - phi_l) - (flux_r - flux_l)) > speed_slack * scale)
        complain("jump: not the Rankine-Hugoniot speed", z);
      // Oleinik: the graph lies above the chord for l < r, below it for l > r; for a polygon, at its
      // vertices.
      const State upper = std::max(node.below, node.above);
      const Scalar side((node.below < node.above) != grid.is_reversed() ? 1 : -1);
      for (State i = grid.next_vertex(k, std::min(node.below, node.above)); i < upper;
           i = grid.next_vertex(k, i)) {
        const Scalar chord = flux_l + node.speed * (grid.phi(k, i) - phi_l);
        if (side * (grid.flux(k, i) - chord) < -speed_slack * scale) {
          complain("entropy: the front would split", z);
          break;
        }
      }
    }
  });
  return violations;
}

}  // namespace shearfront
