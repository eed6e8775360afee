// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Simple shear: u = slip + slope z, of any sign. With slip = alpha and slope = 2 (1 - alpha) the mean over 0 < z < 1 is 1.
template <Real Scalar>
struct LinearVelocity {
  static constexpr std::string_view kName = "linear";
  static constexpr std::string_view kFormula = "slip + slope z";

  Scalar slip{0}, slope{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "slip", .is_optional = true}, self.slip);
    visit(FieldInfo{"slope"}, self.slope);
  }
  static void check(const std::string& /*prefix*/, const Scalar& /*bottom*/, const Scalar& /*top*/,
                    Complaints&) {}

  [[nodiscard]] Scalar value(const Scalar& z) const { return slip + slope * z; }
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const {
    return (hi - lo) * (value(lo) + value(hi)) / Scalar(2);
  }
  /// u d + slope d^2 / 2 = amount, by the root that does not cancel.
  [[nodiscard]] Scalar height_of(const Scalar& lo, const Scalar& amount) const {
    using std::sqrt;
    const Scalar u = value(lo), square = u * u + Scalar(2) * slope * amount;
    const Scalar sum = u + (square > 0 ? Scalar(sqrt(square)) : Scalar(0));
    return amount > 0 ? Scalar(lo + Scalar(2) * amount / sum) : lo;
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  static std::vector<LinearVelocity> samples() {
    return {{Scalar(0), Scalar(2)}, {Scalar(0.5), Scalar(1)}, {Scalar(1.25), Scalar(-1)}};
  }
};

}  // namespace shearfront
