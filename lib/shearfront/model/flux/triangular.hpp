// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Triangular traffic flux: f(rho) = rho up to the critical density, then down to 0 at the jam density,
///
///   f(rho) = min(rho, critical (jam - rho) / (jam - critical)).
///
/// Domain: density rho in [0, jam], 0 < critical < jam. Concave, not strictly: free traffic moves with the
/// speed a(z), jams with -a(z) critical / (jam - critical), and nothing fans out.
/// Source: Newell (1993), Transp. Res. B 27, 281-287.
template <Real Scalar>
struct Triangular {
  static constexpr std::string_view kName = "triangular";
  static constexpr std::string_view kFormula = "min(phi, critical (jam - phi) / (jam - critical))";
  static constexpr std::string_view kStates = "0 <= phi <= jam";
  static constexpr bool kIsParabola = false;
  static constexpr int kDegree = 1;

  Scalar critical{0.5}, jam{1};

  [[nodiscard]] StateRange<Scalar> range() const { return {Scalar(0), jam}; }
  [[nodiscard]] std::vector<Scalar> extrema() const { return {critical}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::concave; }
  [[nodiscard]] Scalar value(const Scalar& rho) const {
    return rho < critical ? rho : Scalar((jam - rho) * backward());
  }
  [[nodiscard]] Scalar derivative(const Scalar& rho) const {
    return rho < critical ? Scalar(1) : Scalar(-backward());
  }
  [[nodiscard]] static Scalar second_derivative(const Scalar& /*rho*/) { return Scalar(0); }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    const Scalar& lo = std::min(p, q);
    const Scalar& hi = std::max(p, q);
    if (!(lo < critical)) return -backward();
    if (!(hi > critical)) return Scalar(1);
    return ((critical - lo) - (hi - critical) * backward()) / (hi - lo);
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "critical", .range = Range::positive, .also = "less than jam"}, self.critical);
    visit(FieldInfo{"jam", Range::positive, true}, self.jam);
  }
  void check(const std::string& prefix, Complaints& complaints) const {
    if (critical > 0 && is_finite(critical) && is_finite(jam) && !(critical < jam))
      complaints.push_back({prefix + "critical", number_text(critical),
                            "must be less than " + prefix + "jam (" + number_text(jam) + ")"});
  }

  static std::vector<Triangular> samples() {
    return {{Scalar(0.5), Scalar(1)}, {Scalar(0.25), Scalar(1)}, {Scalar(0.03125), Scalar(0.125)}};
  }

 private:
  /// Speed of jams over the free speed.
  [[nodiscard]] Scalar backward() const { return critical / (jam - critical); }
};

}  // namespace shearfront
