// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/flux/model.hpp"
#include "shearfront/scene/field.hpp"

namespace shearfront {

/// Asymmetric segregation flux f(phi) = -phi (1 - phi)(1 - gamma phi): small grains fall through large ones
/// faster than large ones rise through small ones.
///
/// Domain: phi in [0, 1], 0 <= gamma <= 1; gamma = 0 is the quadratic flux. One minimum, at
/// phi_m = 1 / (1 + gamma + sqrt(1 - gamma + gamma^2)); convex for gamma <= 1/2, beyond that concave above
/// phi = (1 + gamma) / (3 gamma), and rarefactions can end in shocks.
/// Source: Gajjar & Gray (2014), J. Fluid Mech. 757, 297-329.
template <Real Scalar>
struct Cubic {
  static constexpr std::string_view kName = "cubic";
  static constexpr std::string_view kFormula = "-phi (1 - phi)(1 - gamma phi)";
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = false;

  Scalar gamma{0};

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }
  [[nodiscard]] std::vector<Scalar> extrema() const {
    using std::sqrt;
    return {Scalar(1) / (Scalar(1) + gamma + sqrt(Scalar(1) - gamma * (Scalar(1) - gamma)))};
  }
  [[nodiscard]] Curvature curvature() const {
    return gamma + gamma <= Scalar(1) ? Curvature::convex : Curvature::mixed;
  }
  [[nodiscard]] Scalar value(const Scalar& phi) const {
    return phi * (phi - Scalar(1)) * (Scalar(1) - gamma * phi);
  }
  [[nodiscard]] Scalar derivative(const Scalar& phi) const {
    return phi * (Scalar(2) * (Scalar(1) + gamma) - Scalar(3) * gamma * phi) - Scalar(1);
  }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    return (p + (q - Scalar(1))) + gamma * ((p + q) - (p * p + (p * q + q * q)));
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"gamma"}, self.gamma);
  }
  void check(const std::string& prefix, Problems& problems) const {
    if (is_finite(gamma) && !(gamma >= 0 && gamma <= 1))
      problems.push_back({prefix + "gamma", number_text(gamma), "must be between 0 and 1"});
  }

  static std::vector<Cubic> samples() {
    return {{Scalar(0)}, {Scalar(0.25)}, {Scalar(0.5)}, {Scalar(0.9)}, {Scalar(1)}};
  }
};

}  // namespace shearfront
