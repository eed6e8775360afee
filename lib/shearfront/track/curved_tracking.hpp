// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "shearfront/track/any_tracking.hpp"
#include "shearfront/track/curved_scene.hpp"

namespace shearfront::track_detail {

/// Whether a scene is tracked by curved fronts with these options: its pieces allow it, and no staircase is asked for.
[[nodiscard]] bool wants_curves(const Scene<double>& scene, const TrackOptions& options);
/// Why the levels cannot be built; empty if they can. Precondition: wants_curves().
[[nodiscard]] std::string refusal_of_curves(const Scene<double>& scene, const TrackOptions& options);
/// Preconditions: wants_curves(), no refusal.
[[nodiscard]] std::unique_ptr<AnyTracking> track_curves(const Scene<double>& scene,
                                                        const TrackOptions& options, Progress progress);

}  // namespace shearfront::track_detail
