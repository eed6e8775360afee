// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/field.hpp"

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
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top, Problems& problems) const {
    if (z.size() < 2)
      problems.push_back(
          {prefix + "z", "(" + std::to_string(z.size()) + " entries)", "must have at least 2 entries"});
    if (values.size() != z.size())
      problems.push_back({prefix + "values", "(" + std::to_string(values.size()) + " entries)",
                          "must have as many entries as z (" + std::to_string(z.size()) + ")"});
    for (std::size_t i = 1; i < z.size(); ++i)
      if (is_finite(z[i]) && is_finite(z[i - 1]) && !(z[i] > z[i - 1]))
        problems.push_back({prefix + "z[" + std::to_string(i) + "]", number_text(z[i]),
                            "must be greater than the entry before it (" + number_text(z[i - 1]) + ")"});
    if (!z.empty() && z.front() > bottom)
      problems.push_back({prefix + "z[0]", number_text(z.front()),
                          "must not lie above the bottom of the domain (" + number_text(bottom) + ")"});
    if (z.size() > 1 && z.back() < top)
      problems.push_back({prefix + "z[" + std::to_string(z.size() - 1) + "]", number_text(z.back()),
                          "must not lie below the top of the domain (" + number_text(top) + ")"});
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
