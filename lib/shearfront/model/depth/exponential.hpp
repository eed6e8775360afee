// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/depth/model.hpp"
#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Exponential shear rate: a(z) = amplitude exp(-z / decay).
///
/// Domain: amplitude > 0 (1/time when s = 1), decay > 0 (the length in which a falls by e; the unit of z).
/// Source: May, Shearer & Daniels (2010), Section 4; amplitude = k1 / k2, decay = k2 in Buerger et al.
/// (2023), Example 5.
template <Real Scalar>
struct Exponential {
  static constexpr std::string_view kName = "exponential";
  static constexpr std::string_view kFormula = "amplitude exp(-z / decay)";
  static constexpr bool kIsLayered = false;
  static constexpr bool kIsExponential = true;

  Scalar amplitude{1}, decay{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"amplitude", Range::positive}, self.amplitude);
    visit(FieldInfo{.key = "decay", .range = Range::positive, .also = "a(z) a positive number"}, self.decay);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    if (!(amplitude > 0) || !(decay > 0) || !is_finite(amplitude) || !is_finite(decay))
      return;  // reported elsewhere
    for (const Scalar& z : {bottom, top}) {
      if (const Scalar a = value(z); !(a > 0) || !is_finite(a))
        complaints.push_back({prefix + "decay", number_text(decay),
                              "must keep a(z) a positive finite number on the whole domain (a(" +
                                  number_text(z) + ") = " + number_text(a) + ")"});
    }
  }

  [[nodiscard]] Scalar value(const Scalar& z) const {
    using std::exp;
    return amplitude * exp(-z / decay);
  }
  /// (hi - lo) / int_lo^hi dz / a, free of cancellation for thin layers.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    using std::expm1;
    const Scalar h = (hi - lo) / decay;
    return h > 0 ? value(lo) * h / expm1(h) : value(lo);
  }
  /// With h = (hi - lo) / decay the mean is a(lo) h / (e^h - 1); its logarithm changes with the decay by
  /// lo / decay^2 + (h / decay) g(h), g = e^h / (e^h - 1) - 1 / h.
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& lo, const Scalar& hi, Add&& add) const {
    const Scalar mean = harmonic_mean(lo, hi), h = (hi - lo) / decay;
    add(0, mean / amplitude);
    add(1, mean * (lo / decay + h * exponential_mean_place(h)) / decay);
  }
  /// Where in [lo, hi], as a part of it, the slowness 1 / a has its centre of mass.
  [[nodiscard]] Scalar slowness_place(const Scalar& lo, const Scalar& hi) const {
    return exponential_mean_place(Scalar((hi - lo) / decay));
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const auto at = [&](const Scalar& z, auto& add) {
      const Scalar a = value(z);
      add(0, Scalar(a / amplitude));
      add(1, Scalar(a * (z / decay) / decay));
    };
    at(lo, add_low);
    at(hi, add_high);
  }

  static std::vector<Exponential> samples() {
    return {
        {Scalar(0.87) / Scalar(0.205), Scalar(0.205)}, {Scalar(1), Scalar(10)}, {Scalar(2), Scalar(0.05)}};
  }
};

}  // namespace shearfront
