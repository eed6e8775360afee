// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Piecewise constant shear rate: a(z) = values[k] for breaks[k-1] < z < breaks[k].
///
/// Domain: breaks strictly increasing inside (bottom, top), values > 0 (1/time when s = 1), one value more
/// than breaks; any number of layers, rising or falling. Source: May, Shearer & Daniels (2010), Section 3;
/// Buerger, Martinez & Villada (2023), eq. (1.12).
template <Real Scalar>
struct Piecewise {
  static constexpr std::string_view kName = "piecewise";
  static constexpr std::string_view kFormula = "values[k] between breaks[k-1] and breaks[k]";
  static constexpr bool kIsLayered = true;  ///< constant between knots(): solvers use it as it is

  std::vector<Scalar> breaks, values;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "breaks", .measure = Measure::height, .also = "inside the domain, ascending"},
          self.breaks);
    visit(FieldInfo{"values", Range::positive}, self.values);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    check_breaks(prefix + "breaks", breaks, bottom, top, complaints);
    if (values.size() != breaks.size() + 1)
      complaints.push_back(
          wrong_length(prefix + "values", values.size(),
                       "must have one entry more than breaks (" + std::to_string(breaks.size() + 1) + ")"));
  }

  /// a(z); at a break the value above it.
  [[nodiscard]] Scalar value(const Scalar& z) const {
    const auto k = std::upper_bound(breaks.begin(), breaks.end(), z) - breaks.begin();
    return values[static_cast<std::size_t>(k)];
  }
  /// Harmonic mean of a over [lo, hi], which must not contain a knot inside.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& /*hi*/) const { return value(lo); }
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& lo, const Scalar& /*hi*/, Add&& add) const {
    const auto k = std::upper_bound(breaks.begin(), breaks.end(), lo) - breaks.begin();
    add(breaks.size() + static_cast<std::size_t>(k), Scalar(1));
  }
  [[nodiscard]] std::vector<std::size_t> knot_entries() const {
    std::vector<std::size_t> entries(breaks.size());
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = i;
    return entries;
  }
  /// Heights where a or its slope jumps.
  [[nodiscard]] std::vector<Scalar> knots() const { return breaks; }

  static std::vector<Piecewise> samples() {
    return {{{Scalar(0.29)}, {Scalar(2.4), Scalar(0.31)}},
            {{}, {Scalar(1)}},
            {{Scalar(0.25), Scalar(0.5), Scalar(0.75)}, {Scalar(0.5), Scalar(2), Scalar(1), Scalar(4)}}};
  }
};

}  // namespace shearfront
