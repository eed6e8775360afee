// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/depth/model.hpp"
#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Shear rate of a steady layer on a slope after the mu(I) law, no slip at its ground, free at its surface:
///
///     a(z) = (I / grain) sqrt(gravity cos(angle) (surface - z)),
///     I = inertial_number (tan(angle) - static_friction) / (static_friction + friction_range - tan(angle)).
///
/// Its velocity is u(z) = (2/3) (I / grain) sqrt(gravity cos(angle)) ((surface - ground)^(3/2) - (surface - z)^(3/2)). The scale s of the
/// scene is a length; gravity normal to the layer is gravity cos(angle).
/// Domain: angle in radian, static_friction < tan(angle) < static_friction + friction_range, or there is no steady flow; all others > 0;
/// surface not below the top of the domain, its top if not given (or 0). a vanishes at the surface, where a^2 is linear. Source: Jop,
/// Forterre & Pouliquen (2006), Nature 441, 727; numbers of glass beads there. Bagnold (1954).
template <Real Scalar>
struct Bagnold {
  static constexpr std::string_view kName = "bagnold";
  static constexpr std::string_view kFormula =
      "(I/grain) sqrt(gravity cos(angle) (surface - z)), angle in radian";
  static constexpr bool kIsLayered = false;
  static constexpr bool kIsRoot = true;
  static constexpr bool kIsGuessable = false;

  Scalar angle{0}, grain{0}, static_friction{0.38}, friction_range{0.26}, inertial_number{0.3}, gravity{9.81};
  Scalar surface{0};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "angle", .range = Range::positive, .also = "with steady flow"}, self.angle);
    visit(FieldInfo{"grain", Range::positive}, self.grain);
    visit(FieldInfo{"static_friction", Range::positive, true}, self.static_friction);
    visit(FieldInfo{"friction_range", Range::positive, true}, self.friction_range);
    visit(FieldInfo{"inertial_number", Range::positive, true}, self.inertial_number);
    visit(FieldInfo{"gravity", Range::positive, true}, self.gravity);
    visit(
        FieldInfo{
            .key = "surface", .is_optional = true, .measure = Measure::height, .also = "not below the top"},
        self.surface);
  }
  void prepare(const Scalar& /*bottom*/, const Scalar& top) { top_ = top; }
  void check(const std::string& prefix, const Scalar& /*bottom*/, const Scalar& top,
             Complaints& complaints) const {
    using std::atan, std::tan;
    const Scalar least = atan(static_friction), most = atan(Scalar(static_friction + friction_range));
    if (static_friction > 0 && friction_range > 0 && is_finite(angle) && !(angle > least && angle < most)) {
      const auto degrees = [](const Scalar& x) { return number_text(to_double(x) * 57.29577951308232, 4); };
      complaints.push_back({prefix + "angle", number_text(angle),
                            "must be between " + number_text(to_double(least), 6) + " and " +
                                number_text(to_double(most), 6) + " radian (" + degrees(least) + " and " +
                                degrees(most) + " degrees): no steady flow at any other angle"});
    }
    if (is_finite(surface) && surface != 0 && surface < top)
      complaints.push_back({prefix + "surface", number_text(surface),
                            "must not lie below the top of the domain (" + number_text(top) + ")"});
  }

  [[nodiscard]] Scalar value(const Scalar& z) const { return factor() * root(z); }
  /// Exact, and positive up to the surface.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    return factor() * (root(lo) + root(hi)) / Scalar(2);
  }
  /// Whether a is 0 at z.
  [[nodiscard]] bool vanishes_at(const Scalar& z) const { return !(z < free_surface()); }
  /// Where in [lo, hi], as a part of it, the slowness 1 / a has its centre of mass.
  [[nodiscard]] Scalar slowness_place(const Scalar& lo, const Scalar& hi) const {
    const Scalar low = root(lo), high = root(hi);
    return low > 0 ? Scalar((Scalar(2) * low + high) / (Scalar(3) * (low + high))) : Scalar(0.5);
  }
  [[nodiscard]] Scalar depth(const Scalar& z) const { return free_surface() - z; }
  template <class Add>
  void add_depth(const Add& add) const {
    if (surface != 0) add(std::size_t{6}, Scalar(1));
  }
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& lo, const Scalar& hi, Add&& add) const {
    add_factor(harmonic_mean(lo, hi), add);
    if (surface != 0) add(6, Scalar(factor() * (by_surface(lo) + by_surface(hi)) / Scalar(2)));
  }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const auto at = [&](const Scalar& z, auto& add) {
      add_factor(value(z), add);
      if (surface != 0) add(6, Scalar(factor() * by_surface(z)));
    };
    at(lo, add_low);
    at(hi, add_high);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  /// (I / grain) sqrt(gravity cos(angle)): a at a depth of 1.
  [[nodiscard]] Scalar factor() const {
    using std::cos, std::sqrt, std::tan;
    const Scalar t = tan(angle);
    const Scalar I = inertial_number * (t - static_friction) / ((static_friction - t) + friction_range);
    return I / grain * sqrt(Scalar(gravity * cos(angle)));
  }
  /// u(z) - u(ground).
  [[nodiscard]] Scalar velocity(const Scalar& ground, const Scalar& z) const {
    const Scalar low = root(ground), high = root(z);
    return Scalar(2) / Scalar(3) * factor() * (low * low * low - high * high * high);
  }

  static std::vector<Bagnold> samples() {
    const auto make = [](double slope, double diameter, double g, double top) {
      Bagnold a;
      a.angle = Scalar(slope), a.grain = Scalar(diameter), a.gravity = Scalar(g), a.surface = Scalar(top);
      return a;
    };
    return {make(0.43, 0.04, 1, 1), make(0.5, 0.01, 9.81, 1.25)};
  }

 private:
  [[nodiscard]] const Scalar& free_surface() const { return surface != 0 ? surface : top_; }
  [[nodiscard]] Scalar root(const Scalar& z) const {
    using std::sqrt;
    const Scalar depth = free_surface() - z;
    return depth > 0 ? Scalar(sqrt(depth)) : Scalar(0);
  }
  /// Of the square root of the depth; the surface itself is left out, where it has none.
  [[nodiscard]] Scalar by_surface(const Scalar& z) const {
    const Scalar r = root(z);
    return r > 0 ? Scalar(Scalar(1) / (Scalar(2) * r)) : Scalar(0);
  }
  template <class Add>
  void add_factor(const Scalar& value, Add& add) const {
    using std::tan;
    const Scalar one(1), t = tan(angle), over = one / (t - static_friction),
                         under = one / ((static_friction - t) + friction_range);
    add(0, Scalar(value * ((over + under) * (one + t * t) - t / Scalar(2))));
    add(1, Scalar(-value / grain));
    add(2, Scalar(-value * (over + under)));
    add(3, Scalar(-value * under));
    add(4, Scalar(value / inertial_number));
    add(5, Scalar(value / (Scalar(2) * gravity)));
  }

  Scalar top_{1};
};

}  // namespace shearfront
