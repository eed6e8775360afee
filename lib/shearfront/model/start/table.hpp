// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A measured profile: linear between the points (z[i], values[i]).
///
/// Domain: at least two points, z strictly increasing, z.front() <= bottom and z.back() >= top.
template <Real Scalar>
struct TableInitial {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kFormula = "linear between the points (z[i], values[i])";

  std::vector<Scalar> z, values;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "z", .measure = Measure::height, .also = "from bottom to top, ascending"}, self.z);
    visit(FieldInfo{.key = "values", .measure = Measure::state, .also = "states of the flux"}, self.values);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    check_points(prefix, z, values.size(), bottom, top, complaints);
  }
  [[nodiscard]] Scalar lowest() const { return *std::min_element(values.begin(), values.end()); }
  [[nodiscard]] Scalar highest() const { return *std::max_element(values.begin(), values.end()); }

  [[nodiscard]] Scalar value(const Scalar& height) const {
    const std::size_t i = segment(height);
    const Scalar w = (height - z[i]) / (z[i + 1] - z[i]);
    const auto [low, high] = std::minmax(values[i], values[i + 1]);
    return std::clamp(Scalar(values[i] + w * (values[i + 1] - values[i])), Scalar(low), Scalar(high));
  }
  /// int_lo^hi phi dz. Cost: O(points in between).
  [[nodiscard]] Scalar integral(const Scalar& lo, const Scalar& hi) const {
    Scalar sum(0), from = lo;
    for (std::size_t i = segment(lo) + 1; i + 1 < z.size() && z[i] < hi; ++i) {
      sum += (z[i] - from) * ((value(from) + values[i]) / Scalar(2));
      from = z[i];
    }
    return sum + (hi - from) * ((value(from) + value(hi)) / Scalar(2));
  }
  [[nodiscard]] Scalar slope(const Scalar& /*height*/, const Scalar& middle) const {
    return slope_of(segment(middle));
  }
  /// Of a knot the line on each side moves with it: -slope times its share there.
  template <class Add>
  void derivatives(const Scalar& lo, const Scalar& height, const Add& add) const {
    const std::size_t n = z.size(), last = segment(height);
    std::vector<Scalar> by_z(n, Scalar(0)), by_value(n, Scalar(0));
    for (std::size_t i = segment(lo); i <= last; ++i) {
      const Scalar from = std::max(lo, z[i]), to = i == last ? height : z[i + 1], width = z[i + 1] - z[i];
      const Scalar d = to - from, share = ((from - z[i]) + (to - z[i])) / (Scalar(2) * width);  // mean
      const Scalar upper = d * share, lower = d - upper, steep = slope_of(i);
      by_value[i] += lower;
      by_value[i + 1] += upper;
      by_z[i] -= steep * lower;
      by_z[i + 1] -= steep * upper;
    }
    const Scalar w = (height - z[last]) / (z[last + 1] - z[last]), steep = slope_of(last);
    for (std::size_t i = 0; i < n; ++i) {
      const Scalar part = i == last ? Scalar(Scalar(1) - w) : i == last + 1 ? w : Scalar(0);
      add(i, Scalar(-steep * part), by_z[i]);
      add(n + i, part, by_value[i]);
    }
  }
  [[nodiscard]] std::vector<Scalar> knots(const Scalar& lo, const Scalar& hi) const {
    const auto first = std::upper_bound(z.begin(), z.end(), lo),
               end = std::lower_bound(z.begin(), z.end(), hi);
    if (!(first < end)) return {};  // none in between, as where lo = hi is one
    return {first, end};
  }

  static std::vector<TableInitial> samples() {
    return {
        {{Scalar(0), Scalar(1)}, {Scalar(0.25), Scalar(0.75)}},
        {{Scalar(0), Scalar(0.3), Scalar(0.6), Scalar(1)}, {Scalar(0), Scalar(0.5), Scalar(0.4), Scalar(1)}}};
  }

 private:
  [[nodiscard]] Scalar slope_of(std::size_t i) const {
    return (values[i + 1] - values[i]) / (z[i + 1] - z[i]);
  }
  [[nodiscard]] std::size_t segment(const Scalar& height) const {
    const auto it = std::upper_bound(z.begin() + 1, z.end() - 1, height);
    return static_cast<std::size_t>(it - z.begin()) - 1;
  }
};

}  // namespace shearfront
