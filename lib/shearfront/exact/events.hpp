// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront {

/// The event times of a scene with an empty refusal() (meaning of each: solution/timeline.hpp).
///
/// First arrivals are travel times in closed form, T(jump -> z) at the H of the state they run into, or the
/// root of "value of a path from elsewhere = value of the state at rest" when a shock comes first. Last
/// changes are the time at which M(z, t) reaches its final value min(z - bottom, m): found by Newton, M_t = H
/// being known, inside a bracket. The walls' own paths are kept out of that comparison, so that no equality
/// of rounded numbers decides.
///
/// Guarantees: a constant, linear or exponential in pieces: first arrivals to a few units in the last place of Scalar (times
/// the number of pieces crossed), last changes to a few u (t + (top - bottom) / H), H the flux just before
/// the change, where what still has to pass is more than 64 u of the height (less is lost in the rounding of
/// M: the change before it is reported); where pieces stand for the scene, timeline_error() estimates what
/// they cost. Interfaces are the knots of a scene that is so in pieces: jumps, kinks of a table, the centre of a chute, where
/// a state that is neither 0 nor 1 changes at once. Errors: none. Cost: O((jumps + layers) * layers) for first
/// arrivals, some 20 queries per last change. Source: May, Shearer & Daniels (2010), Section 3, for two
/// layers.
template <Real Scalar>
[[nodiscard]] Timeline<Scalar> exact_timeline(const ExactSolution<Scalar>& solution);
template <Real Scalar>
[[nodiscard]] Timeline<Scalar> exact_timeline(const Scene<Scalar>& scene) {
  return exact_timeline(ExactSolution<Scalar>(scene));
}

/// How much `times`, which exact_timeline(solution) gave, change at most when half as many pieces or layers stand for the
/// scene; 0 where it is represented exactly.
template <Real Scalar>
[[nodiscard]] Scalar timeline_error(const ExactSolution<Scalar>& solution, const Timeline<Scalar>& times);

extern template Timeline<double> exact_timeline<double>(const ExactSolution<double>&);
extern template double timeline_error<double>(const ExactSolution<double>&, const Timeline<double>&);

}  // namespace shearfront
