// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/initial_pieces.hpp"
#include "shearfront/track/level_grid.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront {

/// Number of layers of the staircase that stands for a smooth a(z): proportional to the variation of ln a
/// over the domain and to 1 / resolution, so that the steps of the staircase contribute less to the error of
/// phi than those of the fans (measured in docs/accuracy.md). 1 for a constant a(z).
template <Real Scalar>
[[nodiscard]] std::size_t staircase_layers(const Scene<Scalar>& scene, const Scalar& resolution) {
  constexpr int kSamples = 4096;
  constexpr double kLayersPerVariation = 1.6;
  constexpr double kMaxLayers = 1e6;
  double variation = 0;
  double last = std::log(to_double(scene.shear_rate_at(scene.bottom())));
  for (int i = 1; i <= kSamples; ++i) {
    const Scalar z = scene.bottom() + (scene.top() - scene.bottom()) * (Scalar(i) / Scalar(kSamples));
    const double now = std::log(to_double(scene.shear_rate_at(z)));
    variation += std::abs(now - last);
    last = now;
  }
  const double layers = std::ceil(kLayersPerVariation * variation / to_double(resolution));
  return static_cast<std::size_t>(std::clamp(layers, 1.0, kMaxLayers));
}

/// The layers a scene is tracked in: its own, or a staircase of `layers` (0: as many as the resolution asks
/// for).
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> tracking_layers(const Scene<Scalar>& scene, const Scalar& resolution,
                                                 std::size_t layers) {
  if (scene.is_layered()) return exact_layers(scene);
  return staircase(scene, layers > 0 ? layers : staircase_layers(scene, resolution));
}

/// Everything a Tracker needs for a scene. Keep it alive as long as the tracker.
template <Real Scalar>
struct TrackingSetup {
  LayerStack<Scalar> stack;
  LevelGrid<Scalar> grid;
  std::vector<Piece<Scalar>> pieces;

  TrackingSetup(const Scene<Scalar>& scene, const Scalar& resolution, GridKind kind = GridKind::levels,
                std::size_t layers = 0)
      : TrackingSetup(scene, tracking_layers(scene, resolution, layers), resolution, kind) {}

  TrackingSetup(const Scene<Scalar>& scene, LayerStack<Scalar> layers, const Scalar& resolution,
                GridKind kind)
      : stack(std::move(layers)) {
    const InitialPieces<Scalar> initial = initial_pieces(scene, stack);
    auto built = kind == GridKind::levels
                     ? LevelGrid<Scalar>::exact_levels(stack, resolution, initial.states)
                     : LevelGrid<Scalar>::singular_mapping(stack, resolution, initial.states);
    grid = std::move(built.grid);
    pieces = on_grid(initial, built.states);
  }
};

/// Event times of a tracker that has reached its steady state.
template <class AnyTracker, Real Scalar>
[[nodiscard]] Timeline<Scalar> tracked_timeline(const AnyTracker& tracker, const Scene<Scalar>& scene,
                                                const LayerStack<Scalar>& stack) {
  Timeline<Scalar> timeline;
  timeline.mass = scene.mass();
  timeline.steady_height = scene.bottom() + timeline.mass;
  timeline.t0 = tracker.first_wave(0);
  timeline.t1 = tracker.first_wave(stack.n_layers());
  if (tracker.is_steady()) timeline.t_star = tracker.last_collision();
  for (std::size_t k = 1; k < stack.n_layers(); ++k)
    if (stack.is_break(k))
      timeline.interfaces.push_back({stack.boundary(k), tracker.first_wave(k), tracker.last_wave(k)});
  return timeline;
}

}  // namespace shearfront
