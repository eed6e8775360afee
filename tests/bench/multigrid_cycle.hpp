// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace shearfront::bench {

/// Multigrid V-cycles for periodic tridiagonal systems of an implicit step,
///
///   -lower_i x_{i-1} + (1 + lower_i - upper_i) x_i + upper_i x_{i+1} = right_i,
///
/// lower >= 0 >= upper: two red-black Gauss-Seidel sweeps before and one after, full weighting, linear
/// interpolation, coarse operators by Galerkin's product, down to at most 3 unknowns (40 sweeps there).
/// Source: Briggs, Henson & McCormick (2000), A Multigrid Tutorial, ch. 3 and 5.
class MultigridCycle {
 public:
  using Numbers = std::vector<double>;

  /// n = a power of 2 times an odd number: halved as often as possible.
  MultigridCycle(const Numbers& lower, const Numbers& upper) {
    Level fine(lower.size());
    for (std::size_t i = 0; i < lower.size(); ++i) {
      fine.below[i] = -lower[i];
      fine.above[i] = upper[i];
      fine.here[i] = 1 + lower[i] - upper[i];
    }
    levels_.push_back(fine);
    while (levels_.back().x.size() > 3 && levels_.back().x.size() % 2 == 0)
      levels_.push_back(coarse(levels_.back()));
  }

  /// Cycles from x = 0 until max |residual| <= tolerance max |right|; returns how many.
  int solve(const Numbers& right, double tolerance, Numbers& x) {
    Level& fine = levels_.front();
    fine.right = right;
    std::fill(fine.x.begin(), fine.x.end(), 0.0);
    double scale = 0;
    for (const double r : right) scale = std::max(scale, std::abs(r));
    int cycles = 0;
    do {
      cycle(0);
      ++cycles;
    } while (residual(fine) > tolerance * scale && cycles < 100);
    x = fine.x;
    return cycles;
  }

 private:
  struct Level {
    explicit Level(std::size_t n) : below(n), here(n), above(n), right(n), x(n), rest(n) {}
    Numbers below, here, above, right, x, rest;
  };

  static void sweep(Level& a) {
    const std::size_t n = a.x.size();
    for (const std::size_t colour : {std::size_t{0}, std::size_t{1}})
      for (std::size_t i = colour; i < n; i += 2) {
        const double down = a.x[i > 0 ? i - 1 : n - 1], up = a.x[i + 1 < n ? i + 1 : 0];
        a.x[i] = (a.right[i] - a.below[i] * down - a.above[i] * up) / a.here[i];
      }
  }
  static double residual(Level& a) {
    const std::size_t n = a.x.size();
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double down = a.x[i > 0 ? i - 1 : n - 1], up = a.x[i + 1 < n ? i + 1 : 0];
      a.rest[i] = a.right[i] - a.below[i] * down - a.here[i] * a.x[i] - a.above[i] * up;
      largest = std::max(largest, std::abs(a.rest[i]));
    }
    return largest;
  }
  /// R A P with P linear interpolation and R = P^T / 2.
  static Level coarse(const Level& a) {
    const std::size_t n = a.x.size(), m = n / 2;
    Level c(m);
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t k = 2 * i, down = (k + n - 1) % n, up = k + 1;
      c.here[i] = 0.5 * (a.here[k] + 0.5 * (a.below[k] + a.above[k] + a.above[down] + a.below[up]) +
                         0.25 * (a.here[down] + a.here[up]));
      c.below[i] = 0.5 * (0.5 * a.below[k] + 0.5 * a.below[down] + 0.25 * a.here[down]);
      c.above[i] = 0.5 * (0.5 * a.above[k] + 0.5 * a.above[up] + 0.25 * a.here[up]);
    }
    return c;
  }
  void cycle(std::size_t level) {
    Level& a = levels_[level];
    if (level + 1 == levels_.size()) {
      for (int i = 0; i < 40; ++i) sweep(a);
      return;
    }
    sweep(a);
    sweep(a);
    residual(a);
    Level& c = levels_[level + 1];
    const std::size_t n = a.x.size(), m = c.x.size();
    for (std::size_t i = 0; i < m; ++i) {
      c.right[i] = 0.25 * (a.rest[(2 * i + n - 1) % n] + 2 * a.rest[2 * i] + a.rest[2 * i + 1]);
      c.x[i] = 0;
    }
    cycle(level + 1);
    for (std::size_t i = 0; i < m; ++i) {
      a.x[2 * i] += c.x[i];
      a.x[2 * i + 1] += 0.5 * (c.x[i] + c.x[i + 1 < m ? i + 1 : 0]);
    }
    sweep(a);
  }

  std::vector<Level> levels_;
};

}  // namespace shearfront::bench
