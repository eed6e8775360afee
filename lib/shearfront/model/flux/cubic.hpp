// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Whether the flux is taken as the formula says or stretched to the extremum -1/4 of the quadratic one.
enum class CubicScaling { none, quadratic_extremum };
inline constexpr std::array<std::string_view, 2> kCubicScalingNames{"none", "quadratic-extremum"};

/// Asymmetric segregation flux f(phi) = -A phi (1 - phi)(1 - gamma phi): small grains fall through large ones
/// faster than large ones rise through small ones.
///
/// Domain: phi in [0, 1], 0 <= gamma <= 1; gamma = 0 is the quadratic flux. One minimum, at
/// phi_m = 1 / (1 + gamma + D), D = sqrt(1 - gamma + gamma^2); convex for gamma <= 1/2, beyond that concave
/// above phi = (1 + gamma) / (3 gamma), and rarefactions can end in shocks.
/// A = 1, or A = (1 + gamma + D)^3 / (4 (1 + D) (gamma + D)), from 1 to 27/16, with which f(phi_m) = -1/4 for
/// every gamma: then gamma changes the asymmetry and not the largest rate of segregation. Guaranteed: -1/4 to
/// 20 roundings. Source: Gajjar & Gray (2014), J. Fluid Mech. 757, 297-329.
template <Real Scalar>
struct Cubic {
  static constexpr std::string_view kName = "cubic";
  static constexpr std::string_view kFormula =
      "-phi (1 - phi)(1 - gamma phi), or scaled to the extremum -1/4";
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = false;
  static constexpr int kDegree = 3;

  Scalar gamma{0};
  CubicScaling scaling = CubicScaling::none;

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }
  [[nodiscard]] std::vector<Scalar> extrema() const { return {Scalar(1) / (Scalar(1) + gamma + root())}; }
  [[nodiscard]] Curvature curvature() const {
    return gamma + gamma <= Scalar(1) ? Curvature::convex : Curvature::mixed;
  }
  [[nodiscard]] Scalar value(const Scalar& phi) const {
    return scaled(phi * (phi - Scalar(1)) * (Scalar(1) - gamma * phi));
  }
  [[nodiscard]] Scalar derivative(const Scalar& phi) const {
    return scaled(phi * (Scalar(2) * (Scalar(1) + gamma) - Scalar(3) * gamma * phi) - Scalar(1));
  }
  [[nodiscard]] Scalar second_derivative(const Scalar& phi) const {
    return scaled(Scalar(2) * (Scalar(1) + gamma) - Scalar(6) * gamma * phi);
  }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    return scaled((p + (q - Scalar(1))) + gamma * ((p + q) - (p * p + (p * q + q * q))));
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "gamma", .limits = {0, 1, true}}, self.gamma);
  }
  template <class Self, class Visit>
  static void choices(Self& self, Visit&& visit) {
    visit(ChoiceInfo{"scaling", kCubicScalingNames}, self.scaling);
  }
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  static std::vector<Cubic> samples() {
    constexpr auto kScaled = CubicScaling::quadratic_extremum;
    return {{Scalar(0)}, {Scalar(0.25)},           {Scalar(0.5)},         {Scalar(0.9)},
            {Scalar(1)}, {Scalar(0.375), kScaled}, {Scalar(0.9), kScaled}};
  }

 private:
  [[nodiscard]] Scalar root() const {
    using std::sqrt;
    return sqrt(Scalar(1) - gamma * (Scalar(1) - gamma));
  }
  [[nodiscard]] Scalar scaled(const Scalar& x) const {
    if (scaling == CubicScaling::none) return x;
    const Scalar D = root(), sum = Scalar(1) + gamma + D;
    return x * (sum * sum * sum / (Scalar(4) * (Scalar(1) + D) * (gamma + D)));
  }
};

}  // namespace shearfront
