// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>

#include "shearfront/scene/scene_spec.hpp"
#include "soak/findings.hpp"

/// The laws of curved fronts on random beds.
namespace shearfront::soak {

/// Of tests/support/curved_scenes.hpp.
enum class CurvedKind { parabola, any_flux, smooth, hostile };

struct CurvedTrial {
  CurvedKind kind;
  std::uint64_t seed;
  SceneSpec<double> spec;
  double resolution;
};
/// A bed of one kind, or of the first three in turn; R from 0.01 to 0.5. Hostile beds may lose mass where heights do not resolve their
/// rate (docs/theory/curved-fronts.md).
[[nodiscard]] CurvedTrial draw_curved(CurvedKind kind, std::uint64_t seed);
[[nodiscard]] CurvedTrial draw_curved(std::uint64_t seed);
[[nodiscard]] std::string text_of(const CurvedTrial& trial);

/// Worst of what is measured, for tables.
struct CurvedWorst {
  double mass = 0, order = 0, mirror = 0;
};
/// Mass, order of fronts, range, an end at pure states, restart = direct and scaling by two to the bit, the mirror image.
[[nodiscard]] Findings check_curved(const CurvedTrial& trial, CurvedWorst* worst = nullptr);

}  // namespace shearfront::soak
