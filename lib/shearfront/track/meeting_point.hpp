// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/track/front_list.hpp"

/// Where fronts meet: the point from which one front l | r carries the mass they bring. Their positions at
/// the computed time differ by rounding errors of that time; taking any one of them would lose mass at every
/// event. Counted from the strongest front, which hardly moves: were it another one, the rounding of the
/// distance between the two would go into the position at full weight, event after event.
namespace shearfront::meeting_point_detail {

template <Real Scalar>
[[nodiscard]] Scalar size(const Scalar& x) {
  return x < 0 ? -x : x;
}

/// A weak outgoing front must not magnify rounding errors.
template <Real Scalar>
[[nodiscard]] Scalar bounded(const Scalar& correction, const Scalar& widest) {
  return size(correction) <= Scalar(2) * widest ? correction : Scalar(0);
}

}  // namespace shearfront::meeting_point_detail

namespace shearfront {

/// The fronts a .. b of one layer, met at time `now`, to be replaced by l | r.
template <StateGrid Grid, Real Scalar>
[[nodiscard]] TwoSum<Scalar> meeting_point(const Grid& grid, const FrontList<Scalar>& fronts, FrontIndex a,
                                           FrontIndex b, State l, State r, const Scalar& now) {
  using namespace meeting_point_detail;
  using Node = FrontNode<Scalar>;
  const std::size_t layer = fronts[a].layer;
  const auto jump = [&](const Node& n) {
    return Scalar(grid.phi(layer, n.below) - grid.phi(layer, n.above));
  };
  FrontIndex strongest = a;
  for (FrontIndex i = a; i != b;) {
    i = fronts[i].next;
    if (size<Scalar>(jump(fronts[i])) > size<Scalar>(jump(fronts[strongest]))) strongest = i;
  }
  const Node& anchor = fronts[strongest];
  Scalar shift = anchor.moved(now);
  CompensatedSum<Scalar> moment;
  Scalar widest(0);
  for (FrontIndex i = a;; i = fronts[i].next) {
    const Node& n = fronts[i];
    const Scalar offset = (n.z - anchor.z) + (n.moved(now) - shift);
    moment += offset * jump(n);
    widest = std::max(widest, size<Scalar>(offset));
    if (i == b) break;
  }
  if (l != r) shift += bounded<Scalar>(moment.value() / (grid.phi(layer, l) - grid.phi(layer, r)), widest);
  return TwoSum<Scalar>(anchor.z, shift);
}

/// The same for two fronts that become one of the given speed: by Rankine-Hugoniot the weights of mass are
/// those of speed.
template <Real Scalar>
[[nodiscard]] TwoSum<Scalar> merging_point(const FrontNode<Scalar>& first, const FrontNode<Scalar>& second,
                                           const Scalar& speed, const Scalar& now) {
  using namespace meeting_point_detail;
  const Scalar moved_first = first.moved(now), moved_second = second.moved(now);
  const Scalar offset = (second.z - first.z) + (moved_second - moved_first);
  const Scalar weight = (speed - first.speed) / (second.speed - first.speed);  // of the second front
  const bool from_second = weight + weight > Scalar(1);
  const Scalar share = from_second ? weight - Scalar(1) : weight;
  return {from_second ? second.z : first.z,
          (from_second ? moved_second : moved_first) + bounded<Scalar>(offset * share, size<Scalar>(offset))};
}

}  // namespace shearfront
