// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "shearfront/riemann/flux_course.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/track/level_grid.hpp"
#include "shearfront/track/one_layer_grid.hpp"
#include "shearfront/track/unimodal_grid.hpp"

namespace shearfront::track_detail {

[[nodiscard]] inline bool has_several_extrema(const Scene<double>& scene) {
  return std::any_of(scene.fluxes().begin(), scene.fluxes().end(),
                     [](const Flux<double>& flux) { return course_of(flux) == FluxCourse::several_extrema; });
}

/// Calls on(std::type_identity<Grid>{}) for the grid that takes the fluxes of a scene.
template <class On>
decltype(auto) with_grid(const Scene<double>& scene, const LayerStack<double>& stack, On&& on) {
  if (LevelGrid<double>::refusal(stack).empty()) return on(std::type_identity<LevelGrid<double>>{});
  if (has_several_extrema(scene)) return on(std::type_identity<OneLayerGrid<double>>{});
  return on(std::type_identity<UnimodalGrid<double>>{});
}

[[nodiscard]] inline std::string message_of(Status status, std::uint64_t n_collisions,
                                            std::size_t n_unreachable) {
  switch (status) {
    case Status::steady:
      return "steady state reached";
    case Status::budget_reached:
      return "stopped at " + std::to_string(n_collisions) +
             " collisions, the largest number allowed; allow more or use a coarser resolution";
    case Status::interrupted:
      return "interrupted after " + std::to_string(n_collisions) + " collisions";
    default:
      return n_unreachable > 0 ? "some fronts meet only after the largest representable time"
                               : "reached the last time";
  }
}

}  // namespace shearfront::track_detail
