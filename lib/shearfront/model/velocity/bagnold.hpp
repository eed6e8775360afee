// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/depth/bagnold.hpp"
#include "shearfront/model/field.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Steady flow down a slope by the mu(I) law, without slip on the ground and with a free surface (Bagnold's profile):
///
///   u = (2/3) (I / grain) sqrt(gravity cos(angle)) (h^(3/2) - (surface - z)^(3/2)),   h = surface - ground,
///   I = inertial_number (tan(angle) - static_friction) / (static_friction + friction_range - tan(angle)).
///
/// Domain: angle in radian with static_friction < tan(angle) < static_friction + friction_range; grain (a length), gravity
/// > 0; ground <= bottom, surface >= top. Source: GDR MiDi (2004), Eur. Phys. J. E 14, 341-365; Jop, Forterre & Pouliquen
/// (2006), Nature 441, 727-730.
template <Real Scalar>
struct BagnoldVelocity {
  static constexpr std::string_view kName = "bagnold";
  static constexpr std::string_view kFormula =
      "(2/3) (I / grain) sqrt(gravity cos(angle)) ((surface - ground)^(3/2) - (surface - z)^(3/2))";

  Scalar angle{0}, grain{1}, static_friction{0.38}, friction_range{0.26}, inertial_number{0.3}, gravity{9.81},
      ground{0}, surface{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"angle", Range::positive}, self.angle);
    visit(FieldInfo{"grain", Range::positive}, self.grain);
    visit(FieldInfo{"static_friction", Range::positive, true}, self.static_friction);
    visit(FieldInfo{"friction_range", Range::positive, true}, self.friction_range);
    visit(FieldInfo{"inertial_number", Range::positive, true}, self.inertial_number);
    visit(FieldInfo{"gravity", Range::positive, true}, self.gravity);
    visit(FieldInfo{.key = "ground", .is_optional = true, .measure = Measure::height}, self.ground);
    visit(FieldInfo{.key = "surface", .measure = Measure::height}, self.surface);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    shear_rate().check(prefix, bottom, surface, complaints);
    if (ground > bottom)
      complaints.push_back({prefix + "ground", number_text(ground),
                            "must not lie above the bottom of the domain (" + number_text(bottom) + ")"});
    if (surface < top)
      complaints.push_back({prefix + "surface", number_text(surface),
                            "must not lie below the top of the domain (" + number_text(top) + ")"});
  }

  [[nodiscard]] Scalar value(const Scalar& z) const { return shear_rate().velocity(ground, z); }
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const {
    const Scalar h = surface - ground;
    return Scalar(2) / Scalar(3) * shear_rate().factor() *
           (power(h, 3) * (hi - lo) -
            Scalar(2) / Scalar(5) * (power(Scalar(surface - lo), 5) - power(Scalar(surface - hi), 5)));
  }
  /// A root of degree five: by halving, to rounding.
  [[nodiscard]] Scalar height_of(const Scalar& lo, const Scalar& amount) const {
    Scalar below = lo, above = surface;
    for (int i = 0; i < std::numeric_limits<Scalar>::digits + 8 && below < above; ++i) {
      const Scalar z = below + (above - below) / Scalar(2);
      (flow(lo, z) < amount ? below : above) = z;
    }
    return below + (above - below) / Scalar(2);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  static std::vector<BagnoldVelocity> samples() {
    BagnoldVelocity slope{Scalar(0.43), Scalar(0.04)}, deep = slope;
    slope.gravity = Scalar(1);
    deep.surface = Scalar(2), deep.ground = Scalar(-0.5);
    return {slope, deep};
  }

 private:
  /// y^(n/2), n odd; 0 where rounding has led above the surface.
  [[nodiscard]] static Scalar power(const Scalar& y, int n) {
    using std::sqrt;
    if (!(y > 0)) return Scalar(0);
    Scalar x = sqrt(y);
    for (; n > 1; n -= 2) x *= y;
    return x;
  }
  /// Of the same layer.
  [[nodiscard]] Bagnold<Scalar> shear_rate() const {
    Bagnold<Scalar> a;
    a.angle = angle, a.grain = grain, a.gravity = gravity;
    a.static_friction = static_friction, a.friction_range = friction_range,
    a.inertial_number = inertial_number;
    a.prepare(ground, surface);
    return a;
  }
};

}  // namespace shearfront
