// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"

namespace shearfront::diffusion {

/// The height of the solid below, as a coordinate of a bed whose solid fraction varies:
///
///     m(z) = bottom + (1 / mean c) int_bottom^z c dz,     bottom <= m <= top.
///
/// (c x)_t + (r c f(x))_z = (D c x_z)_z, which moves shares x = phi / c, is in it a bed of solid fraction 1,
///
///     x_t + ((r c / mean c) f(x))_m = ((D c^2 / mean c^2) x_m)_m:
///
/// equal cells hold equal amounts of grains, and the conductance between two of them is that of the harmonic mean of D c
/// in z. Source: the interaction force of the thesis named in docs/evidence/packing.md pulls on phi / c, so what mixes is
/// x, and a uniform x stays as it is where nothing segregates.
/// Without a solid fraction m = z to the bit. Cost: O(knots) once; a height O(log knots), one of c that is not constant in
/// pieces a few iterations.
class SolidHeights {
 public:
  /// `scene` must outlive this.
  explicit SolidHeights(const Scene<double>& scene);

  [[nodiscard]] bool is_identity() const { return z_.empty(); }
  [[nodiscard]] double coordinate(double z) const;
  [[nodiscard]] double height(double m) const;
  /// dm / dz = c / mean c; at a jump of c that above it.
  [[nodiscard]] double density(double z) const;
  /// Heights inside the bed where c or its slope jumps, ascending.
  [[nodiscard]] const std::vector<double>& knots() const { return knots_; }

 private:
  const Scene<double>& scene_;
  double mean_ = 1;
  std::vector<double> knots_, z_, m_;  ///< z_: ends and knots
};

}  // namespace shearfront::diffusion
