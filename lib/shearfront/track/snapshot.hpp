// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/track/front_list.hpp"

namespace shearfront {

/// Heights of all fronts and boundaries at one time, ascending (rounding may not reverse them), with the
/// state above each but the last.
template <Real Scalar>
struct Snapshot {
  std::vector<Scalar> z;
  std::vector<std::size_t> layer;  ///< of the piece above z[i]
  std::vector<State> state;        ///< of the piece above z[i]; one less than z
  std::vector<bool> is_front;      ///< whether z[i] is a front, not a boundary
  std::vector<Scalar> age;         ///< time since the front at z[i] was born, 0 for boundaries
};

/// Cost: O(fronts).
template <StateGrid Grid, Real Scalar>
[[nodiscard]] Snapshot<Scalar> snapshot_of(const Grid& grid, const FrontList<Scalar>& fronts,
                                           const Scalar& now) {
  Snapshot<Scalar> s;
  const std::size_t n = fronts.n_fronts() + fronts.n_boundaries();
  s.z.reserve(n), s.layer.reserve(n), s.state.reserve(n), s.is_front.reserve(n), s.age.reserve(n);
  fronts.for_each([&](FrontIndex i, const FrontNode<Scalar>& node) {
    Scalar z = node.position(now);
    const bool is_boundary = fronts.is_boundary(i);
    if (!is_boundary) {
      // A front may stick out of its layer, or over its neighbour, by rounding: never by more.
      z = std::min(z, grid.boundary(node.layer + 1));
      if (z < s.z.back()) z = s.z.back();
    }
    s.z.push_back(std::move(z));
    if (node.next == kNoFront) return;
    s.state.push_back(node.above);
    s.layer.push_back(node.layer);
    s.is_front.push_back(!is_boundary);
    s.age.push_back(is_boundary ? Scalar(0) : now - node.t);
  });
  s.is_front.push_back(false);
  s.age.push_back(Scalar(0));
  return s;
}

/// Mass from the unrounded positions: Abel summation, sum over jumps of z (phi_below - phi_above).
template <StateGrid Grid, Real Scalar>
[[nodiscard]] Scalar mass_of(const Grid& grid, const FrontList<Scalar>& fronts, const Scalar& now) {
  CompensatedSum<Scalar> sum;
  fronts.for_each([&](FrontIndex i, const FrontNode<Scalar>& node) {
    const std::size_t under = fronts.is_boundary(i) ? std::size_t{i} - 1 : node.layer;
    const Scalar phi_below = i == 0 ? Scalar(0) : Scalar(grid.phi(under, node.below));
    const Scalar phi_above = node.next == kNoFront ? Scalar(0) : Scalar(grid.phi(node.layer, node.above));
    const Scalar jump = phi_below - phi_above;
    sum += node.z * jump;
    sum += node.moved(now) * jump;
  });
  return sum.value();
}

}  // namespace shearfront
