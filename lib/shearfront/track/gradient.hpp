// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/solver/solver.hpp"
#include "shearfront/track/track.hpp"

namespace shearfront {

/// The gradient of sum_i (w_i.phi phi_i + w_i.M M_i) with respect to entries(scene.spec())[k], k of `wanted`, by one pass backwards over the
/// events of the run (track/front_tape.hpp): for many entries and one misfit, where linearise_tracking() is for few entries or
/// many samples, and the same otherwise. `weigh` is called once the run is done; the weights of a sum of squares are the residuals
/// themselves.
///
/// Of the solution that is constant between fronts (TrackOptions::reconstruct is not looked at). Guaranteed: what
/// linearise_tracking() says there, to rounding. Preconditions: those of linearise_tracking(), and finite times.
/// Cost: about two runs, whatever the number of entries, and for each entry a pass over the states of the grid.
[[nodiscard]] LinearSum tracking_gradient(const Scene<double>& scene, const TrackOptions& options,
                                          const std::vector<Place>& places, const SumWeights& weigh,
                                          const std::vector<std::size_t>& wanted,
                                          const Progress& progress = {});

}  // namespace shearfront
