// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string_view>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Copy this file to flux/<name>.hpp, rename the struct, fill in the formula, and add one line to
/// flux/all.hpp. Say here: the formula, the range of states with units, convexity, source (author, year,
/// equation). This copy is phi (phi - 1), so that it compiles and passes the laws of fluxes as it stands.
struct SkeletonFlux {
  static constexpr std::string_view kName = "skeleton";          ///< flux.model in scene files
  static constexpr std::string_view kFormula = "phi (phi - 1)";  ///< for `shearfront list`
  static constexpr std::array<double, 2> kRange{0.0, 1.0};       ///< states allowed
  static constexpr std::array<double, 1> kExtrema{0.5};          ///< interior extrema of f, ascending

  template <Real S>
  [[nodiscard]] static S value(const S& phi) {
    return phi * (phi - S(1));
  }
  template <Real S>
  [[nodiscard]] static S derivative(const S& phi) {
    return S(2) * phi - S(1);
  }
  /// (value(q) - value(p)) / (q - p), derivative(p) where p == q; write it without cancellation if you can.
  template <Real S>
  [[nodiscard]] static S secant(const S& p, const S& q) {
    return p + (q - S(1));
  }
  /// Numeric entries of the [flux] table of a scene file: visit(FieldInfo{"gamma"}, self.gamma), ...
  template <class Self, class Visit>
  static void fields(Self&, Visit&&) {}

  static std::array<SkeletonFlux, 1> samples() { return {}; }
};

}  // namespace shearfront
