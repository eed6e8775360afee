// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cell_rise.hpp"

#include <algorithm>

namespace shearfront::diffusion {
namespace {

/// Another cell, lengths over the width of cell j: distance of its middle from that of cell j, with sign, its
/// width and how much its mean is above that of cell j.
struct Other {
  double distance, width, excess;

  /// Mean over the cell of x^2 less that over cell j.
  [[nodiscard]] double square() const { return distance * distance + (width * width - 1) / 12; }
};

/// Slope at the middle of the parabola whose means are those of cell j, a and b.
double slope(const Other& a, const Other& b) {
  const double square_a = a.square(), square_b = b.square();
  return (a.excess * square_b - b.excess * square_a) / (a.distance * square_b - b.distance * square_a);
}

}  // namespace

double half_rise(const Problem& problem, std::span<const double> means, std::size_t j) {
  const std::size_t n = problem.n_cells;
  const bool is_periodic = problem.ends == Ends::periodic;
  if (n < 3) return 0;
  if (problem.has_equal_cells()) {
    if (is_periodic) return (means[(j + 1) % n] - means[(j + n - 1) % n]) / 4;
    if (j == 0) return (4 * means[1] - 3 * means[0] - means[2]) / 4;
    if (j == n - 1) return (3 * means[j] - 4 * means[j - 1] + means[j - 2]) / 4;
    return (means[j + 1] - means[j - 1]) / 4;
  }
  const double own = problem.width(j);
  const auto other = [&](std::size_t k, double distance) {
    return Other{distance / own, problem.width(k) / own, means[k] - means[j]};
  };
  const bool has_below = j > 0 || is_periodic, has_above = j + 1 < n || is_periodic;
  const std::size_t below = j > 0 ? j - 1 : n - 1, above = j + 1 < n ? j + 1 : 0;
  const double down = -0.5 * (own + problem.width(below)), up = 0.5 * (own + problem.width(above));
  if (has_below && has_above) return 0.5 * slope(other(below, down), other(above, up));
  if (has_above) {
    const double next = up + 0.5 * (problem.width(above) + problem.width(above + 1));
    return 0.5 * slope(other(above, up), other(above + 1, next));
  }
  const double next = down - 0.5 * (problem.width(below) + problem.width(below - 1));
  return 0.5 * slope(other(below, down), other(below - 1, next));
}

double bounded_half_rise(const Problem& problem, std::span<const double> means, std::size_t j,
                         const StateRange<double>& range) {
  const double room = std::max(0.0, std::min(means[j] - range.lowest, range.highest - means[j]));
  return std::clamp(half_rise(problem, means, j), -room, room);
}

}  // namespace shearfront::diffusion
