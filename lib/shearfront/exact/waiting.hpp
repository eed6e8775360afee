// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/law.hpp"
#include "shearfront/exact/path.hpp"

namespace shearfront::exact {

/// 4 H of the states of all cells, at their lower and upper ends.
template <Real Scalar>
struct CellFluxes {
  std::vector<Scalar> low, high;

  /// Next to an inner point.
  [[nodiscard]] const Scalar& beside(std::size_t point, bool is_above) const {
    return is_above ? low[point] : high[point - 1];
  }
};

/// Paths that rest at an interface.
///
/// At interface i the rest costs H_i = min(r_below, r_above) / 4 per unit time, and the whole path has H = H_i: it comes
/// and returns through the BASIN of i: on each side the layers next to it that a path with this H crosses in a finite
/// time. For parabolas these are layers whose rate exceeds 4 H_i, so all of them lie on the side with the larger a; a
/// flux with a kink also moves at its capacity. Neither the way from a source to i nor the way from i to z depends on
/// t, so
///
///     value = A + int_i^z peak + Q(i -> z) / 2 + H_i t,
///     A = min over sources with tau(source -> i) <= t - tau(i -> z)
///
/// and per interface only a list of (tau, A), tau increasing and A decreasing, is kept. Time and Q from the
/// interface to each boundary of its basin are stored while all basins together have no more than
/// kMaxStored boundaries, and summed anew per query beyond.
template <Real Scalar, class Law>
class Waiting {
 public:
  struct Entry {
    Scalar tau, A;
    std::size_t source;  ///< point of Cells; of a state the cell
    Scalar foot;
    bool is_state = false;  ///< it starts inside a curved cell
  };

  Waiting(const Law& law, const Cells<Scalar>& cells, const CellFluxes<Scalar>& h, const Scalar& slack);

  /// Improves `best` by every waiting path that ends in (z, t), z in layer k.
  void search(const Law& law, const Scalar& z, std::size_t k, const Scalar& t, const Scalar& upper,
              Path<Scalar>& best) const;
  /// Sources that may wait at boundary i, nearest first.
  [[nodiscard]] const std::vector<Entry>& entries(std::size_t i) const { return basins_[i].entries; }

  static constexpr std::size_t kMaxStored = 2'000'000;

 private:
  /// One side of a basin.
  struct Side {
    std::size_t n_layers = 0;
    std::size_t offset = kNone;  ///< of its sums in ways_; kNone: not stored
  };
  struct Basin {
    Scalar h{0};  ///< 4 H_i, the smaller rate
    Side above, below;
    std::vector<Entry> entries;
  };
  void build(const Law& law, const Cells<Scalar>& cells, const CellFluxes<Scalar>& h, std::size_t i,
             Basin& basin);
  void try_interface(const Law& law, std::size_t i, const Scalar& z, std::size_t k, const Scalar& t,
                     const Scalar& upper, Scalar& Q_floor, Path<Scalar>& best) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<Basin> basins_;                             ///< per boundary; walls stay empty
  std::vector<std::size_t> slower_above_, slower_below_;  ///< next layer of strictly smaller rate, or kNone
  std::vector<Leg<Scalar>>
      ways_;  ///< from an interface outwards to the near boundary of each layer of a side
  Scalar slack_;
};

}  // namespace shearfront::exact
