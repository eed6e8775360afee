// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Traffic flux of Lighthill, Whitham & Richards with Greenshields' speed: f(rho) = rho (1 - rho / jam).
///
/// Domain: density rho in [0, jam], jam > 0 (vehicles per length, or 1). Concave, zero at both ends, maximum
/// jam / 4 at jam / 2. The shear rate a(z) is the free speed at z: a speed limit.
/// Source: Lighthill & Whitham (1955), Proc. R. Soc. A 229; Greenshields (1935).
template <Real Scalar>
struct Lwr {
  static constexpr std::string_view kName = "lwr";
  static constexpr std::string_view kFormula = "phi (1 - phi / jam)";
  static constexpr std::string_view kStates = "0 <= phi <= jam";
  static constexpr bool kIsParabola = true;

  Scalar jam{1};

  [[nodiscard]] StateRange<Scalar> range() const { return {Scalar(0), jam}; }
  [[nodiscard]] std::vector<Scalar> extrema() const { return {jam / Scalar(2)}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::concave; }
  [[nodiscard]] Scalar value(const Scalar& rho) const { return rho * ((jam - rho) / jam); }
  [[nodiscard]] Scalar derivative(const Scalar& rho) const { return ((jam - rho) - rho) / jam; }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const { return ((jam - p) - q) / jam; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"jam", Range::positive, true}, self.jam);
  }
  static void check(const std::string& /*prefix*/, Complaints&) {}

  static std::vector<Lwr> samples() { return {{Scalar(1)}, {Scalar(0.125)}}; }
};

}  // namespace shearfront
