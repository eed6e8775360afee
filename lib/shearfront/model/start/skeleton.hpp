// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Copy this file to model/start/<name>.hpp, rename the struct, fill in the formula, and add one line to
/// model/start/all.hpp. Say here: the formula, the domain and unit of every entry. This copy is a uniform bed,
/// so that it compiles and passes the laws of initial states as it stands.
template <Real Scalar>
struct SkeletonInitial {
  static constexpr std::string_view kName = "skeleton";  ///< initial.model in scene files
  static constexpr std::string_view kFormula = "level";  ///< for `shearfront list`

  Scalar level{0.5};

  /// Entries of the [initial] table, in the order of a scene file. Members: Scalar or std::vector<Scalar>.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "level", .measure = Measure::state}, self.level);
  }
  /// Whatever must hold between entries; single numbers are checked by their Range, states by lowest(),
  /// highest().
  static void check(const std::string& /*prefix*/, const Scalar& /*bottom*/, const Scalar& /*top*/,
                    Complaints&) {}
  /// The range of phi, at least.
  [[nodiscard]] Scalar lowest() const { return level; }
  [[nodiscard]] Scalar highest() const { return level; }

  [[nodiscard]] Scalar value(const Scalar& /*z*/) const { return level; }
  /// int_lo^hi phi dz.
  [[nodiscard]] Scalar integral(const Scalar& lo, const Scalar& hi) const { return level * (hi - lo); }

  /// Heights inside (lo, hi), ascending, between which phi and its slope are monotone: where phi turns, bends the other way, or
  /// has a kink.
  [[nodiscard]] std::vector<Scalar> knots(const Scalar& /*lo*/, const Scalar& /*hi*/) const { return {}; }

  static std::vector<SkeletonInitial> samples() { return {{Scalar(0.5)}}; }
};

}  // namespace shearfront
