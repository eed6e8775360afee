// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "shearfront/slab/column.hpp"
#include "shearfront/solver/solver.hpp"

namespace shearfront::slab {

struct Settings {
  std::size_t cells = 64;    ///< of a column
  std::size_t cells_x = 64;  ///< of a row, at least 3
  double time_step = 0;      ///< the longest; 0: chosen, see below
  std::size_t threads = 0;   ///< 0: all cores that are worth it. Results do not depend on it, to the bit
};

/// phi(x, z, t) of a slab:
///
///     phi_t + u(z) phi_x + (s a(z) f(phi))_z = D (phi_xx + phi_zz),   x periodic, walls at bottom and top
///
/// by splitting after Strang: half a step of all columns (column.hpp), a whole one of all rows (rows.hpp), half a step of
/// all columns; two halves that follow each other are one step. Rows move by the mean of u over them, exactly.
/// Guaranteed: (1) the amount of grains stays what it is, to rounding; (2) phi stays in the range of the flux up to the
/// rounding of the columns; (3) a start that does not depend on x gives that of a bed by the same column steps,
/// to rounding; (4) the same bits for any number of threads. Second order in dz, dx and dt for smooth phi.
///
/// Chosen steps: rows move by no more than a cell beside each other, fronts go no farther than a cell, and no more than what
/// keeps the bounds of a column and of diffusion in x at second order.
/// Cost: about 30 ns a cell and step on one core. Source: Strang (1968), SIAM J. Numer. Anal. 5, 506-517.
class SlabMarch {
 public:
  /// Precondition: column_refusal() is empty; `scene` outlives the object and is_slab().
  SlabMarch(const Scene<double>& scene, const Settings& settings);

  /// On to time t >= time(), in equal steps. Status::ok; interrupted; not_converged.
  Status advance_to(double t, const Progress& progress = {});

  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] std::size_t n_x() const { return n_x_; }
  [[nodiscard]] std::size_t n_z() const { return n_z_; }
  /// Means of the cells; that of column i and row j is states()[i * n_z() + j].
  [[nodiscard]] const std::vector<double>& states() const { return states_; }
  void set_states(std::vector<double> states) { states_ = std::move(states); }
  /// phi over z in one column.
  [[nodiscard]] Profile<double> profile(std::size_t i) const;
  /// Of the means over x.
  [[nodiscard]] Profile<double> mean_profile() const;
  [[nodiscard]] double longest_step() const { return longest_step_; }
  [[nodiscard]] std::uint64_t n_steps() const { return n_steps_; }
  [[nodiscard]] std::uint64_t n_cell_updates() const { return n_cell_updates_; }
  [[nodiscard]] double width_x() const { return length_ / static_cast<double>(n_x_); }

 private:
  void set_start(const Scene<double>& scene);
  void choose_step(const Scene<double>& scene, double wanted);
  Status march(std::size_t n, double h, const Progress& progress);

  std::size_t n_x_, n_z_;
  double bottom_, height_, length_;
  std::vector<double> velocities_, diffusivities_;  ///< of the rows
  std::vector<std::unique_ptr<Column>> columns_;    ///< one a thread
  std::vector<double> states_;
  double time_ = 0, longest_step_ = 0;
  std::uint64_t n_steps_ = 0, n_cell_updates_ = 0;
};

}  // namespace shearfront::slab
