// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"

namespace shearfront::fv {

/// A grid of n_cells >= 1 cells over [bottom, top]; cell j is [edge(j), edge(j + 1)]. Uniform unless there
/// are edges.
struct Grid {
  double bottom = 0, top = 1;
  std::size_t n_cells = 1;
  std::vector<double> edges{};   ///< of the cells, or none
  std::vector<double> widths{};  ///< of the cells, equal to the bit where cells are equal; as many, or none

  /// Ascending in j; edge(0) == bottom and edge(n_cells) == top exactly.
  [[nodiscard]] double edge(std::size_t j) const {
    if (!edges.empty()) return edges[j];
    if (j == n_cells) return top;
    return bottom + (top - bottom) * (static_cast<double>(j) / static_cast<double>(n_cells));
  }
  [[nodiscard]] double middle(std::size_t j) const {
    if (!edges.empty()) return edges[j] + (edges[j + 1] - edges[j]) / 2;
    return bottom + (top - bottom) * ((static_cast<double>(j) + 0.5) / static_cast<double>(n_cells));
  }
  /// Width of the cells; of grids with edges the mean.
  [[nodiscard]] double cell_width() const { return (top - bottom) / static_cast<double>(n_cells); }
};

/// About `n_cells` cells (each layer at least one, their number in proportion to its thickness), equal within
/// a layer or between two knots of a, with edges on the interfaces.
[[nodiscard]] Grid aligned_grid(const Scene<double>& scene, std::size_t n_cells);

/// Mean of the share x = phi(z, 0) / c(z) over the grains of every cell, int phi dz / int c dz, exact to
/// rounding, so the grid starts with the mass of the scene. Continuous in the heights of the initial jumps.
/// Cost: O(n_cells + jumps + knots).
[[nodiscard]] std::vector<double> initial_averages(const Scene<double>& scene, const Grid& grid);

/// Mean of c over every cell; empty for a scene without solid fraction. Cost: O(n_cells + knots).
[[nodiscard]] std::vector<double> cell_packings(const Scene<double>& scene, const Grid& grid);

/// int c dz of every cell; empty where all are equal to the bit. Cost: as above.
[[nodiscard]] std::vector<double> capacities(const Scene<double>& scene, const Grid& grid);

// With x = phi / c the law is (c x)_t + (s a sqrt(T) c f(x))_z = 0: a cell of width w and solid fraction c is a cell
// of width w c for x, and a rate counts times c. In what follows a stands for a sqrt(T).

/// s times the harmonic mean of a over every cell, times its solid fraction: result[j] belongs to cell j.
///
/// The harmonic mean (width / int dz / a) keeps the travel time of pure grains (phi = 0 or 1) across a cell
/// exact. For smooth a it is a(middle) up to O(width^2); in a cell cut by an interface it depends
/// continuously on the height of the interface, which the value at the middle would not: a fit that moves an
/// interface needs that. Cost: O(n_cells + knots).
[[nodiscard]] std::vector<double> cell_rates(const Scene<double>& scene, const Grid& grid);

/// s times the harmonic mean of a from the middle of cell j - 1 to the middle of cell j, times the mean of c
/// there: result[j] belongs to the face below cell j, 1 <= j < n_cells; result[0] and result[n_cells], the
/// walls, are 0.
///
/// For smooth a this is a(face) up to O(width^2). Cost: O(n_cells + knots).
[[nodiscard]] std::vector<double> face_rates(const Scene<double>& scene, const Grid& grid);

/// s a(z) c(z) at every face, the upper value at a jump; 0 at the walls. Cost: O(n_cells log knots).
[[nodiscard]] std::vector<double> face_values(const Scene<double>& scene, const Grid& grid);

}  // namespace shearfront::fv
