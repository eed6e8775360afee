// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Copy this file to model/velocity/<name>.hpp, rename the struct, fill in the formula, and add one line to
/// model/velocity/all.hpp. Say here: the formula, the domain and unit of every entry, the source. This copy is uniform, so
/// that it compiles and passes the laws of velocities as it stands.
template <Real Scalar>
struct SkeletonVelocity {
  static constexpr std::string_view kName = "skeleton";  ///< velocity.model in scene files
  static constexpr std::string_view kFormula = "speed";  ///< for `shearfront list`

  Scalar speed{1};

  /// Entries of the [velocity] table, in the order of a scene file. Members: Scalar or std::vector<Scalar>.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"speed", Range::positive}, self.speed);
  }
  /// Whatever must hold between entries; that u >= 0 is checked for all models at the ends and the knots, between which u
  /// must be monotone.
  static void check(const std::string& /*prefix*/, const Scalar& /*bottom*/, const Scalar& /*top*/,
                    Complaints&) {}

  [[nodiscard]] Scalar value(const Scalar& /*z*/) const { return speed; }
  /// int_lo^hi u dz, lo <= hi.
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const { return speed * (hi - lo); }
  /// The height z >= lo up to which flow(lo, z) is `amount` >= 0. Precondition: u > 0 above lo; no more flows than there is.
  [[nodiscard]] Scalar height_of(const Scalar& lo, const Scalar& amount) const { return lo + amount / speed; }
  /// Heights where u or its slope jumps, or u is largest or smallest; ascending.
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  // A model may also have static constexpr bool kIsUniform = true: u is the same at every height.

  static std::vector<SkeletonVelocity> samples() { return {{Scalar(1)}, {Scalar(3)}}; }
};

}  // namespace shearfront
