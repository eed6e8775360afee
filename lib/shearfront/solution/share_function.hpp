// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <vector>

namespace shearfront {

/// A function g of the share x = phi / c of the grains, to be integrated over a bed: int c g(x) dz. Entropy
/// of mixing and height of a bed are such integrals.
struct ShareFunction {
  std::function<double(double)> value;  ///< g(x), continuous for x in [0, 1]
  std::vector<double> kinks;            ///< shares where its slope jumps, ascending

  [[nodiscard]] explicit operator bool() const { return bool(value); }
};

}  // namespace shearfront
