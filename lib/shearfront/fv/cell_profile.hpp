// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront::fv {

/// What comes out of a march: phi = x c(z) over z.
///
/// x is constant in a cell, for muscl linear where c is constant in the cell. Where c varies phi follows it,
/// linear in each piece between the knots of c, and x counts as constant. So (1) phi <= c(z) wherever x <= 1,
/// without any rounding, at the ends of the pieces and, where c is linear, in between; (2) int phi dz is the
/// amount in the cells to rounding. Cost: O(cells log knots).
[[nodiscard]] Profile<double> cell_profile(const Scene<double>& scene, const Grid& grid,
                                           const CellShares& cells);

}  // namespace shearfront::fv
