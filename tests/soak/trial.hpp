// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "shearfront/scene/scene.hpp"
#include "support/options.hpp"
#include "support/random_scene.hpp"

/// Random scenes, harder than any bed, and the laws that every engine must keep on them.
namespace shearfront::soak {

/// One scene with everything a run of all engines needs; a function of the seed alone.
struct Trial {
  std::uint64_t seed = 0;
  SceneSpec<double> spec;
  /// No two numbers of the scene coincide, so that everything is differentiable with probability 1.
  bool is_generic = false;
  double early = 0, late = 0;      ///< times, 0 < early < late, from tiny to beyond steady
  support::OptionNumbers options;  ///< of all solvers, drawn too

  [[nodiscard]] std::size_t count(std::string_view option) const {
    return static_cast<std::size_t>(options.at(option));
  }
  [[nodiscard]] double height() const { return spec.top - spec.bottom; }
  /// Largest |z|: heights are rounded by units of its last place.
  [[nodiscard]] double largest_height() const { return std::max(std::abs(spec.bottom), std::abs(spec.top)); }
};

/// 1 to 60 layers, contrasts up to 1e8, layers down to one unit in the last place, equal neighbours; smooth
/// and tabulated a(z); up to 200 jumps, at and next to interfaces; pure states, 1/2, traces; domains other
/// than [0, 1]; scales from 1e-300 to 1e300.
[[nodiscard]] Trial draw_trial(std::uint64_t seed);

/// Times of the order of the time in which the bed segregates, and that of its fastest layer.
struct TimeScales {
  double bed = 0, fastest = 0;
};
[[nodiscard]] TimeScales time_scales(const SceneSpec<double>& spec);

/// The trial as a scene file that `shearfront check` accepts and that reads back to the same bits; times and
/// options in comments.
[[nodiscard]] std::string text_of(const Trial& trial);
[[nodiscard]] std::string text_of(const SceneSpec<double>& spec);

/// A bed of layers as the specification of a scene with the same data.
[[nodiscard]] SceneSpec<double> upside_down(const SceneSpec<double>& spec);

}  // namespace shearfront::soak
