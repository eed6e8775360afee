// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/sloped_medium.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/initial_amount.hpp"
#include "shearfront/exact/one_piece_search.hpp"
#include "shearfront/exact/sloped_arrival.hpp"
#include "shearfront/exact/sloped_gradient.hpp"
#include "shearfront/exact/sloped_search.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

template <Real Scalar>
SlopedMedium<Scalar>::SlopedMedium(SlopedPieces<Scalar> pieces, Cells<Scalar> cells, Scalar mass)
    : Medium<Scalar>(std::move(cells), std::move(mass)),
      pieces_(std::move(pieces)),
      up_(pieces_, cells_, false),
      down_(pieces_, cells_, true),
      throats_(up_, down_) {}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const {
  return search(z, t, upper, false);
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search(z, t, infinity<Scalar>(), true);
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::search(const Scalar& z, const Scalar& t, const Scalar& upper,
                                          bool moving_only) const {
  using std::sqrt;
  if (pieces_.size() == 1 && !cells_.shape)
    return OnePieceSearch<Scalar>(up_, z, pieces_.rate(0, z), t).run(moving_only);
  Path<Scalar> best;
  const SlopedPlace<Scalar> place(up_, z);
  const std::size_t above = place.above;
  SlopedSearch<Scalar>(up_, place, t, upper, moving_only, best).run();
  SlopedSearch<Scalar>(down_, place.turned_over(up_), t, upper, moving_only, best).run();
  throats_.search(up_, place, t, upper, best);
  if (best.kind == PathKind::none) return best;
  // The momentum next to z on its upper side. A path that sets out within rounding of a jump may bring a flux that only
  // the lower side can carry.
  const Scalar& r = place.rate_above;
  const Scalar q2 = ((r - best.r_reference) + best.r_reference * best.x * best.x) / r;
  const Scalar q = q2 > 0 ? Scalar(sqrt(q2)) : Scalar(0);
  const Scalar less = std::min(Scalar(0.5), Scalar(Scalar(2) * best.H / r / (Scalar(1) + q)));
  best.p = best.upward ? Scalar(Scalar(1) - less) : less;
  // A state that has not left its cell knows p itself: after no time it is what it was, to the bit.
  const bool is_inside =
      best.kind == PathKind::constant && best.source == above && (!best.turned || best.interface == above);
  if (is_inside && up_.is_curved(above)) {
    const CurvedState<Scalar> state(up_, above, best.foot);
    best.p = arc_from_state(up_.form[above], up_.bend[above], t, state.p, state.missing, r).p;
  } else if (is_inside) {
    best.p = arc_from_state(up_.form[above], up_.bend[above], t, up_.p[above], up_.missing[above], r).p;
  }
  return best;
}

template <Real Scalar>
Scalar SlopedMedium<Scalar>::pure_travel_time(const Scalar& from, const Scalar& to) const {
  const Scalar &lo = std::min(from, to), &hi = std::max(from, to), one(1);
  Scalar time(0);
  for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
    const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
    if (!(b > a)) continue;
    const Scalar& bend = pieces_.bend[k];
    if (pieces_.form[k] == RateForm::linear)
      time += Crossing<Scalar>(RateForm::linear, b - a, pieces_.rate(k, a), one, pieces_.rate(k, b), one,
                               Scalar(0))
                  .T;
    else if (a == pieces_.boundaries[k])
      time += exponential_time(bend, pieces_.low[k], Scalar(b - a));
    else if (b == pieces_.boundaries[k + 1])
      time += exponential_time(Scalar(-bend), pieces_.high[k], Scalar(b - a));
    else
      time += exponential_time(bend, pieces_.rate(k, a), Scalar(b - a));
  }
  return time;
}

/// The value of a path is (M0 at its start + U) + sum X + H (t - sum T), U the height gained on its ways up, those in a turn
/// counted to the far end of the piece: the bracket holds data only, and the other terms are small where H is. A turn
/// from the rate r to h in a linear piece that ends at r_end has X = (r_end - h / (1 + q)) / |b| then.
template <Real Scalar>
Scalar SlopedMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                       FinalAmount amount) const {
  CompensatedSum<Scalar> sum;
  add_final_less_initial(cells_, path, z, amount, sum);
  const Scalar h = Scalar(4) * path.H;
  const auto q = [&](const Scalar& rate) { return q_at(rate, path.r_reference, Scalar(path.x * path.x)); };
  const auto rise = [&](const Scalar& from, const Scalar& to) {
    if (!(from < to)) return;
    sum += from;
    sum += -to;
  };
  Scalar T(0), X(0);
  const auto run = [&](const Scalar& from, const Scalar& to, int times) {
    const Scalar &lo = std::min(from, to), &hi = std::max(from, to), n(times);
    for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
      const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
      if (!(b > a)) continue;
      const Scalar r1 = pieces_.rate(k, a), r2 = pieces_.rate(k, b);
      const Crossing<Scalar> c(pieces_.form[k], b - a, r1, q(r1), r2, q(r2), h);
      T += n * c.T;
      X += n * c.X;
    }
  };
  if (path.kind == PathKind::waiting) {
    const Scalar& rest = cells_.x[path.interface];
    rise(path.foot, rest);
    rise(rest, z);
    run(path.foot, rest, 1);
    run(rest, z, 1);
  } else if (path.turned) {
    const bool is_up = path.upward != path.turned;
    const std::size_t j = cells_.layer[path.interface];
    const Scalar &near = pieces_.boundaries[is_up ? j : j + 1], &far = pieces_.boundaries[is_up ? j + 1 : j];
    const Scalar outer = is_up ? std::max(path.foot, z) : std::min(path.foot, z);
    const Scalar last = is_up ? std::max(outer, near) : std::min(outer, near);
    is_up ? rise(path.foot, far) : rise(far, z);
    run(path.foot, z, 1);
    run(outer, last, 2);
    const Scalar r = pieces_.rate(j, last), &r_end = is_up ? pieces_.high[j] : pieces_.low[j];
    const Scalar bend = is_up ? Scalar(-pieces_.bend[j]) : pieces_.bend[j];
    const Turn<Scalar> turn(pieces_.form[j], bend, r, q(r), h);
    T += turn.T;
    if (pieces_.form[j] == RateForm::linear)
      X += (r_end - h / (Scalar(1) + q(r))) / bend;
    else
      X += turn.X - (is_up ? Scalar(far - last) : Scalar(last - far));
  } else {
    rise(path.foot, z);
    if (h > 0) run(path.foot, z, 1);
  }
  if (!is_finite(T)) T = t, X = Scalar(0);
  sum += Scalar(-X);
  sum += Scalar(-path.H * (t - T));
  return sum.value();
}

template <Real Scalar>
std::optional<Scalar> SlopedMedium<Scalar>::first_wave(std::size_t i) const {
  return SlopedArrival<Scalar>(*this, i).find();
}

template <Real Scalar>
PathGradient<Scalar> SlopedMedium<Scalar>::gradient(const Path<Scalar>& path, const Scalar& z,
                                                    const Scalar& t) const {
  return SlopedGradient<Scalar>(pieces_, cells_, path, z, t).run();
}

template class SlopedMedium<Instantiated>;

}  // namespace shearfront::exact
