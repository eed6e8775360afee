// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Segregation flux f(phi) = phi (phi - 1): strictly convex, zero at both pure states, minimum -1/4 at 1/2.
///
/// Domain: phi in [0, 1], dimensionless. The layer flux is F = s a(z) f(phi).
/// Guaranteed: value(phi) == value(1 - phi) to rounding; secant(p, q) == (value(q) - value(p)) / (q - p)
/// without cancellation, and secant(p, p) == derivative(p). Source: Gray & Thornton (2005), Proc. R. Soc. A
/// 461; May, Shearer & Daniels (2010), J. Nonlinear Sci. 20, eq. (1).
template <Real Scalar>
struct Quadratic {
  static constexpr std::string_view kName = "quadratic";
  static constexpr std::string_view kFormula = "phi (phi - 1)";
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = true;

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }
  [[nodiscard]] static std::vector<Scalar> extrema() { return {Scalar(1) / Scalar(2)}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::convex; }
  [[nodiscard]] static Scalar value(const Scalar& phi) { return phi * (phi - Scalar(1)); }
  [[nodiscard]] static Scalar derivative(const Scalar& phi) { return phi + (phi - Scalar(1)); }
  /// Rankine-Hugoniot speed of a jump p | q for a = 1.
  [[nodiscard]] static Scalar secant(const Scalar& p, const Scalar& q) { return p + (q - Scalar(1)); }

  /// Visits the model's entries of a scene file: none.
  template <class Self, class Visit>
  static void fields(Self&, Visit&&) {}
  static void check(const std::string& /*prefix*/, Complaints&) {}

  /// Instances on which the laws of fluxes are tested.
  static std::vector<Quadratic> samples() { return {{}}; }
};

}  // namespace shearfront
