// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Displacement of oil by water in a porous rock, with quadratic relative permeabilities:
///
///   f(u) = u^2 / (u^2 + M (1 - u)^2),     M = viscosity_ratio, water over oil,
///
/// the part of the stream that is water where the saturation is u. Domain: u in [0, 1], M > 0. Rises all the way from 0
/// to 1, S-shaped: convex below, concave above, so an injection is a shock followed by a fan, from the state
/// sqrt(M / (1 + M)) on. The shear rate a(z) is the speed of the stream; no wall holds such a bed.
/// Guaranteed: secant() keeps its relative accuracy for close states. Source: Buckley & Leverett (1942), Trans. AIME 146,
/// 107-116; Welge (1952), Trans. AIME 195, 91-98.
template <Real Scalar>
struct BuckleyLeverett {
  static constexpr std::string_view kName = "buckley-leverett";
  static constexpr std::string_view kFormula = "phi^2 / (phi^2 + viscosity_ratio (1 - phi)^2)";
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = false;

  Scalar viscosity_ratio{1};

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }
  [[nodiscard]] static std::vector<Scalar> extrema() { return {}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::mixed; }
  [[nodiscard]] Scalar value(const Scalar& u) const { return u * u / mobility(u); }
  [[nodiscard]] Scalar derivative(const Scalar& u) const { return secant(u, u); }
  [[nodiscard]] Scalar second_derivative(const Scalar& u) const {
    const Scalar rest = Scalar(1) - u, m = mobility(u);
    const Scalar turn = (rest - u) * m - Scalar(4) * u * rest * (u - viscosity_ratio * rest);
    return Scalar(2) * viscosity_ratio * turn / (m * m * m);
  }
  /// f(q) - f(p) = M (q - p) (p (1 - q) + q (1 - p)) / (m(p) m(q)).
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    const Scalar mixed = p * (Scalar(1) - q) + q * (Scalar(1) - p);
    return viscosity_ratio * mixed / (mobility(p) * mobility(q));
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"viscosity_ratio", Range::positive}, self.viscosity_ratio);
  }
  static void check(const std::string& /*prefix*/, Complaints&) {}

  static std::vector<BuckleyLeverett> samples() { return {{Scalar(1)}, {Scalar(0.125)}, {Scalar(8)}}; }

 private:
  /// Of both together, times the viscosity of the water.
  [[nodiscard]] Scalar mobility(const Scalar& u) const {
    const Scalar rest = Scalar(1) - u;
    return u * u + viscosity_ratio * (rest * rest);
  }
};

}  // namespace shearfront
