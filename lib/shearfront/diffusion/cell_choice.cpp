// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cell_choice.hpp"

#include <cmath>

#include "shearfront/diffusion/face_rule.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::diffusion {
namespace {

/// Up to the rounding of widths.
constexpr double kMostCellPeclet = kCentralUpTo * (1 + 1e-12);

}  // namespace

std::size_t chosen_cells(const Scene<double>& scene) {
  for (std::size_t n = kUsualCells; n < kMostChosenCells; n *= 2)
    if (largest_cell_peclet(problem_of(scene, n)) <= kMostCellPeclet) return n;
  return kMostChosenCells;
}

std::string raised_remark(const Problem& problem) {
  const double peclet = largest_cell_peclet(problem);
  if (peclet <= kMostCellPeclet) return "";
  const double wanted = std::ceil(static_cast<double>(problem.n_cells) * peclet / kCentralUpTo);
  constexpr double kMostWorthwhile = 1e6;
  return "fronts are narrower than the " + std::to_string(problem.n_cells) + " cells: D is raised, up to " +
         number_text(raised_share(peclet), 3) +
         " times, where phi would leave its range else, and the error falls with the first power of the "
         "cells only; " +
         (wanted <= kMostWorthwhile
              ? "second order takes " + number_text(wanted, 3) + " cells, or cell_tolerance = 0.01"
              : "so small a D makes no difference to be seen: the bed without diffusion has an exact "
                "solution");
}

}  // namespace shearfront::diffusion
