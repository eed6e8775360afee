// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/numeric/sum.hpp"
#include "shearfront/track/curved_system.hpp"

namespace shearfront {

/// The regions of a bed at one time from bottom to top, each a steady state of one piece, with the nodes between them.
struct CurvedSnapshot {
  double t = 0;
  std::vector<double> z;           ///< of all nodes, ascending (rounding may not reverse them)
  std::vector<std::size_t> piece;  ///< of the region above z[i]; one less than z
  std::vector<State> state;        ///< of the same
  std::vector<FrontIndex> node;    ///< at z[i]
  std::vector<double> below;       ///< int u dz from the bottom up to z[i]
};

/// Cost: a root per front.
template <class Observer>
[[nodiscard]] CurvedSnapshot snapshot_of(const CurvedSystem<Observer>& system, double t) {
  CurvedSnapshot s;
  s.t = t;
  const LevelCurves& grid = system.grid();
  const auto& fronts = system.fronts();
  CompensatedSum<double> amount;
  fronts.for_each([&](FrontIndex i, const CurvedNode& node) {
    double z = node.z;
    if (!fronts.is_boundary(i)) {
      z = std::min(position_of(grid, node, t), grid.boundary(node.layer + 1));
      z = std::max(z, s.z.back());
    }
    if (!s.z.empty()) amount += grid.amount(s.piece.back(), s.state.back(), s.z.back(), z);
    s.z.push_back(z);
    s.node.push_back(i);
    s.below.push_back(amount.value());
    if (node.next == kNoFront) return;
    s.piece.push_back(node.layer);
    s.state.push_back(node.above);
  });
  return s;
}

}  // namespace shearfront
