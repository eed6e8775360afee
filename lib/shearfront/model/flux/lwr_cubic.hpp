// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Traffic flux with a skew: f(rho) = rho (1 - rho / jam)(1 - gamma rho / jam). The road carries most at a
/// density below jam / 2, and jams move more slowly than in Greenshields' flux, which is gamma = 0.
///
/// Domain: density rho in [0, jam], jam > 0 (vehicles per length, or 1), 0 <= gamma <= 1. One maximum, at
/// jam / (1 + gamma + sqrt(1 - gamma + gamma^2)), which is jam / 3 for gamma = 1; concave for gamma <= 1/2,
/// beyond that convex above jam (1 + gamma) / (3 gamma). The shear rate a(z) is the free speed at z.
/// Mirror image, in units of jam, of the flux of asymmetric segregation (flux/cubic.hpp), whose source is
/// Gajjar & Gray (2014), J. Fluid Mech. 757, 297-329.
template <Real Scalar>
struct LwrCubic {
  static constexpr std::string_view kName = "lwr-cubic";
  static constexpr std::string_view kFormula = "phi (1 - phi / jam)(1 - gamma phi / jam)";
  static constexpr std::string_view kStates = "0 <= phi <= jam";
  static constexpr bool kIsParabola = false;
  static constexpr int kDegree = 3;

  Scalar jam{1}, gamma{0};

  [[nodiscard]] StateRange<Scalar> range() const { return {Scalar(0), jam}; }
  [[nodiscard]] std::vector<Scalar> extrema() const {
    using std::sqrt;
    return {jam / (Scalar(1) + gamma + sqrt(Scalar(1) - gamma * (Scalar(1) - gamma)))};
  }
  [[nodiscard]] Curvature curvature() const {
    return gamma + gamma <= Scalar(1) ? Curvature::concave : Curvature::mixed;
  }
  [[nodiscard]] Scalar value(const Scalar& rho) const {
    return rho * ((jam - rho) / jam) * ((jam - gamma * rho) / jam);
  }
  [[nodiscard]] Scalar derivative(const Scalar& rho) const {
    const Scalar u = rho / jam;
    return Scalar(1) - u * (Scalar(2) * (Scalar(1) + gamma) - Scalar(3) * gamma * u);
  }
  [[nodiscard]] Scalar second_derivative(const Scalar& rho) const {
    return (Scalar(6) * gamma * (rho / jam) - Scalar(2) * (Scalar(1) + gamma)) / jam;
  }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    const Scalar u = p / jam, v = q / jam;
    return (((jam - p) - q) / jam) - gamma * ((u + v) - (u * u + (u * v + v * v)));
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"jam", Range::positive, true}, self.jam);
    visit(FieldInfo{.key = "gamma", .limits = {0, 1, true}}, self.gamma);
  }
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  static std::vector<LwrCubic> samples() {
    return {{Scalar(1), Scalar(0)},
            {Scalar(1), Scalar(0.5)},
            {Scalar(0.125), Scalar(0.75)},
            {Scalar(1), Scalar(1)}};
  }
};

}  // namespace shearfront
