// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/exact/path.hpp"

namespace shearfront::exact {

/// First time at which M(z, t) reaches its final amount.
///
/// Finds the root of N(t) = amount, N the least value over paths that do not start at a wall: before the root
/// N = M is increasing with slope H, after it N > amount (or no such path is left). Newton with the known
/// slope, kept inside a bracket, on the shortfall itself: where H is small, the difference of two rounded
/// amounts would cost u (top - bottom) / H of the time. For the same reason a path with H = 0 that ties with
/// the amount (a pure region that reached z before the wall's own path; `tie` tells it from one that misses a
/// real volume) makes way for the best moving one, whose shortfall decides. Precondition: M(z, 0) < amount.
/// `start` is any positive guess. Cost: about 10 queries.
template <Real Scalar>
[[nodiscard]] Scalar final_time(const Medium<Scalar>& medium, const Scalar& z, FinalAmount amount,
                                const Scalar& start, const Scalar& height) {
  const Scalar u = unit_roundoff<Scalar>();
  const Scalar tie = Scalar(64) * u * height;
  const auto shortfall = [&](const Path<Scalar>& path, const Scalar& time) {
    return path.kind == PathKind::none ? Scalar(0) : medium.shortfall(path, z, time, amount);
  };
  Scalar lo(0), hi = infinity<Scalar>(), t = start;
  constexpr int kMaxQueries = 4000;  // bisection of the whole exponent range
  for (int n = 0; n < kMaxQueries; ++n) {
    Path<Scalar> best = medium.best_free(z, t, infinity<Scalar>());
    Scalar missing = shortfall(best, t);
    if (best.kind != PathKind::none && best.H == 0 && missing <= tie) {
      best = medium.best_moving(z, t);
      missing = shortfall(best, t);
    }
    const bool none = best.kind == PathKind::none;
    (missing > 0 ? lo : hi) = t;
    Scalar next = t;
    if (!none && best.H > 0) {
      const Scalar step = missing / best.H;
      next = t + step;
      const Scalar size = step < 0 ? Scalar(-step) : step;
      if (size <= Scalar(4) * u * t) return next;
    }
    if (!(next > lo && next < hi)) {
      if (!is_finite(hi)) {
        next = Scalar(2) * t;
      } else if (lo > 0 && hi > Scalar(4) * lo) {
        using std::sqrt;
        next = sqrt(lo) * sqrt(hi);
      } else {
        next = lo + (hi - lo) / Scalar(2);
      }
    }
    if (is_finite(hi) && hi - lo <= Scalar(4) * u * hi) return hi;
    t = next;
  }
  return t;
}

/// The same for fluxes with straight branches: pure states then travel with the contacts behind them, and a
/// moving path that ties with one at rest says nothing. M meets its final amount with a slope that is no
/// smaller than that of a contact, so M itself tells the time, to `tie` over that slope. Precondition:
/// `late` is no earlier. Cost: 60 queries.
template <Real Scalar>
[[nodiscard]] Scalar final_time_of_contacts(const Medium<Scalar>& medium, const Scalar& z, FinalAmount amount,
                                            const Scalar& late, const Scalar& height) {
  const Scalar u = unit_roundoff<Scalar>(), tie = Scalar(64) * u * height;
  const auto is_reached = [&](const Scalar& time) {
    const Path<Scalar> best = medium.best_free(z, time, infinity<Scalar>());
    return best.kind == PathKind::none || !(medium.shortfall(best, z, time, amount) > tie);
  };
  Scalar lo(0), hi = late;
  while (hi - lo > Scalar(4) * u * hi) {
    const Scalar t = lo + (hi - lo) / Scalar(2);
    if (!(t > lo && t < hi)) break;
    (is_reached(t) ? hi : lo) = t;
  }
  return hi;
}

}  // namespace shearfront::exact
