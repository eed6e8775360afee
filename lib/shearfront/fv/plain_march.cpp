// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/plain_march.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shearfront::fv {
namespace {

double mean_of_two(double a, double b) { return 2 / (1 / a + 1 / b); }

}  // namespace

PlainMarch::PlainMarch(FaceRule rule, const Scene<double>& scene, const Grid& grid,
                       FaceCoefficient face_coefficient)
    : rule_(rule),
      is_bounded_(rule == FaceRule::godunov || rule == FaceRule::engquist_osher),
      is_periodic_(scene.spec().is_periodic),
      coefficients_(cell_rates(scene, grid)),
      packings_(cell_packings(scene, grid)),
      capacities_(capacities(scene, grid)),
      face_coefficients_(face_coefficient == FaceCoefficient::value ? face_values(scene, grid)
                                                                    : face_rates(scene, grid)),
      x_(initial_averages(scene, grid)),
      rest_(grid.n_cells, 0.0),
      fluxes_(grid.n_cells + 1, 0.0),
      outside_{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()} {
  const std::size_t n = grid.n_cells;
  packings_.resize(n, 1.0);
  if (capacities_.empty()) capacities_.assign(n, grid.cell_width());
  for (const Flux<double>& flux : scene.fluxes()) branches_.push_back(flux_branches(flux));
  for (std::size_t j = 0; j < n; ++j) flux_of_.push_back(scene.flux_index(grid.middle(j)));
  // The middle of a cell says which flux it has; what this flux has no room for waits.
  for (std::size_t j = 0; j < n; ++j) {
    const double x = std::clamp(x_[j], branches_[flux_of_[j]].lo, branches_[flux_of_[j]].hi);
    rest_[j] = x_[j] - x;
    x_[j] = x;
  }
  set_end_coefficients(scene);
  double fastest = 0;
  for (std::size_t j = 0; j < n; ++j) {
    double k = coefficients_[j];
    if (rule == FaceRule::engquist_osher) k = std::max(face_coefficients_[j], face_coefficients_[j + 1]);
    fastest = std::max(fastest, k * branches_[flux_of_[j]].largest_slope / capacities_[j]);
  }
  largest_step_ = (is_bounded_ ? 1 : 0.5) / fastest;
}

void PlainMarch::set_end_coefficients(const Scene<double>& scene) {
  if (is_periodic_)
    face_coefficients_.front() = face_coefficients_.back() =
        mean_of_two(coefficients_.front(), coefficients_.back());
  if (scene.spec().outside_bottom) face_coefficients_.front() = coefficients_.front();
  if (scene.spec().outside_top) face_coefficients_.back() = coefficients_.back();
  // Between different fluxes Godunov's flux counts, with the coefficients of both cells.
  for (std::size_t j = 1; j < x_.size(); ++j)
    if (flux_of_[j - 1] != flux_of_[j])
      face_coefficients_[j] = std::max(coefficients_[j - 1], coefficients_[j]);
}

double PlainMarch::amount() const {
  CompensatedSum<double> sum;
  for (std::size_t j = 0; j < x_.size(); ++j) {
    sum += capacities_[j] * x_[j];
    sum += capacities_[j] * rest_[j];
  }
  return sum.value();
}

void PlainMarch::settle() {
  const std::size_t n = x_.size();
  CompensatedSum<double> spare;
  spare += amount();
  for (std::size_t j = 0; j < n; ++j) {
    x_[j] = branches_[flux_of_[j]].lo;
    rest_[j] = 0;
    spare += -capacities_[j] * x_[j];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = branches_.front().is_minimum ? i : n - 1 - i;
    const double room = branches_[flux_of_[j]].hi - x_[j];
    const double rise = std::clamp(spare.value() / capacities_[j], 0.0, room);
    x_[j] += rise;
    if (rise < room) return;
    spare += -capacities_[j] * rise;
  }
}

double PlainMarch::step(double dt) {
  const std::size_t n = x_.size();
  const FaceSide lowest = side(0);
  FaceSide below = lowest;
  for (std::size_t j = 1; j < n; ++j) {
    const FaceSide above = side(j);
    fluxes_[j] = face_flux(rule_, below, above, face_coefficients_[j]);
    below = above;
  }
  if (is_periodic_) {
    fluxes_[0] = fluxes_[n] = face_flux(rule_, below, lowest, face_coefficients_[0]);
  } else {
    const FaceRule rule = is_bounded_ ? FaceRule::godunov : rule_;
    if (!std::isnan(outside_[0]))
      fluxes_[0] = face_flux(rule, beside(0, outside_[0]), lowest, face_coefficients_[0]);
    if (!std::isnan(outside_[1]))
      fluxes_[n] = face_flux(rule, below, beside(n - 1, outside_[1]), face_coefficients_[n]);
    inflow_ += dt * fluxes_[0];
    inflow_ += -dt * fluxes_[n];
  }
  double largest = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double change = dt / capacities_[j] * (fluxes_[j] - fluxes_[j + 1]) + rest_[j];
    const double x = x_[j];
    double next = x + change;
    const double added = next - x;  // two-sum: next + rest_ is x + change exactly
    rest_[j] = (x - (next - added)) + (change - added);
    if (is_bounded_) {
      const FluxBranches& flux = branches_[flux_of_[j]];
      const double bounded = std::clamp(next, flux.lo, flux.hi);
      rest_[j] += next - bounded;
      next = bounded;
    }
    largest = std::max(largest, std::abs(next - x));
    x_[j] = next;
  }
  return largest;
}

}  // namespace shearfront::fv
