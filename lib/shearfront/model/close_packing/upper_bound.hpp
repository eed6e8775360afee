// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/close_packing/model.hpp"

namespace shearfront {

/// Grains of very different size, the most any mixture can have: the small ones fill the gaps between close
/// packed large ones, or large ones swim in close packed small ones,
///
///     c_rcp(x) = min( pure / (1 - x), pure / (x + (1 - x) pure) ),      0 < pure < 1.
///
/// x in [0, 1] is the share of small grains. Largest at the kink x = (1 - pure) / (2 - pure), where all gaps
/// are full: pure (2 - pure). Source: the thesis named in docs/evidence/packing.md, eq. (2.95).
template <Real Scalar>
struct PackingUpperBound {
  static constexpr std::string_view kName = "upper-bound";
  static constexpr std::string_view kFormula = "min(pure / (1 - x), pure / (x + (1 - x) pure))";

  Scalar pure = packing_of_spheres<Scalar>();

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"pure", Range::positive, true, Measure::number, {.high = 1}}, self.pure);
  }
  static void check(const std::string& /*prefix*/, Complaints& /*complaints*/) {}

  [[nodiscard]] Scalar value(const Scalar& x) const {
    const Scalar large = Scalar(1) - x;
    return pure / std::max(large, Scalar(x + large * pure));
  }
  [[nodiscard]] Scalar derivative(const Scalar& x) const {
    const Scalar large = Scalar(1) - x, small = x + large * pure;
    return large > small ? Scalar(pure / (large * large))
                         : Scalar(-pure * (Scalar(1) - pure) / (small * small));
  }
  [[nodiscard]] std::vector<Scalar> kinks() const { return {(Scalar(1) - pure) / (Scalar(2) - pure)}; }

  static std::vector<PackingUpperBound> samples() { return {{}, {Scalar(0.55)}}; }
};

}  // namespace shearfront
