// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/scene/entries.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/track/flux_tangent.hpp"
#include "shearfront/track/smooth_start.hpp"

namespace shearfront {

/// Derivatives of all that a tracker starts from with respect to one entry of a scene.
struct SceneTangent {
  std::vector<double> boundary;              ///< heights, per boundary of the layers
  std::vector<double> rate, solid_fraction;  ///< per layer
  std::vector<double> wanted;                ///< shares, in the order of TrackingSetup::wanted
  std::vector<double> top;                   ///< of the initial pieces
  std::vector<double> change;                ///< times, in the order of Ends::changes
  std::vector<Flux<Dual<1>>> fluxes;         ///< those of the scene; their numbers move with the entry
  std::size_t moving_flux = kNoEntry;        ///< which of them does: all others stay as they are
};

/// Why fronts carry no derivatives with respect to an entry of this scene, in one clause; empty if they do.
///
/// They do for every entry of layered beds from steps, those of diffusion (there is none), close packing (it moves nothing) and
/// chutes excepted. Left out is what has a derivative to one side only, as its step makes or removes a layer: a height on
/// another one of a, c, T, the fluxes or the initial state.
[[nodiscard]] std::string tangent_refusal(const Scene<double>& scene, const Entry& entry);

/// With respect to entries(scene.spec())[entry]. Preconditions: tangent_refusal() of it is empty; `stack` and `initial` are those of
/// a TrackingSetup of the scene. Exact to rounding. Cost: O(layers + jumps + changes).
[[nodiscard]] SceneTangent scene_tangent(const Scene<double>& scene, const LayerStack<double>& stack,
                                         const InitialPieces<double>& initial, std::size_t entry);

}  // namespace shearfront
