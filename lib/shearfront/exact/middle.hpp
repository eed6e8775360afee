// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// sqrt(lo hi) of 0 < lo <= hi, where the ratio overflows some number between them: that of lo c and hi c is the same times c, to the
/// bit for powers of two.
template <Real Scalar>
[[nodiscard]] Scalar geometric_middle(const Scalar& lo, const Scalar& hi) {
  using std::sqrt;
  const Scalar ratio = hi / lo;
  return lo * (is_finite(ratio) ? Scalar(sqrt(ratio)) : Scalar(std::ldexp(1.0, 512)));
}

}  // namespace shearfront::exact
