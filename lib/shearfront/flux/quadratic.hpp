// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string_view>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Segregation flux f(phi) = phi (phi - 1): strictly convex, zero at both pure states, minimum -1/4 at phi =
/// 1/2.
///
/// Domain: phi in [0, 1], dimensionless. The layer flux is F = s a(z) f(phi).
/// Guaranteed: value(phi) == value(1 - phi) to rounding; secant(p, q) == (value(q) - value(p)) / (q - p)
/// without cancellation, and secant(p, p) == derivative(p). Source: Gray & Thornton (2005), Proc. R. Soc. A
/// 461; May, Shearer & Daniels (2010), J. Nonlinear Sci. 20, eq. (1).
struct Quadratic {
  static constexpr std::string_view kName = "quadratic";
  static constexpr std::string_view kFormula = "phi (phi - 1)";

  template <Real S>
  [[nodiscard]] static S value(const S& phi) {
    return phi * (phi - S(1));
  }
  template <Real S>
  [[nodiscard]] static S derivative(const S& phi) {
    return phi + (phi - S(1));
  }
  /// Rankine-Hugoniot speed of a jump p | q for a = 1.
  template <Real S>
  [[nodiscard]] static S secant(const S& p, const S& q) {
    return p + (q - S(1));
  }
  static constexpr std::array<double, 2> kRange{0.0, 1.0};
  static constexpr std::array<double, 1> kExtrema{0.5};

  /// Visits the model's numeric entries of a scene file: none.
  template <class Self, class Visit>
  static void fields(Self&, Visit&&) {}

  /// Instances on which the laws of fluxes are tested.
  static std::array<Quadratic, 1> samples() { return {}; }
};

}  // namespace shearfront
