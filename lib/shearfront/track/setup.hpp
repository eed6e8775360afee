// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/track/level_grid.hpp"
#include "shearfront/track/pieces.hpp"
#include "shearfront/track/slowest_arrival.hpp"
#include "shearfront/track/smooth_start.hpp"
#include "shearfront/track/track.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront {

/// Number of layers of the staircase that stands for a smooth a(z): proportional to the variation of ln a
/// and ln c over the domain and to 1 / resolution, so that the steps of the staircase contribute less to the
/// error of phi than those of the fans (measured in docs/evidence/accuracy.md). 1 for a constant a(z).
template <Real Scalar>
[[nodiscard]] std::size_t staircase_layers(const Scene<Scalar>& scene, const Scalar& resolution) {
  constexpr int kSamples = 4096;
  constexpr double kLayersPerVariation = 1.6;
  constexpr double kMaxLayers = 1e6;
  double variation = 0;
  const Scalar step = (scene.top() - scene.bottom()) / Scalar(kSamples);
  const auto at = [&](const Scalar& z) {
    // Where a vanishes at an end its logarithm has no bound: that of the nearest sample then.
    const Scalar rate = scene.rate_at(z),
                 inside = std::clamp(z, Scalar(scene.bottom() + step), Scalar(scene.top() - step));
    return std::array{std::log(to_double(rate > 0 ? rate : scene.rate_at(inside))),
                      std::log(to_double(scene.solid_fraction_at(z)))};
  };
  auto last = at(scene.bottom());
  for (int i = 1; i <= kSamples; ++i) {
    const Scalar z = scene.bottom() + (scene.top() - scene.bottom()) * (Scalar(i) / Scalar(kSamples));
    const auto now = at(z);
    variation += std::abs(now[0] - last[0]) + std::abs(now[1] - last[1]);
    last = now;
  }
  const double layers = std::ceil(kLayersPerVariation * variation / to_double(resolution));
  return static_cast<std::size_t>(std::clamp(layers, 1.0, kMaxLayers));
}

/// The layers a scene is tracked in: its own, or a staircase as fine as the resolution asks for.
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> tracking_layers(const Scene<Scalar>& scene, const Scalar& resolution) {
  if (scene.is_layered()) return exact_layers(scene);
  return staircase(scene, staircase_layers(scene, resolution));
}

/// Cuts the initial data of `scene` by the layers of `stack`. A jump on an interface makes one cut, not two.
/// Cost: O(jumps + layers).
template <Real Scalar>
[[nodiscard]] InitialPieces<Scalar> initial_pieces(const Scene<Scalar>& scene,
                                                   const LayerStack<Scalar>& stack) {
  InitialPieces<Scalar> pieces;
  const std::vector<Scalar>& breaks = scene.initial_breaks();
  std::size_t jump = 0;
  for (std::size_t k = 0; k < stack.n_layers(); ++k) {
    const Scalar& top = stack.boundary(k + 1);
    while (jump < breaks.size() && breaks[jump] < top) {
      if (breaks[jump] > stack.boundary(k)) {
        pieces.states.push_back({k, scene.initial_values()[jump]});
        pieces.tops.push_back(breaks[jump]);
      }
      ++jump;
    }
    pieces.states.push_back({k, scene.initial_values()[jump]});
    pieces.tops.push_back(top);
  }
  return pieces;
}

