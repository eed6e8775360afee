// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Linear shear rate: a(z) = ground + slope z.
///
/// Domain: slope in 1/(time times length) when s = 1, positive or negative; a(z) > 0 on the whole domain.
template <Real Scalar>
struct Linear {
  static constexpr std::string_view kName = "linear";
  static constexpr std::string_view kFormula = "ground + slope z";
  static constexpr bool kIsLayered = false;

  Scalar ground{1}, slope{0};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"ground"}, self.ground);
    visit(FieldInfo{"slope"}, self.slope);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    for (const Scalar& z : {bottom, top})
      if (!(value(z) > 0))
        complaints.push_back(
            {prefix + "slope", number_text(slope),
             "must keep a(z) positive (a(" + number_text(z) + ") = " + number_text(value(z)) + ")"});
  }

  [[nodiscard]] Scalar value(const Scalar& z) const { return ground + slope * z; }
  /// The logarithmic mean of the two end values, free of cancellation for thin layers.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    using std::log1p;
    const Scalar rise = slope * (hi - lo) / value(lo);
    return rise == 0 ? value(lo) : value(lo) * rise / log1p(rise);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  static std::vector<Linear> samples() { return {{Scalar(2), Scalar(-1)}, {Scalar(0.5), Scalar(3)}}; }
};

}  // namespace shearfront
