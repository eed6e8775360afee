// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "shearfront/numeric/scalar.hpp"

/// Paths from the states of a curved cell (a part of a smooth start) in sloped pieces: the start y is found where the path from
/// it arrives at the time t, or at z. Cells are parts so short that there is one such place or none; that is looked for at the
/// ends of a part. Beds of half as many parts tell whether more are needed (ExactSolution).
namespace shearfront::exact {

/// Where f changes its sign between lo and hi; the nearer to 0 of the last two places tried. Infinite values tell a sign only.
/// Empty where it has the same sign at both ends, or no value. Cost: some ten calls.
template <Real Scalar, class F>
[[nodiscard]] std::optional<Scalar> sign_change(const F& f, Scalar lo, Scalar hi) {
  std::optional<Scalar> a = f(lo), b = f(hi);
  if (!a || !b) return std::nullopt;
  const auto middle = [&] { return Scalar(lo + (hi - lo) / Scalar(2)); };
  if (*a == 0) return lo;
  if (*b == 0) return hi;
  if ((*a > 0) == (*b > 0)) return std::nullopt;
  const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
  const Scalar u = unit_roundoff<Scalar>();
  Scalar fa = *a, fb = *b;
  int side = 0;  // which end has been kept
  for (int n = 0; n < 400; ++n) {
    if (!(hi - lo > Scalar(2) * u * std::max(size(lo), size(hi)))) break;
    Scalar m = middle();
    if (is_finite(fa) && is_finite(fb) && n % 4 != 3) m = lo + (hi - lo) * (fa / (fa - fb));
    if (!(m > lo && m < hi)) m = middle();
    if (!(m > lo && m < hi)) break;
    const std::optional<Scalar> value = f(m);
    if (!value || *value == 0) return m;
    if ((*value > 0) == (fa > 0)) {
      lo = m;
      fa = *value;
      a = value;
      if (side == 1) fb /= Scalar(2);
      side = 1;
    } else {
      hi = m;
      fb = *value;
      b = value;
      if (side == -1) fa /= Scalar(2);
      side = -1;
    }
  }
  return size(*a) < size(*b) ? lo : hi;
}

/// Calls found(place) for the places between lo and hi where f changes its sign: between neighbours of some samples, close to the
/// ends, where times may change like roots, and on both sides of an extremum between them that crosses 0.
template <Real Scalar, class F, class Found>
void sign_changes(const F& f, const Scalar& lo, const Scalar& hi, const Found& found) {
  constexpr std::array<double, 9> kPlaces{0, 1.0 / 64, 1.0 / 16, 0.25, 0.5, 0.75, 15.0 / 16, 63.0 / 64, 1};
  std::array<Scalar, kPlaces.size()> y;
  std::array<std::optional<Scalar>, kPlaces.size()> value;
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = i + 1 == y.size() ? hi : Scalar(lo + (hi - lo) * Scalar(kPlaces[i]));
    value[i] = f(y[i]);
  }
  const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
  for (std::size_t i = 0; i + 1 < y.size(); ++i) {
    if (!value[i] || !value[i + 1]) continue;
    if ((*value[i] > 0) != (*value[i + 1] > 0) || *value[i] == 0 || *value[i + 1] == 0) {
      if (const auto place = sign_change<Scalar>(f, y[i], y[i + 1])) found(*place);
      continue;
    }
    // Nearer to 0 than both neighbours.
    if (i == 0 || !value[i - 1] || (*value[i - 1] > 0) != (*value[i] > 0)) continue;
    if (!(size(*value[i]) < size(*value[i - 1]) && size(*value[i]) < size(*value[i + 1]))) continue;
    Scalar a = y[i - 1], b = y[i + 1], m = y[i], best = *value[i];
    constexpr int kMost = 40;
    for (int n = 0; n < kMost; ++n) {
      const bool is_upper = b - m > m - a;
      const Scalar next =
          is_upper ? Scalar(m + (b - m) * Scalar(0.381966)) : Scalar(m - (m - a) * Scalar(0.381966));
      const std::optional<Scalar> at = f(next);
      if (!at) break;
      if ((*at > 0) != (best > 0)) {
        if (const auto place = sign_change<Scalar>(f, a, next)) found(*place);
        if (const auto place = sign_change<Scalar>(f, next, b)) found(*place);
        break;
      }
      if (size(*at) < size(best)) {
        (is_upper ? a : b) = m;
        m = next;
        best = *at;
      } else {
        (is_upper ? b : a) = next;
      }
      if (!(b - a > Scalar(1e-9) * (hi - lo))) break;
    }
  }
}

/// The part of (lo, hi) where g >= 0, for a g that changes its sign there once or not at all.
template <Real Scalar, class G>
[[nodiscard]] bool keep_where(const G& g, Scalar& lo, Scalar& hi) {
  const bool is_low = g(lo) >= 0, is_high = g(hi) >= 0;
  if (is_low && is_high) return true;
  if (!is_low && !is_high) return false;
  Scalar &end = is_low ? hi : lo, inside = is_low ? lo : hi, outside = end;
  for (;;) {
    const Scalar m = inside + (outside - inside) / Scalar(2);
    if (m == inside || m == outside) break;
    (g(m) >= 0 ? inside : outside) = m;
  }
  end = inside;
  return lo < hi;
}

}  // namespace shearfront::exact
