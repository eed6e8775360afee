// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>

#include "shearfront/diffusion/problem.hpp"

namespace shearfront::diffusion {

/// By how much the parabola through the means of cell j and its neighbours (at an end that is not periodic:
/// the two next cells) rises over half the cell; 0 if there are only two cells. The halves of the cell then
/// have the means phi_j -+ half of that. Exact for parabolas: for smooth phi off by O(dz^3). Cost: O(1).
[[nodiscard]] double half_rise(const Problem& problem, std::span<const double> means, std::size_t j);

/// The same, reduced where phi_j -+ half_rise would leave [lowest, highest]. Precondition: phi_j is inside up
/// to rounding.
[[nodiscard]] double bounded_half_rise(const Problem& problem, std::span<const double> means, std::size_t j,
                                       const StateRange<double>& range);

}  // namespace shearfront::diffusion
