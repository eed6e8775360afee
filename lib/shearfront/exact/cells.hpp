// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "shearfront/exact/start_shape.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::exact {

/// Initial data cut at all initial jumps (knots of a smooth start) and all interfaces: in cell i, (x[i], x[i+1]), a is constant
/// and phi is, too, or it and its slope are monotone.
///
///   x         ascending heights, bottom and top included; a jump on an interface is one point
///   M         int_bottom^x[i] phi(z, 0) dz; M + M_low is the same in twice the digits
///   phi       initial concentration of each cell; of a curved one at its lower end
///   phi_high  the same at the upper end
///   layer     layer of each cell
///   first     first[k] is the point at boundary k, so the cells of layer k are first[k] .. first[k+1] - 1
///   shape     phi inside curved cells; null: there are none
template <Real Scalar>
struct Cells {
  std::vector<Scalar> x, M, M_low, phi, phi_high;
  std::vector<std::size_t> layer, first;
  std::shared_ptr<const StartShape<Scalar>> shape;

  /// The states `values` between the heights `jumps`, in layers between `boundaries`.
  Cells(const std::vector<Scalar>& jumps, const std::vector<Scalar>& values,
        const std::vector<Scalar>& boundaries) {
    cut(jumps, boundaries);
    std::size_t piece = 0;
    CompensatedSum<Scalar> sum;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (piece < jumps.size() && jumps[piece] == x[i]) ++piece;
      add_amount(sum);
      if (i + 1 == x.size()) break;
      phi.push_back(values[piece]);
      const TwoSum<Scalar> width(x[i + 1], Scalar(-x[i]));
      const TwoProduct<Scalar> inside(width.high, values[piece]);
      sum += inside.high;
      sum += inside.low + width.low * values[piece];
    }
    phi_high = phi;
  }

  /// A smooth start in layers between `boundaries`, cut at `cuts` besides, which must include its knots.
  Cells(std::shared_ptr<const StartShape<Scalar>> start, const std::vector<Scalar>& cuts,
        const std::vector<Scalar>& boundaries)
      : shape(std::move(start)) {
    cut(cuts, boundaries);
    CompensatedSum<Scalar> sum;
    for (std::size_t i = 0; i < x.size(); ++i) {
      add_amount(sum);
      if (i + 1 == x.size()) break;
      const std::size_t k = layer[i];
      phi.push_back(shape->state(k, x[i]));
      phi_high.push_back(shape->state(k, x[i + 1]));
      sum += shape->amount(k, x[i], x[i + 1]);
    }
  }

  [[nodiscard]] std::size_t n_cells() const { return phi.size(); }
  /// Whether phi is not constant in a cell.
  [[nodiscard]] bool is_curved(std::size_t cell) const { return shape && phi[cell] != phi_high[cell]; }
  /// Cell that contains z: a point belongs to the cell above it, the top to the last cell.
  [[nodiscard]] std::size_t cell_at(const Scalar& z) const {
    const auto it = std::upper_bound(x.begin() + 1, x.end() - 1, z);
    return static_cast<std::size_t>(it - x.begin()) - 1;
  }
  /// phi(z, 0) at a height of cell i.
  [[nodiscard]] Scalar state(std::size_t i, const Scalar& z) const {
    return is_curved(i) ? shape->state(layer[i], z) : phi[i];
  }
  /// dphi/dz of the same.
  [[nodiscard]] Scalar slope(std::size_t i, const Scalar& z) const {
    if (!is_curved(i)) return Scalar(0);
    return shape->slope(layer[i], z, Scalar(x[i] + (x[i + 1] - x[i]) / Scalar(2)));
  }
  /// Where phi(z, 0), which rises in cell i, is p.
  [[nodiscard]] Scalar height_of_state(std::size_t i, const Scalar& p) const {
    Scalar lo = x[i], hi = x[i + 1];
    for (;;) {
      const Scalar z = lo + (hi - lo) / Scalar(2);
      if (!(z > lo && z < hi)) return lo;
      (state(i, z) < p ? lo : hi) = z;
    }
  }
  /// int phi(., 0) from the lower end of cell i to a height of it.
  [[nodiscard]] Scalar inside(std::size_t i, const Scalar& z) const {
    return is_curved(i) ? shape->amount(layer[i], x[i], z) : Scalar(phi[i] * (z - x[i]));
  }
  /// int_bottom^z phi(., 0).
  [[nodiscard]] Scalar cumulative(const Scalar& z) const {
    const std::size_t i = cell_at(z);
    return M[i] + inside(i, z);
  }
  /// phi(., 0) next to an inner point.
  [[nodiscard]] const Scalar& beside(std::size_t point, bool is_above) const {
    return is_above ? phi[point] : phi_high[point - 1];
  }

 private:
  void cut(const std::vector<Scalar>& cuts, const std::vector<Scalar>& boundaries) {
    x.reserve(cuts.size() + boundaries.size());
    std::merge(cuts.begin(), cuts.end(), boundaries.begin(), boundaries.end(), std::back_inserter(x));
    x.erase(std::unique(x.begin(), x.end()), x.end());
    std::size_t k = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (k < boundaries.size() && boundaries[k] == x[i]) {
        first.push_back(i);
        ++k;
      }
      if (i + 1 < x.size()) layer.push_back(k - 1);
    }
  }
  void add_amount(const CompensatedSum<Scalar>& sum) {
    const TwoSum<Scalar> amount = sum.parts();
    M.push_back(amount.high);
    M_low.push_back(amount.low);
  }
};

}  // namespace shearfront::exact
