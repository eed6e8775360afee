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

/// Shear in a chute, or what drives segregation there: a(z) = amplitude exp(|z - centre| / decay), least at
/// the centre.
///
/// Domain: amplitude > 0 (1/time when s = 1), decay > 0 (the unit of z); centre anywhere, its slope jumps
/// there. In the source the drift changes its sign at the centre: give the layers above it the flux `lwr`
/// with grains = "large", which is - phi (phi - 1). Source: Fan & Hill (2011), New J. Phys. 13, 095009,
/// kinetic stress of a vertical chute; Christov (2018), Section 5.
template <Real Scalar>
struct Chute {
  static constexpr std::string_view kName = "chute";
  static constexpr std::string_view kFormula = "amplitude exp(|z - centre| / decay)";
  static constexpr bool kIsLayered = false;
  static constexpr bool kIsExponential = true;

  Scalar amplitude{1}, decay{1}, centre{0};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"amplitude", Range::positive}, self.amplitude);
    visit(FieldInfo{.key = "decay", .range = Range::positive, .also = "a(z) a positive number"}, self.decay);
    visit(FieldInfo{"centre", Range::any, true, Measure::height}, self.centre);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    if (!(amplitude > 0) || !(decay > 0) || !is_finite(amplitude) || !is_finite(decay) || !is_finite(centre))
      return;  // reported elsewhere
    for (const Scalar& z : {bottom, top})
      if (const Scalar a = value(z); !is_finite(a))
        complaints.push_back({prefix + "decay", number_text(decay),
                              "must keep a(z) a positive finite number on the whole domain (a(" +
                                  number_text(z) + ") = " + number_text(a) + ")"});
  }

  [[nodiscard]] Scalar value(const Scalar& z) const {
    using std::exp;
    return amplitude * exp(distance(z) / decay);
  }
  /// (hi - lo) / int_lo^hi dz / a, free of cancellation for thin layers; no knot inside.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    using std::expm1;
    const Scalar h = (hi - lo) / decay;
    const Scalar& nearest = hi <= centre ? hi : lo;  // a is least there
    return h > 0 ? value(nearest) * h / -expm1(-h) : value(lo);
  }
  /// With h = (hi - lo) / decay and the distance r of the nearer end the mean is amplitude e^(r / decay) h / (1 -
  /// e^-h); its logarithm changes with the decay by -(r + (hi - lo) (1 - g(h))) / decay^2, g as for the exponential.
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& lo, const Scalar& hi, Add&& add) const {
    const bool is_below = hi <= centre;
    const Scalar mean = harmonic_mean(lo, hi), h = (hi - lo) / decay;
    const Scalar r = distance(is_below ? hi : lo) / decay;
    add(0, mean / amplitude);
    add(1, -mean * (r + h * (Scalar(1) - exponential_mean_place(h))) / decay);
    add(2, is_below ? Scalar(mean / decay) : Scalar(-mean / decay));
  }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const bool is_below = hi <= centre;
    const auto at = [&](const Scalar& z, auto& add) {
      const Scalar a = value(z), by_centre = a / decay;
      add(0, Scalar(a / amplitude));
      add(1, Scalar(-a * (distance(z) / decay) / decay));
      add(2, is_below ? by_centre : Scalar(-by_centre));
    };
    at(lo, add_low);
    at(hi, add_high);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {centre}; }

  static std::vector<Chute> samples() {
    return {{Scalar(1), Scalar(0.25), Scalar(0.5)}, {Scalar(0.5), Scalar(2), Scalar(0)}};
  }

 private:
  [[nodiscard]] Scalar distance(const Scalar& z) const { return z < centre ? centre - z : z - centre; }
};

}  // namespace shearfront
