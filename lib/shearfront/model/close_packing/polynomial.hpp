// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/close_packing/model.hpp"

namespace shearfront {

/// Spheres of which the large ones are twice as wide as the small ones: a fit of degree 5 to simulated
/// packings that is exact for one kind of grains,
///
///     c_rcp(x) = pure + 0.1531 x + 0.0434 x^2 - 0.945 x^3 + 1.2388 x^4 - 0.4903 x^5.
///
/// x in [0, 1] is the share of small grains; pure = c_rcp(0) = c_rcp(1), 0 < pure < 0.95. Largest for
/// x = 0.375, by 0.0345.
/// Source: the thesis named in docs/evidence/packing.md, eq. (2.98), after Kyrylyuk et al. (2010).
template <Real Scalar>
struct PackingPolynomial {
  static constexpr std::string_view kName = "polynomial";
  static constexpr std::string_view kFormula =
      "pure + 0.1531 x + 0.0434 x^2 - 0.945 x^3 + 1.2388 x^4 - 0.4903 x^5";

  Scalar pure = packing_of_spheres<Scalar>();

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"pure", Range::positive, true, Measure::number, {.high = 0.95}}, self.pure);
  }
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  [[nodiscard]] Scalar value(const Scalar& x) const {
    const auto c = [](int k) { return Scalar(k) / Scalar(10000); };
    return pure + x * (c(1531) + x * (c(434) + x * (c(-9450) + x * (c(12388) + x * c(-4903)))));
  }
  [[nodiscard]] Scalar derivative(const Scalar& x) const {
    const auto c = [](int k) { return Scalar(k) / Scalar(10000); };
    return c(1531) + x * (c(2 * 434) + x * (c(3 * -9450) + x * (c(4 * 12388) + x * c(5 * -4903))));
  }
  [[nodiscard]] static std::vector<Scalar> kinks() { return {}; }

  static std::vector<PackingPolynomial> samples() { return {{}, {Scalar(0.55)}}; }
};

}  // namespace shearfront
