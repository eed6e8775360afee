// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>

#include "shearfront/riemann/state.hpp"
#include "shearfront/track/front_list.hpp"

namespace shearfront {

/// A front between two levels, or a boundary (wall, jump or kink of the rate), which rests.
///
/// By Rankine and Hugoniot a front between the states l, r of levels i != j moves such that
///
///     dt/dz = 2 (s_r q_j(z) - s_l q_i(z)) / (h_i - h_j),   s = -1 or 1 for low and high states,
///
/// so its time is a closed form of its height. Since q_i - q_j over h_j - h_i is a mean of the 1 / (r q) / 2 of the levels
/// between, a front between neighbouring levels is the mean of the characteristics of these fluxes.
struct CurvedNode {
  double z = 0, t = 0;              ///< passes z at t
  double rate = 0;                  ///< r(z)
  double q_below = 0, q_above = 0;  ///< of its levels at z
  double end = 0;                   ///< height at which it ends or turns
  double end_t = 0;                 ///< when it turns there
  double meets = 0, meeting_z = 0;  ///< next event: when, and where
  double turned = kNever;           ///< when a mean characteristic of its levels turned there; kEarlier
  State below = 0, above = 0;
  FrontIndex prev = kNoFront, next = kNoFront;
  std::uint32_t layer = 0;  ///< piece of a front; of a boundary the piece above it
  std::uint32_t stamp = 0;
  std::int8_t direction = 0;  ///< 1 up, -1 down, 0 it stands
  bool turns = false;         ///< it turns at its end
  bool turns_next = false;    ///< its next event is that
  bool is_edge = false;       ///< the edge of a fan next to a state that was there before
  double edge_t = 0;          ///< of an edge: when the characteristic of that state was at z

  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kEarlier = -kNever;  ///< it did in an earlier part of a smooth rate
  /// At its next event.
  [[nodiscard]] double position(double /*time*/) const { return meeting_z; }
};

/// When a front is at a height, and dt/dz there.
struct Passage {
  double t, slope;
};

}  // namespace shearfront
