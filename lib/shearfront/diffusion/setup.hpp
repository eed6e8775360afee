// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shearfront/diffusion/problem.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront::diffusion {

/// Why a scene is no Problem; empty if it is one. Scenes need D > 0; one flux of any kind, or parabolas on
/// [0, 1] of either sign in different layers; walls, Neumann or periodic ends.
[[nodiscard]] std::string refusal(const Scene<double>& scene);

/// The scene on n_cells >= 2 equal cells. r and D of a face stand for the halves of the cells beside it: D is
/// the harmonic mean, r the mean of s a sqrt(T) weighted with 1 / D, both at the middle of every piece between
/// knots. For there F is constant and phi_z = (r f - F) / D, whose integral between the middles of the cells
/// is the rise of phi. So both depend continuously on the heights of interfaces.
/// With a solid fraction all this in the coordinate of SolidHeights, in which cells are equal; n_cells of them hold the
/// same amount of grains each.
/// Precondition: refusal(scene) is empty.
/// Cost: O(n_cells + knots).
[[nodiscard]] Problem problem_of(const Scene<double>& scene, std::size_t n_cells);
/// The same on cells between the given faces, at least three heights that ascend from bottom to top.
[[nodiscard]] Problem problem_of(const Scene<double>& scene, std::vector<double> faces);
/// The same with `initial` left empty, for states that come from elsewhere.
[[nodiscard]] Problem problem_without_initial(const Scene<double>& scene, std::vector<double> faces);

/// phi from the means of the cells: linear in each, with the slope of the parabola through it and its
/// neighbours, reduced where it would leave the range of the flux. Second order; keeps the means. With a solid fraction the
/// share is that, and phi = c x linear between its values at the ends of each of Problem::pieces, moved so that the piece
/// keeps its grains (where c is constant, not moved).
[[nodiscard]] Profile<double> profile_of(const Problem& problem, std::span<const double> states);

/// Derivative of profile_of if the states change by `tangent`: lines with the same z, whose phi and M are the
/// derivatives of phi and M. Where a slope is reduced, along the bound that reduces it.
[[nodiscard]] Profile<double> profile_tangent(const Problem& problem, std::span<const double> states,
                                              std::span<const double> tangent);

}  // namespace shearfront::diffusion
