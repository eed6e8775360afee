// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// Copy this file to model/flux/<name>.hpp, rename the struct, fill in the formula, and add one line to
/// model/flux/all.hpp. Say here: the formula, the range of states with units, convexity, source (author, year,
/// equation). This copy is depth * 4 phi (phi - 1), so that it compiles and passes the laws of fluxes as it
/// stands.
template <Real Scalar>
struct SkeletonFlux {
  static constexpr std::string_view kName = "skeleton";                  ///< flux.model in scene files
  static constexpr std::string_view kFormula = "4 depth phi (phi - 1)";  ///< for `shearfront list`
  static constexpr std::string_view kStates = "0 <= phi <= 1";
  static constexpr bool kIsParabola = false;

  Scalar depth{1};

  [[nodiscard]] static StateRange<Scalar> range() { return {}; }  ///< states allowed
  /// Interior extrema of f, ascending.
  [[nodiscard]] static std::vector<Scalar> extrema() { return {Scalar(1) / Scalar(2)}; }
  [[nodiscard]] static Curvature curvature() { return Curvature::convex; }

  [[nodiscard]] Scalar value(const Scalar& phi) const {
    return Scalar(4) * depth * (phi * (phi - Scalar(1)));
  }
  [[nodiscard]] Scalar derivative(const Scalar& phi) const {
    return Scalar(4) * depth * (phi + (phi - Scalar(1)));
  }
  /// May be left out: the exact engine then takes differences of derivative().
  [[nodiscard]] Scalar second_derivative(const Scalar& /*phi*/) const { return Scalar(8) * depth; }
  /// (value(q) - value(p)) / (q - p), derivative(p) where p == q; write it without cancellation if you can.
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    return Scalar(4) * depth * (p + (q - Scalar(1)));
  }

  /// Entries of the [flux] table, in the order of a scene file. Members: Scalar or std::vector<Scalar>.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"depth", Range::positive}, self.depth);
  }
  /// Whatever must hold beyond that; single numbers are checked by their Range.
  static void check(const std::string& /*prefix*/, Complaints&) {}

  static std::vector<SkeletonFlux> samples() { return {{Scalar(1)}, {Scalar(0.25)}}; }
};

}  // namespace shearfront
