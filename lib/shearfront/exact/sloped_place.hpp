// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>

#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_crossing.hpp"

namespace shearfront::exact {

/// A height of a view with the cells below and above it, the same one inside a cell, and r there.
template <Real Scalar>
struct SlopedPlace {
  Scalar z;
  std::size_t below, above;
  Scalar rate_below, rate_above;
  RunEnds<Scalar> down, up;  ///< from z to the ends of these cells
  Scalar time_below, back_below, time_above,
      back_above;  ///< of pure states through the parts of the cells: up, down

  SlopedPlace(const SlopedView<Scalar>& view, const Scalar& height)
      : z(height),
        below(0),
        above(static_cast<std::size_t>(std::upper_bound(view.x.begin() + 1, view.x.end() - 1, z) -
                                       view.x.begin()) -
              1),
        rate_below(0),
        rate_above(view.rate(above, z)),
        down(view.downwards[above]),
        up(view.form[above], Scalar(view.x[above + 1] - z), rate_above, view.high[above]) {
    const bool is_at_node = above > 0 && z == view.x[above];
    below = is_at_node ? above - 1 : above;
    rate_below = is_at_node ? view.rate(below, z) : rate_above;
    down = is_at_node
               ? view.downwards[below]
               : RunEnds<Scalar>(view.form[below], Scalar(z - view.x[below]), rate_below, view.low[below]);
    if (!view.fluxes) {
      const Scalar one(1), zero(0);
      time_below = back_below = Crossing<Scalar>(down, one, one, zero).T;
      time_above = back_above = Crossing<Scalar>(up, one, one, zero).T;
      return;
    }
    time_below = view.pure_way(below, down.d, down.r2, down.r1, true);
    time_above = view.pure_way(above, up.d, up.r1, up.r2, true);
    back_below = view.pure_way(below, down.d, down.r2, down.r1, false);
    back_above = view.pure_way(above, up.d, up.r1, up.r2, false);
  }
  [[nodiscard]] SlopedPlace turned_over(const SlopedView<Scalar>& view) const {
    SlopedPlace place = *this;
    place.z = -z;
    place.below = view.n_cells() - 1 - above;
    place.above = view.n_cells() - 1 - below;
    std::swap(place.rate_below, place.rate_above);
    std::swap(place.down, place.up);
    std::swap(place.time_below, place.back_above);
    std::swap(place.time_above, place.back_below);
    return place;
  }
};

}  // namespace shearfront::exact
