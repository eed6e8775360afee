// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// Samples at heights in any order; see Sample. Cost: O(cells + n log n).
[[nodiscard]] std::vector<Sample> sample_cells(const Grid& grid, const CellStates& cells,
                                               const std::vector<double>& depths);

/// phi, constant or linear in every cell, as a function of z. Cost: O(cells).
[[nodiscard]] Profile<double> profile_of_cells(const Grid& grid, const CellStates& cells);

/// What comes out of a march: phi = x c(z), x the share of the grains in the states of the cells.
///
/// x is constant in a cell, for muscl linear where c is constant in the cell. Where c varies phi follows it,
/// linear in each piece between the knots of c, and x counts as constant. So (1) phi <= c(z) wherever x <= 1,
/// without any rounding, at the ends of the pieces and, where c is linear, in between; (2) int phi dz is the
/// amount in the cells to rounding.
class CellOutput {
 public:
  CellOutput(const Scene<double>& scene, const Grid& grid);

  [[nodiscard]] std::vector<Sample> samples(const CellStates& cells, const std::vector<double>& depths) const;
  [[nodiscard]] Profile<double> profile(const CellStates& cells) const;

 private:
  /// [lo, next lo] in a cell, c at both ends.
  struct Piece {
    double lo, packing_below, packing_above;
    std::size_t cell;
  };
  Grid grid_;
  bool has_packing_, is_layered_;
  std::vector<Piece> pieces_;
};

}  // namespace shearfront::fv
