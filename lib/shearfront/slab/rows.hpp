// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/diffusion/tridiagonal.hpp"

namespace shearfront::slab {

/// What rows of a slab do in a time dt: each is carried along by its own shift, and diffuses in x.
///
///     q_t + u q_x = D q_xx,   x periodic, equal cells
///
/// Carried exactly by whole cells, and by the rest r in [0, 1) of a cell with q linear in every cell (slopes bounded by mc):
/// conservative, without new extrema, second order, for shifts of any size. Then one step of theta = max(1/2, 1 - dx^2 /
/// (2 D dt)): Crank-Nicolson as long as that keeps the bounds. Both leave a row of equal values as it is, to the bit.
class Rows {
 public:
  /// Rows of n >= 3 cells, shift[j] in cells (of any sign) and diffusion[j] = D dt / dx^2.
  Rows(std::size_t n, std::vector<double> shift, const std::vector<double>& diffusion);

  /// Advances the rows first ... end - 1 of the slab, whose cell i of row j is states[i * stride + j].
  void advance(double* states, std::size_t stride, std::size_t first, std::size_t end) const;

 private:
  struct Spread {
    double amount, theta;
    diffusion::Tridiagonal matrix;
  };
  void carry(const double* from, double shift, double* to, double* out) const;
  void spread(const Spread& by, double* q, double* flux) const;

  std::size_t n_;
  std::vector<double> shift_;
  std::vector<Spread> spreads_;     ///< one for all rows in turn with the same D
  std::vector<std::size_t> which_;  ///< of a row
};

}  // namespace shearfront::slab
