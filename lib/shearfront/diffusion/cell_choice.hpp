// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>

#include "shearfront/diffusion/problem.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::diffusion {

inline constexpr std::size_t kUsualCells = 400, kMostChosenCells = 1600;

/// How many equal cells a scene is given if nobody says it: kUsualCells, doubled until Scheme::raised is central at
/// every face; at most kMostChosenCells.
/// Precondition: refusal(scene) is empty. Cost: O(cells + knots).
[[nodiscard]] std::size_t chosen_cells(const Scene<double>& scene);

/// What a user has to know of Scheme::raised on this problem: where and by how much D was raised, and how many
/// cells do without. Empty if it was not.
[[nodiscard]] std::string raised_remark(const Problem& problem);

}  // namespace shearfront::diffusion
