// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Index of a state in the grid of its layer; phi increases strictly with the index. Riemann problems are
/// decided on these integers, so rounding can never change which waves come out of one.
using State = std::int32_t;

/// States on both sides of a resting discontinuity (interface or wall).
struct StatePair {
  State below, above;
  friend bool operator==(const StatePair&, const StatePair&) = default;
};

/// How a polygon bends between two states.
enum class Bend { convex, concave, mixed };

/// The discretised problem: in every layer a continuous piecewise linear flux through the states of a grid.
///
///   phi(k, i)        concentration of state i in layer k, increasing in i unless is_reversed()
///   flux(k, i)       flux of state i; equal flux_rank <=> equal flux
///   flux_rank(k, i)  integer that orders fluxes over all layers, increasing with the flux
///   zero_flux_rank() rank of flux 0, the flux through a wall
///   speed(k, l, r)   Rankine-Hugoniot speed of the front l | r, l != r
///   fastest()        a bound for |speed|
///   next_vertex(k, i), previous_vertex(k, i)  nearest vertex of the polygon above and below state i
///   is_reversed()    phi falls with the state index, and flux_rank orders fluxes downwards: a problem with
///                    maxima told as one with minima
///   bend(k, lo, hi)  how the polygon bends between the states lo < hi, in the orientation of the indices
///   run_end(k, i, b) the last state up to which the polygon bends like b (convex or concave) from i on; at
///                    least the next vertex
/// The flux of every layer has one minimum (in that orientation):
///   bottom_state(k)  the state of least flux: fluxes fall up to it and rise after it
///   falling_state(k, rank), rising_state(k, rank)  the state with this flux below and above it
/// A grid of other fluxes has none of the last three, and brings the functions of interface.hpp for itself.
template <class G>
concept StateGrid = requires(const G& g, std::size_t k, State i) {
  typename G::Scalar;
  { g.is_reversed() } -> std::convertible_to<bool>;
  { g.bend(k, i, i) } -> std::same_as<Bend>;
  { g.run_end(k, i, Bend::convex) } -> std::convertible_to<State>;
  { g.n_layers() } -> std::convertible_to<std::size_t>;
  { g.n_states(k) } -> std::convertible_to<State>;
  { g.boundary(k) } -> std::convertible_to<typename G::Scalar>;
  { g.phi(k, i) } -> std::convertible_to<typename G::Scalar>;
  { g.flux(k, i) } -> std::convertible_to<typename G::Scalar>;
  { g.flux_rank(k, i) } -> std::convertible_to<State>;
  { g.zero_flux_rank() } -> std::convertible_to<State>;
  { g.speed(k, i, i) } -> std::convertible_to<typename G::Scalar>;
  { g.fastest() } -> std::convertible_to<typename G::Scalar>;
  { g.next_vertex(k, i) } -> std::convertible_to<State>;
  { g.previous_vertex(k, i) } -> std::convertible_to<State>;
};

}  // namespace shearfront
