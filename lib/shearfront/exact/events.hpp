// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront {

struct TimelineOptions {
  std::size_t layers =
      0;  ///< layers of the staircase for a smooth a without closed forms; 0: the default of ExactSolution
};

/// The event times of a scene with an empty refusal() (meaning of each: solution/timeline.hpp).
///
/// First arrivals are travel times in closed form, T(jump -> z) at the H of the state they run into, or the
/// root of "value of a path from elsewhere = value of the state at rest" when a shock comes first. Last
/// changes are the time at which M(z, t) reaches its final value min(z - bottom, m): found by Newton, M_t = H
/// being known, inside a bracket. The walls' own paths are kept out of that comparison, so that no equality
/// of rounded numbers decides.
///
/// Guarantees: a constant or linear in pieces, and exponential a: first arrivals to a few units in the last place of Scalar (times
/// the number of layers crossed), last changes to a few u (t + (top - bottom) / H), H the flux just before
/// the change, where what still has to pass is more than 64 u of the height (less is lost in the rounding of
/// M: the change before it is reported); other smooth a: order 3/2 in the layer height. Only jumps of a
/// layered scene are listed as interfaces. Errors: none. Cost: O((jumps + layers) * layers) for first
/// arrivals, some 20 queries per last change. Source: May, Shearer & Daniels (2010), Section 3, for two
/// layers.
template <Real Scalar>
[[nodiscard]] Timeline<Scalar> exact_timeline(const Scene<Scalar>& scene, TimelineOptions options = {});

extern template Timeline<double> exact_timeline<double>(const Scene<double>&, TimelineOptions);

}  // namespace shearfront
