// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A measured velocity: linear between the points (z[i], values[i]).
///
/// Domain: at least two points, z strictly increasing, z.front() <= bottom and z.back() >= top.
template <Real Scalar>
struct TableVelocity {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kFormula = "linear between the points (z[i], values[i])";

  std::vector<Scalar> z, values;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "z", .measure = Measure::height}, self.z);
    visit(FieldInfo{"values"}, self.values);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    check_points(prefix, z, values.size(), bottom, top, complaints);
  }

  [[nodiscard]] Scalar value(const Scalar& height) const { return in_segment(segment(height), height); }
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const {
    Scalar sum(0), from = lo;
    for (std::size_t i = segment(lo);; ++i) {
      const Scalar to = i + 2 < z.size() ? std::min(z[i + 1], hi) : hi;
      sum += (to - from) * (in_segment(i, from) + in_segment(i, to)) / Scalar(2);
      if (!(to < hi)) return sum;
      from = to;
    }
  }
  /// As for a linear velocity in the segment where the amount is reached.
  [[nodiscard]] Scalar height_of(const Scalar& lo, const Scalar& amount) const {
    using std::sqrt;
    Scalar left = amount, from = lo;
    for (std::size_t i = segment(lo);; ++i) {
      const bool is_last = i + 2 >= z.size();
      const Scalar u = in_segment(i, from),
                   here =
                       is_last ? left : Scalar((z[i + 1] - from) * (u + in_segment(i, z[i + 1])) / Scalar(2));
      if (!is_last && left > here) {
        left -= here;
        from = z[i + 1];
        continue;
      }
      if (!(left > 0)) return from;
      const Scalar slope = (values[i + 1] - values[i]) / (z[i + 1] - z[i]);
      const Scalar square = u * u + Scalar(2) * slope * left;
      return from + Scalar(2) * left / (u + (square > 0 ? Scalar(sqrt(square)) : Scalar(0)));
    }
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return z; }

  static std::vector<TableVelocity> samples() {
    return {{{Scalar(0), Scalar(1)}, {Scalar(0), Scalar(2)}},
            {{Scalar(0), Scalar(0.3), Scalar(0.6), Scalar(1)},
             {Scalar(0.5), Scalar(1.5), Scalar(0.25), Scalar(0.75)}}};
  }

 private:
  [[nodiscard]] std::size_t segment(const Scalar& height) const {
    const auto it = std::upper_bound(z.begin() + 1, z.end() - 1, height);
    return static_cast<std::size_t>(it - z.begin()) - 1;
  }
  [[nodiscard]] Scalar in_segment(std::size_t i, const Scalar& height) const {
    const Scalar w = (height - z[i]) / (z[i + 1] - z[i]);
    return values[i] + w * (values[i + 1] - values[i]);
  }
};

}  // namespace shearfront
