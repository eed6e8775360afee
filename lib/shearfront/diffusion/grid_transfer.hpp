// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "shearfront/diffusion/problem.hpp"
#include "shearfront/diffusion/refined_cells.hpp"

namespace shearfront::diffusion {

/// Another grid for a running computation.
struct Regrid {
  Problem problem;                  ///< `initial` does not count
  std::vector<CellChange> changes;  ///< by which the cells of the grid before become those of `problem`
};

/// Means of the cells after changes. Halves take theirs from the parabola of the cell and its neighbours,
/// reduced to the range of the flux (see bounded_half_rise); the whole takes the mean of its halves. The mass
/// of each cell that is split or merged stays the same, to rounding. `problem` and `means` are those before;
/// one change for each cell. Cost: O(cells).
[[nodiscard]] std::vector<double> transfer_means(const Problem& problem, std::span<const double> means,
                                                 std::span<const CellChange> changes);

/// The same, with the value of a cell for both its halves.
[[nodiscard]] std::vector<double> transfer_constants(std::span<const double> values,
                                                     std::span<const CellChange> changes);

/// Values at the faces after changes; at a new face that of the cubic through the four nearest ones (exact
/// for cubics; of the parabola or line if there are only three or two).
[[nodiscard]] std::vector<double> transfer_fluxes(const Problem& problem, std::span<const double> fluxes,
                                                  std::span<const CellChange> changes);

}  // namespace shearfront::diffusion
