// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/diffusion/problem.hpp"
#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// Whether an entry of a scene changes nothing but r, D and the initial means of a diffusion::Problem; those
/// of a flux change more, and those of the domain its grid.
[[nodiscard]] bool has_problem_tangent(const std::string& field);

/// Derivatives of diffusion::problem_of(scene, n_cells) with respect to each parameter, at these values.
///
/// Differences of the coefficients, not of the solution: of fourth order, with steps of 1e-3 of a positive
/// entry and 1e-3 cells for the height of a break; of second order to one side where the other is no scene
/// (concentrations at 0 and 1, exact as they enter linearly). Relative error <= 1e-9 of the largest
/// derivative (tests). Where a break is at the edge of a cell the derivatives to both sides differ, and this
/// is their mean. Preconditions: the scene with these values is valid and has no diffusion::refusal;
/// has_problem_tangent() of all parameters. Cost: four problem_of for each parameter.
[[nodiscard]] std::vector<diffusion::Tangent> problem_tangents(const Parameters& parameters,
                                                               const Eigen::VectorXd& values,
                                                               std::size_t n_cells);

}  // namespace shearfront::fit
