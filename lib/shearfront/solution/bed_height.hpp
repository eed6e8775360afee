// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/field.hpp"

namespace shearfront {

/// Height of a bed whose grains are packed as closely as their mixture allows. Mixtures pack closer than one
/// kind of grains, so the bed sinks while the grains mix and rises while they segregate: that height is what
/// a shear cell records. With x the share of small grains and c_rcp the scene's law of random close packing,
///
///     H = (top - bottom) G / G_seg,     G = int c / c_rcp(x) dz,
///     G_seg = (small grains) / c_rcp(1) + (large grains) / c_rcp(0):
///
/// the volume of all grains over the cross section never changes, and segregated grains fill the domain,
/// H = top - bottom. Where c_rcp(0) = c_rcp(1) and c = 1 this is H = int c_rcp(0) / c_rcp(phi) dz.
/// Source: the thesis named in docs/evidence/packing.md, Sections 2.3 and 5.3.
class BedHeight {
 public:
  /// The scene's close packing, or that of spheres of size ratio 2. Precondition: refusal(scene) is empty.
  explicit BedHeight(const Scene<double>& scene);

  /// Why the bed has no such height; empty if it has.
  [[nodiscard]] static std::string refusal(const Scene<double>& scene);

  /// 1 / c_rcp of the share of small grains; where phi counts rising grains, those are the large ones. Shares beyond [0, 1] count as pure.
  [[nodiscard]] const ShareFunction& integrand() const { return integrand_; }
  /// H for the integral G of integrand().
  [[nodiscard]] double height(double integral) const { return integral * scale_; }
  /// dH by those of G and of the mass int phi dz.
  [[nodiscard]] double height_by(double integral, double by_integral, double by_mass) const {
    return by_integral * scale_ + integral * scale_by_mass_ * by_mass;
  }

 private:
  ShareFunction integrand_;
  double scale_, scale_by_mass_;
};

}  // namespace shearfront
