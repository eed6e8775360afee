// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/flux/model.hpp"
#include "shearfront/model/field.hpp"

namespace shearfront {

/// Which grains phi is the volume fraction of: small ones sink, large ones rise.
enum class Grains { small, large };
inline constexpr std::array<std::string_view, 2> kGrainsNames{"small", "large"};

/// Segregation in a bed whose solid fraction c(z) and granular temperature T(z) vary with height:
/// f(phi) = -phi (1 - phi) for small grains, +phi (1 - phi) for large ones, phi counted as a share of c(z).
///
/// With the scene's solid fraction and temperature the flux is -+ s a(z) sqrt(T(z)) phi (c(z) - phi) / c(z), states
/// [0, c(z)]; s a(z) is the segregation rate S. Convex for small grains, concave for large ones.
/// Source: Gray & Thornton (2005), Proc. R. Soc. A 461, for c = T = 1; docs/packing.md.
template <Real Scalar>
struct Packed {
  static constexpr std::string_view kName = "packed";
  static constexpr std::string_view kFormula = "-phi (1 - phi), large grains +phi (1 - phi)";
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = true;

  Grains grains = Grains::small;

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }
  [[nodiscard]] static std::vector<Scalar> extrema() { return {Scalar(1) / Scalar(2)}; }
  [[nodiscard]] Curvature curvature() const {
    return grains == Grains::small ? Curvature::convex : Curvature::concave;
  }
  [[nodiscard]] Scalar value(const Scalar& phi) const { return signed_of(phi * (phi - Scalar(1))); }
  [[nodiscard]] Scalar derivative(const Scalar& phi) const { return signed_of(phi + (phi - Scalar(1))); }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    return signed_of(p + (q - Scalar(1)));
  }

  template <class Self, class Visit>
  static void fields(Self&, Visit&&) {}
  template <class Self, class Visit>
  static void choices(Self& self, Visit&& visit) {
    visit(ChoiceInfo{"grains", kGrainsNames}, self.grains);
  }
  static void check(const std::string& /*prefix*/, Complaints&) {}

  static std::vector<Packed> samples() { return {{Grains::small}, {Grains::large}}; }

 private:
  [[nodiscard]] Scalar signed_of(const Scalar& x) const { return grains == Grains::small ? x : Scalar(-x); }
};

}  // namespace shearfront
