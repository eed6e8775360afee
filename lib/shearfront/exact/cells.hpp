// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::exact {

/// Initial data cut at all initial jumps and all interfaces: in cell i, (x[i], x[i+1]), both phi and a are
/// constant.
///
///   x       ascending heights, bottom and top included; a jump on an interface is one point
///   M       int_bottom^x[i] phi(z, 0) dz; M + M_low is the same in twice the digits
///   phi     initial concentration of each cell
///   layer   layer of each cell
///   first   first[k] is the point at boundary k, so the cells of layer k are first[k] .. first[k+1] - 1
template <Real Scalar>
struct Cells {
  std::vector<Scalar> x, M, M_low, phi;
  std::vector<std::size_t> layer, first;

  /// The states `values` between the heights `jumps`, in layers between `boundaries`.
  Cells(const std::vector<Scalar>& jumps, const std::vector<Scalar>& values,
        const std::vector<Scalar>& boundaries) {
    x.reserve(jumps.size() + boundaries.size());
    std::merge(jumps.begin(), jumps.end(), boundaries.begin(), boundaries.end(), std::back_inserter(x));
    x.erase(std::unique(x.begin(), x.end()), x.end());
    std::size_t piece = 0, k = 0;
    CompensatedSum<Scalar> sum;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (piece < jumps.size() && jumps[piece] == x[i]) ++piece;
      if (k < boundaries.size() && boundaries[k] == x[i]) {
        first.push_back(i);
        ++k;
      }
      const TwoSum<Scalar> amount = sum.parts();
      M.push_back(amount.high);
      M_low.push_back(amount.low);
      if (i + 1 == x.size()) break;
      phi.push_back(values[piece]);
      layer.push_back(k - 1);
      const TwoSum<Scalar> width(x[i + 1], Scalar(-x[i]));
      const TwoProduct<Scalar> inside(width.high, values[piece]);
      sum += inside.high;
      sum += inside.low + width.low * values[piece];
    }
  }

  [[nodiscard]] std::size_t n_cells() const { return phi.size(); }
  /// Cell that contains z: a point belongs to the cell above it, the top to the last cell.
  [[nodiscard]] std::size_t cell_at(const Scalar& z) const {
    const auto it = std::upper_bound(x.begin() + 1, x.end() - 1, z);
    return static_cast<std::size_t>(it - x.begin()) - 1;
  }
  /// int_bottom^z phi(., 0).
  [[nodiscard]] Scalar cumulative(const Scalar& z) const {
    const std::size_t i = cell_at(z);
    return M[i] + phi[i] * (z - x[i]);
  }
};

}  // namespace shearfront::exact
