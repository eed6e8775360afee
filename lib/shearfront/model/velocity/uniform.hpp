// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Plug flow: u = value > 0 at every height.
template <Real Scalar>
struct UniformVelocity {
  static constexpr std::string_view kName = "uniform";
  static constexpr std::string_view kFormula = "value";
  static constexpr bool kIsUniform = true;

  Scalar speed{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"value", Range::positive}, self.speed);
  }
  static void check(const std::string& /*prefix*/, const Scalar& /*bottom*/, const Scalar& /*top*/,
                    Complaints&) {}

  [[nodiscard]] Scalar value(const Scalar& /*z*/) const { return speed; }
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const { return speed * (hi - lo); }
  [[nodiscard]] Scalar height_of(const Scalar& lo, const Scalar& amount) const { return lo + amount / speed; }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  static std::vector<UniformVelocity> samples() { return {{Scalar(1)}, {Scalar(0.25)}}; }
};

}  // namespace shearfront
