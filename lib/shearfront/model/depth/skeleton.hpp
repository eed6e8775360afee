// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Copy this file to model/depth/<name>.hpp, rename the struct, fill in the formula, and add one line to
/// model/depth/all.hpp. Say here: the formula, the domain and unit of every entry, the source.
/// This copy is constant, so that it compiles and passes the laws of depth functions as it stands.
template <Real Scalar>
struct SkeletonDepthFunction {
  static constexpr std::string_view kName = "skeleton";  ///< shear_rate.model in scene files
  static constexpr std::string_view kFormula = "rate";   ///< for `shearfront list`
  static constexpr bool kIsLayered = false;              ///< true: constant between knots()

  Scalar rate{1};

  /// Entries of the [shear_rate] table, in the order of a scene file. Members: Scalar or std::vector<Scalar>.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"rate", Range::positive}, self.rate);
  }
  /// Whatever must hold between entries (lengths, order, domain); single numbers are checked by their Range.
  void check(const std::string& /*prefix*/, const Scalar& /*bottom*/, const Scalar& /*top*/,
             Complaints&) const {}

  [[nodiscard]] Scalar value(const Scalar& /*z*/) const { return rate; }
  /// (hi - lo) / int_lo^hi dz / a(z) for an interval without a knot inside.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& /*lo*/, const Scalar& /*hi*/) const { return rate; }
  /// Heights where a or its slope jumps, or a is largest or smallest, ascending; a jumps only if kIsLayered or where
  /// jumps_at(z) says so.
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  // A model may also have the following; what it leaves out is found from the above, more slowly (model.hpp).
  /// For every entry, in the order of fields(): add(entry, derivative of harmonic_mean with its ends held fixed); no
  /// call for 0.
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& /*lo*/, const Scalar& /*hi*/, Add&& add) const {
    add(0, Scalar(1));
  }
  /// Which entry each of knots() is, in their order; kNoEntry for none.
  [[nodiscard]] std::vector<std::size_t> knot_entries() const { return {}; }
  // What takes long, or depends on the ends of the domain, is found in prepare(bottom, top), called where a scene is made. bool
  // vanishes_at(end): a is 0 there, as a root of the distance or so. Scalar shear_rate(z): what a is made of, for diffusion.
  // static constexpr bool kIsGuessable = false, if its numbers must be known. kIsRoot = true, if a^2 is linear and falls.
  // static constexpr bool kIsLinear = true, if a(z) is linear between knots(), or kIsExponential = true, if log a(z) is: the exact
  // engine then takes it as it is. Then always end_value_derivatives(lo, hi, add_low, add_high), and, where a jumps at a
  // knot, bool jumps_at(z) and EndValues<Scalar> end_values(lo, hi): see model.hpp.

  static std::vector<SkeletonDepthFunction> samples() { return {{Scalar(1)}, {Scalar(3)}}; }
};

}  // namespace shearfront
