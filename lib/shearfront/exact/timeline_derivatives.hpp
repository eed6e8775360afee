// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront {

/// Derivatives of the event times of an exact solution with respect to the entries of its scene.
///
/// At an event two families of paths are equally good at its height z. With [.] the change from before the event to after it,
/// dz the derivative of z (the break of an interface; the steady height for t*), and v the speed of characteristics,
///
///     a shock arrives:         M = M on both sides:      dt = -([dM] + [phi dz]) / [H],
///     the edge of a fan does:  phi = phi on both sides:  dt = -[dphi] / [d phi / dt] + dz / v,
///
/// dM and dphi from Derivatives, of paths on either side of the event, and what the bed ends with after the last one. Each side
/// is the limit of three times next to the event, 1e-5 of it apart, on paths of one family, by a parabola: dt is right to some
/// 1e-11 where dM and dphi are right to rounding, whatever the law.
///
/// None for a time that never comes, for entries of which Derivatives has none (their numbers mean nothing), and where the
/// paths next to the event are of several families, as where two events coincide. 0 for an event at t = 0. A pure state next
/// to a wall is taken to stay pure. Cost: some nine queries an event.
/// Precondition: `times` is exact_timeline(solution).
[[nodiscard]] TimelineDerivatives timeline_derivatives(const ExactSolution<double>& solution,
                                                       const Timeline<double>& times);

}  // namespace shearfront
