// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shearfront/fv/kernel.hpp"

namespace shearfront::fv {

/// phi of all cells: their averages and, where it is linear inside, half its rise across each (else empty).
struct CellStates {
  std::span<const double> phi, half_rise;

  [[nodiscard]] double at_bottom(std::size_t j) const {
    return half_rise.empty() ? phi[j] : phi[j] - half_rise[j];
  }
  [[nodiscard]] double at_top(std::size_t j) const {
    return half_rise.empty() ? phi[j] : phi[j] + half_rise[j];
  }
};

/// The states of all cells and their march in time, step by step.
///
/// Guaranteed: the states after n steps depend on n only, to the bit, not on how advance() was called.
class March {
 public:
  /// `phi`: averages of the cells. `rates`: s a of the cells or of the faces, walls included, see
  /// fv/grid.hpp. `cfl`: time step in terms of the largest allowed for the fastest of them, in (0, 1].
  March(const Kernel& kernel, const UnimodalFlux& flux, const std::vector<double>& phi,
        const std::vector<double>& rates, double cfl);

  [[nodiscard]] std::size_t n_cells() const { return n_cells_; }
  [[nodiscard]] std::uint64_t n_steps() const { return n_steps_; }
  /// One step lasts cfl dz / speed(): largest_slope times the largest rate over the largest Courant number. 0
  /// if nothing can ever move.
  [[nodiscard]] double speed() const { return speed_; }

  /// Cost: one cell update per cell and step. Large grids are swept in blocks that stay in the cache for many
  /// steps.
  void advance(std::uint64_t steps);
  /// Whether a further step would change nothing. Cost: one step.
  [[nodiscard]] bool is_at_rest();
  /// phi of every cell after a last step of `fraction` (0 <= fraction < 1) of a whole one; the march itself
  /// stays where it is. Continuous in fraction, also where the fraction turns into a whole step.
  [[nodiscard]] CellStates states(double fraction);

 private:
  /// `steps` <= kDepth steps of all cells.
  void sweep(std::vector<double>& v, const std::vector<double>& c, std::size_t steps);
  [[nodiscard]] Faces faces(const std::vector<double>& c, std::size_t first) const;
  void find_special_faces();

  const Kernel& kernel_;
  double lo_, hi_;
  std::size_t n_cells_, n_padded_;
  std::uint64_t n_steps_ = 0;
  bool per_cell_;  ///< coefficients belong to cells
  double speed_;
  FaceBelow bottom_;
  // With kLanes cells beyond the bottom, and more beyond the top.
  std::vector<double> v_, c_;
  std::vector<unsigned char> is_special_;
  std::vector<double> side_v_, side_c_, rises_;  ///< the last, shortened step
};

/// The state of mass `total` (in cells, sum of phi) in which no face carries a flux: phi = hi at the bottom
/// and lo above (is_minimum; upside down otherwise), with one mixed cell between (Godunov, muscl) or two
/// (Engquist-Osher, whose steady shocks have f(alpha) + f(beta) = f(m)). It is the only one: without flux,
/// a face of Godunov has hi below it or lo above it, one of Engquist-Osher f(max(l, m)) + f(min(r, m)) =
/// f(m); both force this order of states. Accuracy: rounding.
[[nodiscard]] std::vector<double> steady_state(Scheme scheme, const UnimodalFlux& flux, double total,
                                               std::size_t n_cells);

}  // namespace shearfront::fv
