// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "shearfront/diffusion/grid_transfer.hpp"
#include "shearfront/diffusion/problem.hpp"
#include "shearfront/diffusion/refined_cells.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::diffusion {

/// How fine cells are to be.
struct Resolution {
  double bend;         ///< see wanted_widths()
  double equal_width;  ///< of the equal cells at the beginning
  double fastest;      ///< W = max |f'|
};

/// Widths dz_j that cells of such states should have.
///
///     dz^2 |phi_zz| = 0.03 bend^(3/2),
///
/// phi_z at walls being what the condition there says (so a layer at a wall is seen before it is resolved),
/// but no smaller than fronts ask for: the width sqrt(bend / 0.0962) D / (|r| W) at which the steepest front
/// there is, the logistic one of the width D / (|r| W), bends by `bend` from one cell to the next, or an
/// eighth of equal_width if that is less. What is steeper than fronts, as a jump in the beginning, is resolved
/// no further.
///
/// So cells of a front bend by up to `bend`, and cells change their widths only where states bend far less:
/// the truncation error jumps there, and when the grid moves on, what states had adjusted to it is left
/// behind as a disturbance. It has to stay below what time steps may err, tolerance^(3/2), or it keeps them
/// short. Cost: O(cells).
[[nodiscard]] std::vector<double> wanted_widths(const Problem& problem, std::span<const double> states,
                                                const Resolution& resolution);

/// Widths that grow by at most a sixteenth of the distance from where they are small: fronts may go some
/// cells before they leave the small ones, and neighbours differ by a factor of two at most.
[[nodiscard]] std::vector<double> graded(const Problem& problem, std::vector<double> widths);

/// Grids for one scene that follow its fronts: n equal cells, halved where wanted_widths() asks for it and
/// merged again when a front has passed. Each front takes about 32 cells for every factor of two between the
/// width of the others and its own.
class Refinement {
 public:
  static constexpr std::size_t kMostCells = 1'000'000;

  /// `scene` must outlive this. Preconditions: refusal(scene) is empty, 1e-6 <= bend <= 0.1 (below, the
  /// rounding of the iteration asks for cells).
  Refinement(const Scene<double>& scene, std::size_t n_cells, double bend);

  /// The scene on the grid for its initial data, which n_cells must resolve to an eighth of a cell: what has
  /// the same mean in all eighths of a cell is not seen.
  [[nodiscard]] Problem start();
  /// A better grid once the present one, that of the last call, does not do, with a margin that it may keep for
  /// some steps; every 32 calls also if a quarter of its cells may be merged. Cost: O(cells).
  [[nodiscard]] std::optional<Regrid> next(const Problem& present, std::span<const double> states);
  /// More than kMostCells cells were wanted, or narrower ones than heights can tell apart; the grid then
  /// stays as it is.
  [[nodiscard]] bool is_exhausted() const { return is_exhausted_; }

 private:
  /// Whether a quarter of the cells may be merged.
  [[nodiscard]] bool is_worth_cleaning(const Problem& present, const std::vector<double>& widths) const;
  /// Whether there is anything to change; it is done.
  bool change_towards(const Problem& present, std::vector<double> widths, std::vector<CellChange>& changes);

  const Scene<double>& scene_;
  RefinedCells cells_;
  Resolution resolution_;
  int n_calls_ = 0;
  bool is_exhausted_ = false;
};

}  // namespace shearfront::diffusion
