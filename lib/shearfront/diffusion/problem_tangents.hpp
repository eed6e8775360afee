// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/diffusion/problem.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::diffusion {

/// Whether an entry of a scene changes nothing but r, D and the initial means of a Problem; those of a flux change
/// more, and those of the domain its grid.
[[nodiscard]] bool has_problem_tangent(const Entry& entry);

/// Derivatives of problem_of(scene, n_cells) with respect to entries(scene.spec())[i], i of `wanted`.
///
/// Differences of the coefficients, not of the solution: of fourth order, with steps of 1e-3 of a positive
/// entry and 1e-3 cells for the height of a break; of second order to one side where the other is no scene
/// (concentrations at 0 and 1, exact as they enter linearly). Relative error <= 1e-9 of the largest
/// derivative (tests). Where a break is at the edge of a cell the derivatives to both sides differ, and this
/// is their mean. Preconditions: refusal(scene) is empty; has_problem_tangent() of all wanted. Cost: four problem_of
/// for each.
[[nodiscard]] std::vector<Tangent> problem_tangents(const Scene<double>& scene,
                                                    const std::vector<std::size_t>& wanted,
                                                    std::size_t n_cells);

}  // namespace shearfront::diffusion
