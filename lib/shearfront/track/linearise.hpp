// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/scene/entries.hpp"
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/track.hpp"

/// Derivatives of front tracking with respect to the entries of a scene, carried by the fronts (track/front_tangents.hpp).
///
/// What is differentiated is the run itself: the exact solution for fluxes made polygons, with the number of levels and the order of
/// events as they are, and the states of the grid where its rule puts them (track/state_motion.hpp). So derivatives are those of the
/// numbers that the run returns, exact to rounding, and not those of the solution that these are near to; the two come
/// together as the resolution becomes finer, M faster than phi.
///
/// Guaranteed: samples are to the bit those of a run with the same options. Between walls M at the top moves as the mass does.
/// Not guaranteed: a derivative where there is none. At a front phi jumps, and the derivative of phi is that of the side whose value is
/// returned; M has a kink there. Where an infinitely small step changes the order of events (three fronts in a point, fronts that meet
/// a boundary together, or where the state outside changes) or tears states that are one in the grid apart (two entries equal, a state
/// at an extremum), the derivative is that of a scene whose numbers differ by some 1e-9 (torn states) or holds to one side at most
/// (events), and Summary::remark says so. Steps that make a level appear or vanish are beyond any derivative.
///
/// How far that is: Linearisation::order_holds, per entry in its unit, and Linearisation::order (track/event_order.hpp). With g > 0 a gap
/// that must not close and dg its derivative, moving an entry down holds for min g / dg over dg > 0, up for min g / -dg over dg < 0, of
///   (1) the gap between what meets in an event, at the birth of each of them, and at the event before at the same boundary;
///   (2) the gap between an event and a neighbour that was coming closer and does so no more: it would have met one of these fronts;
///   (3) the widths of layers and of initial pieces that fronts begin from;
///   (4) the gaps in phi and in flux between a state that has a front and the next states of the grid: a front of no strength is born
///       where one closes. Beside an extremum phi or flux is square in the other, and what is said is half of the step at worst.
/// In none are levels that appear by the rule of the grid, and, where a flux has inflections or kinks, a state that comes to lie on the
/// hull of a front which passed over it: these change Linearisation::order only. Nor are the places: an event that comes to lie before
/// the last of them changes the order, and a front that passes one bends M there. Beyond a step M need not bend: fronts of a layer that
/// become one are moved as their mass is, whichever of them meet first. Where events coincide (Summary::remark) all steps are 0.
/// Errors: none; a run that does not come to its end says why in its summary.
/// Cost: that of a run, for each event as much again for some eight entries (of which a sixth is for the order), for each entry a pass over the states of all layers, and of
/// the linear reconstruction a microsecond per front, time and eight entries. Beds of more than 64 layers are refused: differences
/// cost less there.
namespace shearfront {

/// Why there are no derivatives with respect to an entry, in one clause; empty if there are.
[[nodiscard]] std::string tracking_derivative_refusal(const Scene<double>& scene, const TrackOptions& options,
                                                      const Entry& entry);

/// Samples at the places, and derivatives with respect to entries(scene.spec())[i], i of `wanted`. Preconditions:
/// Tracking::refusal() is empty, and tracking_derivative_refusal() of all wanted.
[[nodiscard]] Linearisation linearise_tracking(const Scene<double>& scene, const TrackOptions& options,
                                               const std::vector<Place>& places,
                                               const std::vector<std::size_t>& wanted,
                                               const Progress& progress = {});

}  // namespace shearfront
