// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace shearfront::diffusion {

/// Direct solution of the tridiagonal systems of an implicit step whose unknowns belong to the faces,
///
///   (1 + l_i - u_i) x_i - l_i x_{i-1} + u_i x_{i+1} = s_i,   i = 0..n-1,
///
/// with x_{-1} = x_{n-1} and x_n = x_0 if cyclic; otherwise l_0 and u_{n-1} do not count beside the diagonal.
///
/// Elimination from both ends towards the middle: two chains of divisions run side by side, where Thomas'
/// algorithm waits for each division. A cyclic system becomes a plain one by keeping x_0 for last, a border
/// of one row (Sherman & Morrison 1950, Ann. Math. Stat. 21, 124-127, is the same in another guise, but
/// needs a rank-one change whose size has to be chosen).
/// Guaranteed if l_i >= 0 >= u_i for all i: all pivots are >= 1 and max |x| <= max |s|, up to rounding
/// (diagonally dominant with row sums 1). Otherwise a pivot may vanish: then no x is finite.
/// Cost: O(n), two divisions an unknown, twice that if cyclic; a further right-hand side needs none.
class Tridiagonal {
 public:
  Tridiagonal(std::size_t n, bool is_cyclic);

  /// Replaces s by x. `lower` and `upper` are l / factor and u / factor.
  void solve(double factor, std::span<const double> lower, std::span<const double> upper,
             std::span<double> s);
  /// The same for a further right-hand side and the coefficients of the last solve().
  void solve_again(std::span<double> s) const;

 private:
  void eliminate(double* s);
  void substitute(double* s) const;
  /// From the middle to both ends.
  void spread(double* s) const;
  void close_cycle(double* s) const;

  std::size_t n_, first_, middle_;      ///< first_: 1 if cyclic; middle_: where the eliminations meet
  std::vector<double> lower_, upper_;   ///< l and u
  std::vector<double> inverse_, next_;  ///< 1 / pivot; the factor of the neighbour nearer to the middle
  std::vector<double> from_first_;      ///< cyclic: how x_i depends on x_0
};

}  // namespace shearfront::diffusion
