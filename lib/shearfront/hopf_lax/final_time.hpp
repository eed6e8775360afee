// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/hopf_lax/candidate.hpp"

namespace shearfront::hopf_lax {

/// First time at which M(z, t) = target, where target = min(z - bottom, m) is the final value at z.
///
/// Finds the root of N(t) = target, N the least value over paths that do not start at a wall: before the root
/// N = M is increasing with slope H, after it N > target (or no such path is left). Newton with the known
/// slope, kept inside a bracket. Paths with H = 0 that tie with the target (a pure region that reached z
/// before the wall's own path) are told from real ones by kTie: their values differ from the target either by
/// rounding or by the volume of a missing region. Precondition: M(z, 0) < target. `start` is any positive
/// guess. Cost: about 10 queries.
template <Real Scalar>
[[nodiscard]] Scalar final_time(const Medium<Scalar>& medium, const Scalar& z, const Scalar& target,
                                const Scalar& start, const Scalar& height) {
  const Scalar u = unit_roundoff<Scalar>();
  const Scalar tie = Scalar(64) * u * height;
  Scalar lo(0), hi = infinity<Scalar>(), t = start;
  constexpr int kMaxQueries = 4000;  // bisection of the whole exponent range
  for (int n = 0; n < kMaxQueries; ++n) {
    const Candidate<Scalar> best = medium.best_free(z, t, infinity<Scalar>());
    const bool done =
        best.kind == PathKind::none || best.value >= target || (best.H == 0 && best.value >= target - tie);
    (done ? hi : lo) = t;
    Scalar next = t;
    if (best.kind != PathKind::none && best.H > 0) {
      const Scalar step = (target - best.value) / best.H;
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

}  // namespace shearfront::hopf_lax
