// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/section.hpp"

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
  /// `cfl`: time step in terms of the largest allowed, in (0, 1]; sets data.coefficient and data.fastest.
  /// With data.octaves one step is that of the slowest cells, and the others make 2, 4, 8, ... meanwhile.
  March(const Kernel& kernel, const UnimodalFlux& flux, CellData data, double cfl);

  [[nodiscard]] std::size_t n_cells() const { return phi_.size(); }
  [[nodiscard]] std::uint64_t n_steps() const { return n_steps_; }
  [[nodiscard]] std::uint64_t updates_per_step() const { return updates_per_step_; }
  /// One step lasts cfl * reference width / speed(). 0 if nothing can ever move.
  [[nodiscard]] double speed() const { return speed_; }

  /// Cost: updates_per_step() cell updates a step. Large grids with equal steps everywhere are swept in
  /// blocks that stay in the cache for many steps.
  void advance(std::uint64_t steps);
  /// Whether the states come back after a step, or after up to four. Cost: as many steps.
  [[nodiscard]] bool is_at_rest();
  /// phi of every cell after a last step of `fraction` (0 <= fraction < 1) of a whole one; the march itself
  /// stays where it is. Continuous in fraction, also where the fraction turns into a whole step.
  [[nodiscard]] CellStates states(double fraction);

 private:
  /// All cells, and what lies between the sections: borders[i] between the sections i and i + 1.
  struct Bed {
    std::vector<Section> sections;
    std::vector<Border> borders;
  };
  /// A step of length 2^octave of all sections up to that octave.
  void step(Bed& bed, int octave) const;

  const Kernel& kernel_;
  double lo_, hi_, quantum_;
  int slowest_octave_ = 0;
  std::uint64_t n_steps_ = 0, updates_per_step_ = 0;
  double speed_;
  Bed bed_, side_;  ///< side_: the last, shortened step
  std::vector<double> phi_, half_rises_, section_rises_;
};

/// The state of mass `total` (sum of phi * width) in which no face carries a flux: phi = hi at the bottom and
/// lo above (is_minimum; upside down otherwise), with one mixed cell between (Godunov, muscl) or two
/// (Engquist-Osher, whose steady shocks have f(alpha) + f(beta) = f(m)). It is the only one: without flux,
/// a face of Godunov has hi below it or lo above it, one of Engquist-Osher f(max(l, m)) + f(min(r, m)) =
/// f(m); both force this order of states. Accuracy: rounding. `widths`: of the cells, in any unit.
[[nodiscard]] std::vector<double> steady_state(Scheme scheme, const UnimodalFlux& flux, double total,
                                               const std::vector<double>& widths);

}  // namespace shearfront::fv
