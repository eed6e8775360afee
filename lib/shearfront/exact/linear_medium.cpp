// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/linear_medium.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/exact/linear_gradient.hpp"
#include "shearfront/exact/linear_search.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

template <Real Scalar>
LinearMedium<Scalar>::LinearMedium(LinearPieces<Scalar> pieces, Cells<Scalar> cells, Scalar mass)
    : Medium<Scalar>(std::move(cells), std::move(mass)),
      pieces_(std::move(pieces)),
      up_(pieces_, cells_, false),
      down_(pieces_, cells_, true),
      throats_(up_, down_) {}

template <Real Scalar>
Path<Scalar> LinearMedium<Scalar>::best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const {
  return search(z, t, upper, false);
}

template <Real Scalar>
Path<Scalar> LinearMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search(z, t, infinity<Scalar>(), true);
}

template <Real Scalar>
Path<Scalar> LinearMedium<Scalar>::search(const Scalar& z, const Scalar& t, const Scalar& upper,
                                          bool moving_only) const {
  using std::sqrt;
  Path<Scalar> best;
  LinearSearch<Scalar>(up_, z, t, upper, moving_only, best).run();
  LinearSearch<Scalar>(down_, Scalar(-z), t, upper, moving_only, best).run();
  const std::size_t above = cells_.cell_at(z);
  const bool is_node = above > 0 && z == cells_.x[above];
  const std::size_t below = is_node ? above - 1 : above;
  const Scalar rate_below = up_.rate(below, z), rate_above = up_.rate(above, z);
  throats_.search(up_, z, below, above, rate_below, rate_above, t, upper, best);
  if (best.kind == PathKind::none) return best;
  // The momentum next to z on its upper side. A path that sets out within rounding of a jump may bring a flux that only
  // the lower side can carry.
  const Scalar& r = rate_above;
  const Scalar q2 = ((r - best.r_reference) + best.r_reference * best.x * best.x) / r;
  const Scalar q = q2 > 0 ? Scalar(sqrt(q2)) : Scalar(0);
  const Scalar less = std::min(Scalar(0.5), Scalar(Scalar(2) * best.H / r / (Scalar(1) + q)));
  best.p = best.upward ? Scalar(Scalar(1) - less) : less;
  return best;
}

template <Real Scalar>
Scalar LinearMedium<Scalar>::pure_travel_time(const Scalar& from, const Scalar& to) const {
  const Scalar &lo = std::min(from, to), &hi = std::max(from, to), one(1);
  Scalar time(0);
  for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
    const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
    if (b > a) time += Crossing<Scalar>(b - a, pieces_.rate(k, a), one, pieces_.rate(k, b), one, Scalar(0)).T;
  }
  return time;
}

template <Real Scalar>
Scalar LinearMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& /*t*/,
                                       FinalAmount amount) const {
  const bool full = amount == FinalAmount::full_below || (amount == FinalAmount::both && path.upward);
  return (full ? Scalar(z - this->bottom()) : this->mass()) - path.value;
}

template <Real Scalar>
PathGradient<Scalar> LinearMedium<Scalar>::gradient(const Path<Scalar>& path, const Scalar& z,
                                                    const Scalar& t) const {
  return LinearGradient<Scalar>(pieces_, cells_, path, z, t).run();
}

template class LinearMedium<Instantiated>;

}  // namespace shearfront::exact
