// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/model/field.hpp"

namespace shearfront {

/// Tabulated shear rate: linear between the points (z[i], values[i]), monotone or not.
///
/// Domain: at least two points, z strictly increasing, z.front() <= bottom and z.back() >= top, values > 0.
template <Real Scalar>
struct Table {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kFormula = "linear between the points (z[i], values[i])";
  static constexpr bool kIsLayered = false;

  std::vector<Scalar> z, values;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"z"}, self.z);
    visit(FieldInfo{"values", Range::positive}, self.values);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top, Complaints& complaints) const {
    check_points(prefix, z, values.size(), bottom, top, complaints);
  }

  [[nodiscard]] Scalar value(const Scalar& height) const {
    const std::size_t i = segment(height);
    const Scalar w = (height - z[i]) / (z[i + 1] - z[i]);
    return values[i] + w * (values[i + 1] - values[i]);
  }
  /// Harmonic mean over [lo, hi], which must not contain a knot inside: the logarithmic mean of the two end
  /// values.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    using std::log1p;
    const std::size_t i = segment(lo);
    // By weights in [0, 1]: a slope times a distance may leave the range where points lie next to each other.
    const auto at = [&](const Scalar& height) {
      const Scalar w = (height - z[i]) / (z[i + 1] - z[i]);
      return Scalar(values[i] + w * (values[i + 1] - values[i]));
    };
    const Scalar a_lo = at(lo), x = (at(hi) - a_lo) / a_lo;  // relative rise over [lo, hi], > -1
    return x == 0 ? a_lo : a_lo * (x / log1p(x));
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return z; }

  static std::vector<Table> samples() {
    return {
        {{Scalar(0), Scalar(1)}, {Scalar(2), Scalar(0.5)}},
        {{Scalar(0), Scalar(0.3), Scalar(0.6), Scalar(1)}, {Scalar(1), Scalar(3), Scalar(0.4), Scalar(0.9)}}};
  }

 private:
  [[nodiscard]] std::size_t segment(const Scalar& height) const {
    const auto it = std::upper_bound(z.begin() + 1, z.end() - 1, height);
    return static_cast<std::size_t>(it - z.begin()) - 1;
  }
};

}  // namespace shearfront
