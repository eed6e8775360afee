// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"

namespace shearfront::fv {

/// Cells over [bottom, top]; cell j is [edges[j], edges[j + 1]].
struct Grid {
  std::vector<double> edges;   ///< ascending, the first and last are exactly those of the scene
  std::vector<double> widths;  ///< one less; of equal cells equal to the bit

  [[nodiscard]] std::size_t n_cells() const { return widths.size(); }
  [[nodiscard]] double middle(std::size_t j) const { return edges[j] + (edges[j + 1] - edges[j]) / 2; }
};

/// n_cells >= 1 equal cells.
[[nodiscard]] Grid equal_cells(const Scene<double>& scene, std::size_t n_cells);

/// About n_cells cells with edges on the knots of the scene: each stretch between two knots has at least one,
/// their number in proportion to its thickness, and all of its cells are equal.
[[nodiscard]] Grid aligned_cells(const Scene<double>& scene, std::size_t n_cells);

/// Calls visit(lo, hi) for the pieces into which the cuts (ascending) divide [begin, end], bottom to top.
template <class Visit>
void for_pieces(const std::vector<double>& cuts, double begin, double end, Visit&& visit) {
  double lo = begin;
  for (auto cut = std::upper_bound(cuts.begin(), cuts.end(), begin); cut != cuts.end() && *cut < end; ++cut) {
    visit(lo, *cut);
    lo = *cut;
  }
  visit(lo, end);
}

// With the share x = phi / c the law is (c x)_t + (s a sqrt(T) c f(x))_z = 0: a cell holds int c dz of grains,
// and a rate counts times c. In what follows a stands for a sqrt(T). Cost of each: O(cells log knots).

/// int c dz of every cell; without solid fraction its width.
[[nodiscard]] std::vector<double> capacities(const Scene<double>& scene, const Grid& grid);

/// Mean share of the grains of every cell, int phi dz / int c dz at t = 0, to rounding, so the grid starts
/// with the mass of the scene. Continuous in the heights of the initial jumps.
[[nodiscard]] std::vector<double> initial_shares(const Scene<double>& scene, const Grid& grid);

/// s times the harmonic mean of a over every cell, times its mean c.
///
/// The harmonic mean (width / int dz / a) keeps the travel time of pure grains across a cell exact. For smooth
/// a it is a(middle) up to O(width^2); in a cell cut by an interface it depends continuously on the height of
/// the interface, which the value at the middle would not: a fit that moves an interface needs that.
[[nodiscard]] std::vector<double> cell_rates(const Scene<double>& scene, const Grid& grid);

/// The same from the middle of cell j - 1 to that of cell j: result[j], 1 <= j < n_cells, belongs to the face
/// below cell j; result[0] and result[n_cells], the ends, are 0.
[[nodiscard]] std::vector<double> face_rates(const Scene<double>& scene, const Grid& grid);

/// s a(z) c(z) at every face, the upper value at a jump; 0 at the ends.
[[nodiscard]] std::vector<double> face_values(const Scene<double>& scene, const Grid& grid);

}  // namespace shearfront::fv
