// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::support {

/// |x - y| / |y| as a double, |x| if y is 0.
template <Real S>
[[nodiscard]] double relative_error(const S& x, const S& y) {
  const S d = x > y ? S(x - y) : S(y - x);
  const S size = y < 0 ? S(-y) : y;
  return to_double(size > 0 ? S(d / size) : d);
}

}  // namespace shearfront::support
