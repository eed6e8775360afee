// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Settling of a suspension: f(phi) = -phi (1 - phi)^exponent, hindered by the concentration phi.
///
/// Domain: phi in [0, 1], exponent > 1 (about 4.7 for spheres at small Reynolds numbers). z points upwards,
/// so f <= 0: solids sink; the shear rate a(z) is the speed of a single grain. One minimum, at
/// 1 / (exponent + 1); convex below 2 / (exponent + 1), concave above, where dense suspensions fan out.
/// Guaranteed: secant() keeps its relative accuracy for close states. Source: Kynch (1952), Trans. Faraday
/// Soc. 48, 166-176; Richardson & Zaki (1954), Trans. IChemE 32, 35-53.
template <Real Scalar>
struct RichardsonZaki {
  static constexpr std::string_view kName = "richardson-zaki";
  static constexpr std::string_view kFormula = "-phi (1 - phi)^exponent";
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = false;

  Scalar exponent{4.7};

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }
  [[nodiscard]] std::vector<Scalar> extrema() const { return {Scalar(1) / (exponent + Scalar(1))}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::mixed; }
  [[nodiscard]] Scalar value(const Scalar& phi) const { return -phi * power(phi); }
  [[nodiscard]] Scalar derivative(const Scalar& phi) const {
    using std::pow;
    return ((exponent + Scalar(1)) * phi - Scalar(1)) * pow(Scalar(1) - phi, exponent - Scalar(1));
  }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    using std::expm1;
    using std::log1p;
    if (p == q) return derivative(p);
    const Scalar& lo = p < q ? p : q;
    const Scalar& hi = p < q ? q : p;
    if (hi == Scalar(1)) return lo * power(lo) / (Scalar(1) - lo);
    // hi g(hi) - lo g(lo) with g = (1 - phi)^n, the difference of g by its ratio.
    const Scalar fall = expm1(exponent * log1p(-(hi - lo) / (Scalar(1) - lo)));
    return -(power(hi) + lo * power(lo) * (fall / (hi - lo)));
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "exponent", .range = Range::positive, .limits = {.low = 1}}, self.exponent);
  }
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  static std::vector<RichardsonZaki> samples() { return {{Scalar(2)}, {Scalar(4.6875)}, {Scalar(3)}}; }

 private:
  [[nodiscard]] Scalar power(const Scalar& phi) const {
    using std::pow;
    return pow(Scalar(1) - phi, exponent);
  }
};

}  // namespace shearfront
