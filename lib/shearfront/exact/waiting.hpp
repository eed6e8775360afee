// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/travel.hpp"

namespace shearfront::exact {

/// Paths that rest at an interface.
///
/// At interface i the rest costs H_i = s min(a_below, a_above) / 4 per unit time, and the whole path has H =
/// H_i: it comes from, and returns to, the side with the larger a (in the other layer q = 0), through its
/// BASIN: the layers next to the interface on that side whose rate exceeds 4 H_i. Neither the way from a
/// source to i nor the way from i to z depends on t, so
///
///     value = A + (z - z_i) / 2 + Q(i -> z) / 2 + H_i t,   A = min over sources with tau(source -> i) <= t -
///     tau(i -> z)
///
/// and per interface only a list of (tau, A), tau increasing and A decreasing, is kept. Time and Q from the
/// interface to each boundary of its basin are stored while all basins together have no more than
/// kMaxStored boundaries, and summed anew per query beyond.
template <Real Scalar>
class Waiting {
 public:
  struct Entry {
    Scalar tau, A;
    std::size_t source;  ///< point of Cells
  };

  Waiting(const Geometry<Scalar>& geometry, const Cells<Scalar>& cells, const Scalar& slack);

  /// Improves `best` by every waiting path that ends in (z, t), z in layer k.
  void search(const Geometry<Scalar>& geometry, const Cells<Scalar>& cells, const Scalar& z, std::size_t k,
              const Scalar& t, const Scalar& upper, Path<Scalar>& best) const;
  /// Sources that may wait at boundary i, nearest first.
  [[nodiscard]] const std::vector<Entry>& entries(std::size_t i) const { return basins_[i].entries; }

  static constexpr std::size_t kMaxStored = 2'000'000;

 private:
  struct Basin {
    bool below = false;  ///< on which side of the interface it lies
    Scalar h{0};         ///< 4 H_i, the smaller rate
    std::size_t n_layers = 0;
    bool stored = false;
    std::size_t offset = 0;  ///< of its sums in tau_ and Q_
    std::vector<Entry> entries;
  };
  [[nodiscard]] static bool may_start(const Geometry<Scalar>& g, const Cells<Scalar>& cells,
                                      std::size_t point, bool upward, const Scalar& h);
  void build(const Geometry<Scalar>& g, const Cells<Scalar>& cells, std::size_t i, Basin& basin);
  void try_interface(const Geometry<Scalar>& g, const Cells<Scalar>& cells, std::size_t i, const Scalar& z,
                     std::size_t k, const Scalar& t, const Scalar& upper, Scalar& Q_floor,
                     Path<Scalar>& best) const;

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<Basin> basins_;                             ///< per boundary; walls stay empty
  std::vector<std::size_t> slower_above_, slower_below_;  ///< next layer of strictly smaller rate, or kNone
  std::vector<Scalar> tau_, Q_;
  Scalar slack_;
};

extern template class Waiting<double>;

}  // namespace shearfront::exact
