// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shearfront::diffusion {

/// What becomes of a cell: it stays, becomes its two halves, or is one of two halves that become whole again.
/// Of two halves both are marked, the lower one first.
enum class CellChange : unsigned char { keep, split, merge };

/// Cells of a bed, each one of n equal cells halved so many times (its level), from the bottom upwards.
/// Faces do not depend on the way that led to a grid: the same face has the same height, to the last bit.
class RefinedCells {
 public:
  static constexpr int kMostHalvings = 30;

  /// n >= 2 equal cells.
  RefinedCells(double bottom, double top, std::size_t n);

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] std::vector<double> faces() const;
  /// The changes by which cells that are wider than wanted are split, and halves merged if both are to be at
  /// least twice as wide: one halving each, so that a grid that is off by more takes several rounds.
  [[nodiscard]] std::vector<CellChange> changes_towards(std::span<const double> wanted_widths) const;
  /// Whether a cell is twice as wide as wanted and cannot be halved: kMostHalvings times, or its faces could
  /// hardly be told apart (widths below 2^12 units in the last place of the heights).
  [[nodiscard]] bool are_too_wide_for(std::span<const double> wanted_widths) const;
  /// One change for each cell.
  void apply(std::span<const CellChange> changes);

 private:
  struct Cell {
    int level;
    std::uint64_t index;  ///< of the n 2^level cells of that level
  };

  /// Width of a cell over the height of the bed.
  [[nodiscard]] double share(const Cell& cell) const { return shares_[static_cast<std::size_t>(cell.level)]; }
  /// Whether cells j and j + 1 are the halves of one.
  [[nodiscard]] bool are_halves(std::size_t j) const;

  double bottom_, top_;
  int most_halvings_ = 0;
  std::array<double, kMostHalvings + 1> shares_;  ///< of each level
  std::vector<Cell> cells_;
};

}  // namespace shearfront::diffusion
