// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Burgers' flux f(u) = u^2 / 2.
///
/// Domain: lowest <= u <= highest with lowest < 0 < highest. Convex, minimum 0 at u = 0. The flux does not
/// vanish at the ends of the range: no wall can hold such a bed, its boundaries must be open or periodic.
/// Source: Burgers (1948), Adv. Appl. Mech. 1, 171-199, without viscosity.
template <Real Scalar>
struct Burgers {
  static constexpr std::string_view kName = "burgers";
  static constexpr std::string_view kFormula = "phi^2 / 2";
  static constexpr std::string_view kStates = "lowest <= phi <= highest";
  static constexpr bool kIsParabola = false;
  static constexpr bool kIsQuadraticPolynomial = true;

  Scalar lowest{-1}, highest{1};

  [[nodiscard]] StateRange<Scalar> range() const { return {lowest, highest}; }
  [[nodiscard]] static std::vector<Scalar> extrema() { return {Scalar(0)}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::convex; }
  [[nodiscard]] static Scalar value(const Scalar& u) { return u * u / Scalar(2); }
  [[nodiscard]] static Scalar derivative(const Scalar& u) { return u; }
  [[nodiscard]] static Scalar secant(const Scalar& p, const Scalar& q) { return (p + q) / Scalar(2); }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"lowest", Range::any, true, Measure::state, {.high = 0}}, self.lowest);
    visit(FieldInfo{"highest", Range::any, true, Measure::state, {.low = 0}}, self.highest);
  }
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  static std::vector<Burgers> samples() { return {{}, {Scalar(-0.5), Scalar(2)}}; }
};

}  // namespace shearfront
