// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/grid_transfer.hpp"

#include <algorithm>
#include <variant>

#include "shearfront/diffusion/cell_rise.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {
namespace {

/// At the middle of cell j, by the polynomial through the faces nearest to it.
double in_the_middle(const Problem& problem, std::span<const double> fluxes, std::size_t j) {
  const std::size_t n_points = std::min<std::size_t>(4, fluxes.size());
  const std::size_t first = std::min(j > 0 ? j - 1 : 0, fluxes.size() - n_points);
  const double z = problem.face(j) + 0.5 * (problem.face(j + 1) - problem.face(j));
  double sum = 0;
  for (std::size_t k = first; k < first + n_points; ++k) {
    double weight = 1;
    for (std::size_t l = first; l < first + n_points; ++l)
      if (l != k) weight *= (z - problem.face(l)) / (problem.face(k) - problem.face(l));
    sum += weight * fluxes[k];
  }
  return sum;
}

/// quarter_rise(j): by how much the mean of the upper half of cell j is above that of the cell.
template <class QuarterRise>
std::vector<double> transfer(std::span<const double> values, std::span<const CellChange> changes,
                             const QuarterRise& quarter_rise) {
  SHEARFRONT_EXPECTS(values.size() == changes.size(), "a change for each cell");
  std::vector<double> next;
  next.reserve(values.size());
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (changes[j] == CellChange::split) {
      const double rise = quarter_rise(j);
      next.push_back(values[j] - rise);
      next.push_back(values[j] + rise);
    } else if (changes[j] == CellChange::merge) {
      next.push_back(values[j] + 0.5 * (values[j + 1] - values[j]));
      ++j;
    } else {
      next.push_back(values[j]);
    }
  }
  return next;
}

}  // namespace

std::vector<double> transfer_means(const Problem& problem, std::span<const double> means,
                                   std::span<const CellChange> changes) {
  const StateRange<double> range = problem.flux.range();
  return transfer(means, changes,
                  [&](std::size_t j) { return 0.5 * bounded_half_rise(problem, means, j, range); });
}

std::vector<double> transfer_constants(std::span<const double> values, std::span<const CellChange> changes) {
  return transfer(values, changes, [](std::size_t) { return 0.0; });
}

std::vector<double> transfer_fluxes(const Problem& problem, std::span<const double> fluxes,
                                    std::span<const CellChange> changes) {
  SHEARFRONT_EXPECTS(fluxes.size() == changes.size() + 1, "a change for each cell");
  std::vector<double> next{fluxes[0]};
  next.reserve(fluxes.size());
  for (std::size_t j = 0; j < changes.size(); ++j) {
    if (changes[j] == CellChange::split) next.push_back(in_the_middle(problem, fluxes, j));
    if (changes[j] == CellChange::merge) ++j;
    next.push_back(fluxes[j + 1]);
  }
  return next;
}

}  // namespace shearfront::diffusion
