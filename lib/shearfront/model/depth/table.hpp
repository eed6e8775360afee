// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/depth/model.hpp"
#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Tabulated shear rate: linear between the points (z[i], values[i]), monotone or not. A height given twice is a jump, with
/// the value below it first.
///
/// Domain: at least two points, z increasing, a height twice at most and not the first or last, z.front() <= bottom and z.back() >= top, values > 0:
/// on a straight line to 0 the time int dz / a would have no bound, so that no grain comes to its end and nothing ever rests.
template <Real Scalar>
struct Table {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kFormula = "linear between the points (z[i], values[i])";
  static constexpr bool kIsLayered = false;
  static constexpr bool kIsLinear = true;

  std::vector<Scalar> z, values;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "z", .measure = Measure::height, .also = "from bottom to top, ascending"}, self.z);
    visit(FieldInfo{"values", Range::positive}, self.values);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    // Solid fraction and temperature are continuous.
    const bool is_rate = prefix == "shear_rate.";
    check_points(prefix, z, values.size(), bottom, top, complaints, is_rate);
    for (std::size_t i = 0; is_rate && i < values.size(); ++i) {
      if (values[i] != 0) continue;
      const std::string key = prefix + "values[" + std::to_string(i) + "]";
      for (Complaint& complaint : complaints)
        if (complaint.key == key)
          complaint.constraint +=
              ": where a falls to 0 on a straight line no grain ever comes (int dz / a has no bound); "
              "bagnold "
              "falls to 0 as a root does";
    }
  }

  [[nodiscard]] Scalar value(const Scalar& height) const {
    const std::size_t i = segment(height);
    const Scalar w = (height - z[i]) / (z[i + 1] - z[i]);
    return values[i] + w * (values[i + 1] - values[i]);
  }
  [[nodiscard]] bool jumps_at(const Scalar& height) const {
    const auto range = std::equal_range(z.begin(), z.end(), height);
    if (range.second - range.first < 2) return false;
    const auto i = static_cast<std::size_t>(range.first - z.begin());
    return values[i] != values[i + 1];
  }
  /// a at both ends of [lo, hi], as seen from within.
  [[nodiscard]] EndValues<Scalar> end_values(const Scalar& lo, const Scalar& hi) const {
    const std::size_t i = segment(lo);
    const auto at = [&](const Scalar& height) {
      const Scalar w = (height - z[i]) / (z[i + 1] - z[i]);
      return w == 1 ? values[i + 1] : Scalar(values[i] + w * (values[i + 1] - values[i]));
    };
    return {at(lo), at(hi)};
  }
  /// Derivatives of the values at both ends of [lo, hi], which must not contain a knot inside: add_low(entry, by) and
  /// add_high(entry, by), in the order of fields(). The ends stay where they are; a knot at one of them moves out.
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const std::size_t i = segment(lo);
    const Scalar slope = (values[i + 1] - values[i]) / (z[i + 1] - z[i]);
    const auto at = [&](const Scalar& height, auto& add) {
      const Scalar right = (height - z[i]) / (z[i + 1] - z[i]),
                   left = (z[i + 1] - height) / (z[i + 1] - z[i]);
      add(i, Scalar(-slope * left));
      add(i + 1, Scalar(-slope * right));
      add(z.size() + i, left);
      add(z.size() + i + 1, right);
    };
    at(lo, add_low);
    at(hi, add_high);
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
  /// Where in [lo, hi], as a part of it, the slowness 1 / a has its centre of mass; no knot inside.
  [[nodiscard]] Scalar slowness_place(const Scalar& lo, const Scalar& hi) const {
    using std::log;
    const EndValues<Scalar> a = end_values(lo, hi);
    const Scalar fall = log(Scalar(a.low / a.high));
    return fall < 0 ? Scalar(Scalar(1) - exponential_mean_place(Scalar(-fall)))
                    : exponential_mean_place(fall);
  }
  /// By the values of a at both ends, which the two points around the interval determine: with y = log(other end /
  /// this end) the mean changes with the value at an end by (e^y - 1 - y) / y^2.
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& lo, const Scalar& hi, Add&& add) const {
    using std::log1p;
    const std::size_t i = segment(lo);
    const Scalar width = z[i + 1] - z[i], slope = (values[i + 1] - values[i]) / width;
    const Scalar w_lo = (lo - z[i]) / width, w_hi = (hi - z[i]) / width;
    const Scalar a_lo = values[i] + w_lo * (values[i + 1] - values[i]);
    const Scalar y = log1p(Scalar((w_hi - w_lo) * (values[i + 1] - values[i]) / a_lo));
    const Scalar by_lo = mean_weight(y), by_hi = mean_weight(Scalar(-y));
    const Scalar right = by_lo * w_lo + by_hi * w_hi, left = by_lo + by_hi - right;
    add(i, Scalar(-slope * left));
    add(i + 1, Scalar(-slope * right));
    add(z.size() + i, left);
    add(z.size() + i + 1, right);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return z; }
  [[nodiscard]] std::vector<std::size_t> knot_entries() const {
    std::vector<std::size_t> entries(z.size());
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = i;
    return entries;
  }

  static std::vector<Table> samples() {
    return {
        {{Scalar(0), Scalar(1)}, {Scalar(2), Scalar(0.5)}},
        {{Scalar(0), Scalar(0.3), Scalar(0.6), Scalar(1)}, {Scalar(1), Scalar(3), Scalar(0.4), Scalar(0.9)}},
        {{Scalar(0), Scalar(0.375), Scalar(0.375), Scalar(1)},
         {Scalar(2), Scalar(1.5), Scalar(0.5), Scalar(0.75)}}};
  }

 private:
  [[nodiscard]] std::size_t segment(const Scalar& height) const {
    const auto it = std::upper_bound(z.begin() + 1, z.end() - 1, height);
    return static_cast<std::size_t>(it - z.begin()) - 1;
  }
  /// (e^y - 1 - y) / y^2 = sum y^n / (n + 2)!.
  [[nodiscard]] static Scalar mean_weight(const Scalar& y) {
    using std::expm1;
    if (y > Scalar(1) || y < Scalar(-1)) return (expm1(y) - y) / (y * y);
    Scalar term(0.5), sum(0);
    for (int n = 0; n < 200; ++n) {
      sum += term;
      term *= y / Scalar(n + 3);
      if ((term < 0 ? Scalar(-term) : term) <= unit_roundoff<Scalar>() * sum) break;
    }
    return sum;
  }
};

}  // namespace shearfront
