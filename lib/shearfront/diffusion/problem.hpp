// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/model/flux/flux.hpp"

namespace shearfront::diffusion {

/// A part of a cell in which the solid fraction c has no knot: its heights, its coordinates, and c at its ends.
struct SolidPiece {
  std::size_t cell;
  double z_below, z_above, m_below, m_above, c_below, c_above;
};

/// What holds at both ends of the bed.
///   no_flux   r f(phi) - D phi_z = 0: walls, the bed keeps its mass
///   neumann   phi_z = 0, and r f(phi) passes
///   periodic  the top continues at the bottom
enum class Ends { no_flux, neumann, periodic };

/// Segregation with diffusion in one bed, on a grid of cells:
///
///   phi_t + (r(z) f(phi))_z = (D(z) phi_z)_z,   bottom < z < top
///
/// Any consistent units. Cells are equal, with faces z_i = bottom + i (top - bottom) / n_cells, unless
/// `faces` is given. Coefficients belong to the faces. Where r or D jump at a face, the harmonic mean of D and
/// the mean of r weighted with 1 / D keep the scheme second order: phi and the flux are continuous there.
///
/// Where the solid fraction varies the states are shares phi / c, and z stands for the solid below (SolidHeights), whose
/// heights are in `pieces`.
struct Problem {
  double bottom = 0, top = 1;
  std::size_t n_cells = 0;          ///< at least 2
  std::vector<double> faces;        ///< ascending from bottom to top, n_cells + 1 of them; empty: equal cells
  std::vector<double> rate;         ///< r at the n_cells + 1 faces, any sign; the ends equal if periodic
  std::vector<double> diffusivity;  ///< D >= 0 at the faces; the ends equal if periodic
  Ends ends = Ends::no_flux;
  Flux<double> flux = Quadratic<double>{};
  std::vector<double> initial;  ///< means of phi over the cells
  double mean_solid_fraction = 1;
  std::vector<SolidPiece> pieces;  ///< of all cells, bottom to top; empty: c = 1

  [[nodiscard]] bool has_equal_cells() const { return faces.empty(); }
  /// dz of equal cells.
  [[nodiscard]] double width() const { return (top - bottom) / static_cast<double>(n_cells); }
  /// dz_j of any cell, j < n_cells.
  [[nodiscard]] double width(std::size_t j) const {
    return has_equal_cells() ? width() : faces[j + 1] - faces[j];
  }
  /// z_i, i <= n_cells.
  [[nodiscard]] double face(std::size_t i) const {
    if (!has_equal_cells()) return faces[i];
    return i == n_cells ? top : bottom + width() * static_cast<double>(i);
  }
};

/// Derivatives of the data of a Problem with respect to one parameter. An empty vector stands for zeros.
struct Tangent {
  std::vector<double> rate, diffusivity;  ///< at the faces
  std::vector<double> initial;            ///< of the cells
};

}  // namespace shearfront::diffusion
