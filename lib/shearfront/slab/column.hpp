// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront::slab {

/// One step of a column of a slab, phi_t + (s a f(phi))_z = (D phi_z)_z between walls, by the engines of beds: Crank-Nicolson
/// where there is diffusion (diffusion::CrankNicolson, its raised scheme), else MUSCL (fv::March). States are the means of
/// equal cells. A step does not depend on those before it, so an object may serve many columns.
class Column {
 public:
  virtual ~Column() = default;
  /// Replaces the states by those after dt; false if the step did not converge.
  [[nodiscard]] virtual bool advance(std::span<double> states, double dt) = 0;
  /// Up to which dt states stay in the range of the flux, in steps of second order.
  [[nodiscard]] virtual double largest_step() const = 0;
  /// phi of the states: linear in each cell.
  [[nodiscard]] virtual Profile<double> profile(std::span<const double> states) const = 0;
};

/// Why the columns of a scene have no such step; empty if they have.
[[nodiscard]] std::string column_refusal(const Scene<double>& scene, std::size_t n_cells);

/// Preconditions: column_refusal() is empty; `scene` outlives the object.
[[nodiscard]] std::unique_ptr<Column> make_column(const Scene<double>& scene, std::size_t n_cells);

}  // namespace shearfront::slab
