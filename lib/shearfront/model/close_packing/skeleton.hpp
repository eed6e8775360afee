// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/close_packing/model.hpp"

namespace shearfront {

/// Copy this file to model/close_packing/<name>.hpp, rename the struct, fill in the formula, and add one line to
/// model/close_packing/all.hpp. Say here: the formula, for which grains it holds, its domain, the source.
/// This copy is a law that does not see the mixture, so that it compiles and passes the laws as it stands.
template <Real Scalar>
struct SkeletonClosePacking {
  static constexpr std::string_view kName = "skeleton";  ///< close_packing.model in scene files
  static constexpr std::string_view kFormula = "pure";   ///< for `shearfront list`

  Scalar pure = packing_of_spheres<Scalar>();

  /// Entries of the [close_packing] table, in the order of a scene file. Members: Scalar or
  /// std::vector<Scalar>.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"pure", Range::positive, true, Measure::number, {.high = 1}}, self.pure);
  }
  /// Whatever else must hold; that numbers are finite and in their Range is checked already.
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  [[nodiscard]] Scalar value(const Scalar& /*x*/) const { return pure; }
  [[nodiscard]] Scalar derivative(const Scalar& /*x*/) const { return Scalar(0); }
  [[nodiscard]] static std::vector<Scalar> kinks() { return {}; }

  static std::vector<SkeletonClosePacking> samples() { return {{}}; }
};

}  // namespace shearfront
