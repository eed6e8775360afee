// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/fv/kernel.hpp"

namespace shearfront::fv {

/// What March is made from. All vectors are in the order of the cells.
struct CellData {
  std::vector<double> phi;         ///< averages
  std::vector<double> rates;       ///< s a of the cells or of the faces, walls included (fv/grid.hpp)
  std::vector<double> narrowness;  ///< reference width / width of the cell; empty: 1
  std::vector<int> octaves;        ///< a cell steps 2^octave times as long as the fastest; empty: 0
  double coefficient = 0;          ///< of the cell with the largest rate * narrowness
  double fastest = 0;              ///< that rate * narrowness
};

/// rate * narrowness of cell j, what bounds its time step; of faces the larger one.
[[nodiscard]] double speed_of(const CellData& data, std::size_t j);

/// A run of cells that step together, with copies of kLanes cells of each neighbour that steps more slowly.
///
/// A border between sections belongs to the faster one: its step moves the copies, too, in time steps of
/// their own length, so they have the right states in both stages of a step; then they are put back, and
/// what happened to them is summed up. The slow section's own step treats the border as a wall; its last
/// kBorderCells cells, all that the border can have influenced, get the mean of the sums instead. So a slow
/// cell's step is the mean of full steps of its own length, each of which keeps the bounds and is monotone in
/// first order, and what crosses the border is the same amount on both sides.
///
/// Where cells have equal widths the mass is kept to the bit and v stays in [-1, 1]. The flux x through the
/// border, in quanta of the faster cell's step, is rounded down in size, and what is left is carried to the
/// next of the n steps that a slow one takes; the last carry, less than a quantum, has not moved and is
/// forgotten. The slow cell changes by n times whole quanta in every step, by whole quanta in their mean. x
/// is cut to the room in the faster cell, so that no carry takes more than there is. (A rounding to nearest
/// would be amplified by n in the slow cell, which then lacks the room for it.) The bounds, notation of
/// MusclPass:
///   fast cell, x filling it: at most its room. x emptying it: the sum falls short by less than a quantum in
///     any step, and [(a1 + a2) / 2] <= d + b1 / 2 was all that was used there: v' < 1 + q.
///   slow cell, x emptying it: the same, for the mean of the steps; with the cells beside it, each of which
///     is in its bounds in every step, the sum of all kBorderCells, a whole number, has room in them.
///   slow cell, x filling it: the mean of x <= (a1 + a2) / 2 <= (d + a1 - [a1] + [b1]) / 2, and what leaves
///     through the other face is at least b1 / 2 - 1/2 >= [b1] / 2 - 3/4: v' < 1 + q for d >= 1; for d = 0,
///     a1 = 0 and x <= [b1] / 4.
/// In first order a face is bounded on its own, as in Kernel.
/// Source: Osher & Sanders (1983), Math. Comp. 41, 321-336; two stages: Constantinescu & Sandu (2007), J.
/// Sci. Comput. 33, 239-278.
class Section {
 public:
  /// Cells first ... first + n - 1 of the data; `walls`: states beyond bottom and top.
  Section(const Kernel& kernel, const CellData& data, std::size_t first, std::size_t n, double lo, double hi,
          std::array<double, 2> walls);

  [[nodiscard]] int octave() const { return octave_; }
  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t n_cells() const { return n_; }
  /// States of the own cells.
  [[nodiscard]] double* states() { return v_.data() + kLanes + copies_below_; }
  [[nodiscard]] bool has_states_of(const Section& other) const { return v_ == other.v_; }

  /// All steps become `fraction` times as long.
  void shorten(double fraction);
  /// `steps` <= kDepth steps of all cells. Large sections are swept in blocks that stay in the cache.
  void sweep(const Kernel& kernel, std::size_t steps);
  /// Half the rise across the own cells; the vector may be longer.
  void half_rises(const Kernel& kernel, std::vector<double>& rises);

  static constexpr std::size_t kDepth = 64;
  static constexpr std::size_t kBorderCells = 4;

 private:
  friend class Border;
  [[nodiscard]] Faces faces(std::size_t first);

  int octave_;
  bool is_per_cell_ = false;  ///< coefficients belong to cells
  std::size_t first_, n_, copies_below_, copies_above_, n_padded_;
  FaceBelow bottom_;
  // With kLanes cells beyond the lowest, and more beyond the highest.
  std::vector<double> v_, c_, ratio_, remainder_, carry_;
  std::vector<FasterSide> faster_side_;
  std::vector<unsigned char> is_special_;
};

/// Between a section and the one above it; see Section.
class Border {
 public:
  explicit Border(bool is_faster_below) : is_faster_below_(is_faster_below) {}

  [[nodiscard]] bool is_faster_below() const { return is_faster_below_; }
  /// After a step of the faster one: sums up and puts back.
  void collect(Section& below, Section& above, double quantum);
  /// After a step of the slower one.
  void deliver(Section& below, Section& above, double quantum);

 private:
  __extension__ using Sum = __int128;  // 2^53 quanta a step, any number of steps
  static constexpr std::size_t kCells = Section::kBorderCells;

  /// Cell i from the border of the slower one, and its copy.
  [[nodiscard]] double& slow(Section& below, Section& above, std::size_t i) const;
  [[nodiscard]] double& copy(Section& below, Section& above, std::size_t i) const;
  /// Whether all slow cells at the border have the same width.
  [[nodiscard]] bool has_equal_cells(const Section& fast) const;

  bool is_faster_below_;
  std::array<Sum, kCells> sums_{};
  std::array<double, kCells> owed_{};  ///< changes of the slow cells that wait; 0 on cells of equal width
};

}  // namespace shearfront::fv