/// The pieces with the states of a grid, ready for a Tracker. `states`, of which the first are those of the
/// pieces, comes from the grid's factory function.
template <Real Scalar>
[[nodiscard]] std::vector<Piece<Scalar>> on_grid(const InitialPieces<Scalar>& pieces,
                                                 const std::vector<State>& states) {
  std::vector<Piece<Scalar>> result(pieces.states.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {pieces.states[i].layer, pieces.tops[i], states[i]};
  return result;
}

/// Everything a Tracker needs for a scene. Keep it alive as long as the tracker. Errors: InputError (key "flux") if the
/// grid does not take the scene's fluxes; Tracking (track/track.hpp) chooses the grid that does.
template <Real Scalar, class Grid = LevelGrid<Scalar>>
struct TrackingSetup {
  LayerStack<Scalar> stack;
  Grid grid;
  InitialPieces<Scalar> initial;
  std::vector<Piece<Scalar>> pieces;
  /// The states the grid was made to hold: those of `initial` (of a smooth start, its plateaus), then those outside the bottom and the
  /// top, and which states of the grid they are.
  std::vector<LayerState<Scalar>> wanted;
  std::vector<State> wanted_states;
  Ends<Scalar> ends;
  Scalar start_distance{0};  ///< L1 distance of a smooth start from the steps that stand for it

  TrackingSetup(const Scene<Scalar>& scene, const Scalar& resolution, GridKind kind = GridKind::levels)
      : TrackingSetup(scene, tracking_layers(scene, resolution), resolution, kind) {}

  TrackingSetup(const Scene<Scalar>& scene, LayerStack<Scalar> layers, const Scalar& resolution,
                GridKind kind)
      : stack(std::move(layers)) {
    if (std::string why = refusal(resolution); !why.empty()) throw InputError("flux", "", why);
    if (!scene.has_smooth_start()) initial = initial_pieces(scene, stack);
    std::vector<LayerState<Scalar>> states =
        scene.has_smooth_start() ? plateaus(scene, stack) : initial.states;
    const std::size_t n_inside = states.size();
    const std::array outside{&scene.spec().outside_bottom, &scene.spec().outside_top};
    for (std::size_t end = 0; end < 2; ++end)
      if (*outside[end])
        for (const Scalar& share : (*outside[end])->values)
          states.push_back({end == 0 ? 0 : stack.n_layers() - 1, share});
    auto built = build(kind, resolution, states);
    grid = std::move(built.grid);
    if (scene.has_smooth_start()) {
      StartSteps<Scalar> steps = StartStepper<Scalar, Grid>(scene, stack, grid).run();
      pieces = std::move(steps.pieces);
      initial = std::move(steps.initial);
      start_distance = steps.distance;
    } else {
      pieces = on_grid(initial, built.states);
    }
    ends.is_periodic = scene.spec().is_periodic;
    wanted = std::move(states);
    wanted_states = built.states;
    auto next = built.states.begin() + static_cast<std::ptrdiff_t>(n_inside);
    for (std::size_t end = 0; end < 2; ++end) {
      if (!*outside[end]) continue;
      ends.outside[end] = *next++;
      for (const Scalar& t : (*outside[end])->breaks) ends.changes.push_back({t, end, *next++});
    }
    std::stable_sort(ends.changes.begin(), ends.changes.end(),
                     [](const auto& a, const auto& b) { return a.t < b.t; });
  }

 private:
  [[nodiscard]] std::string refusal(const Scalar& resolution) const {
    if constexpr (requires { Grid::refusal(stack); })
      return Grid::refusal(stack);
    else
      return Grid::refusal(stack, resolution);
  }
  [[nodiscard]] typename Grid::Built build(GridKind kind, const Scalar& resolution,
                                           const std::vector<LayerState<Scalar>>& states) const {
    if constexpr (requires { Grid::singular_mapping(stack, resolution, states); })
      if (kind == GridKind::singular_mapping) return Grid::singular_mapping(stack, resolution, states);
    SHEARFRONT_EXPECTS(kind == GridKind::levels, "a grid of this kind");
    return Grid::exact_levels(stack, resolution, states);
  }
};

template <class AnyTracker, Real Scalar>
[[nodiscard]] Timeline<Scalar> tracked_timeline(const AnyTracker& tracker, const Scene<Scalar>& scene,
                                                const LayerStack<Scalar>& stack,
                                                const InitialPieces<Scalar>& initial,
                                                FanEdges edges = FanEdges::characteristic);

/// The same for data that are constant in pieces.
template <class AnyTracker, Real Scalar>
[[nodiscard]] Timeline<Scalar> tracked_timeline(const AnyTracker& tracker, const Scene<Scalar>& scene,
                                                const LayerStack<Scalar>& stack) {
  return tracked_timeline(tracker, scene, stack, initial_pieces(scene, stack));
}

/// Event times of a tracker that has reached its steady state. The last fronts of a polygon can meet long before the bed
/// rests, or in a bed that never does: what it cannot see is bounded by SlowestArrival.
template <class AnyTracker, Real Scalar>
[[nodiscard]] Timeline<Scalar> tracked_timeline(const AnyTracker& tracker, const Scene<Scalar>& scene,
                                                const LayerStack<Scalar>& stack,
                                                const InitialPieces<Scalar>& initial, FanEdges edges) {
  Timeline<Scalar> timeline;
  timeline.mass = scene.mass();
  timeline.steady_height = scene.steady_height();
  const auto first = [&](std::size_t k) {
    return edges == FanEdges::characteristic ? tracker.first_edge(k) : tracker.first_wave(k);
  };
  timeline.t0 = first(0);
  timeline.t1 = first(stack.n_layers());
  const SlowestArrival<Scalar> slowest(stack, initial.states, initial.tops);
  const auto later = [](std::optional<Scalar> tracked, const Scalar& least) {
    if (tracked) *tracked = std::max(*tracked, least);
    return tracked && is_finite(*tracked) ? tracked : std::nullopt;
  };
  if (tracker.is_steady())
    timeline.t_star = tracker.n_collisions() == 0
                          ? tracker.last_collision()
                          : later(tracker.last_collision(), slowest.at(timeline.steady_height));
  for (std::size_t k = 1; k < stack.n_layers(); ++k)
    if (stack.is_break(k))
      timeline.interfaces.push_back(
          {stack.boundary(k), first(k),
           later(tracker.last_wave(k), slowest.at_interface(k, timeline.steady_height))});
  return timeline;
}

}  // namespace shearfront
