// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_crossing.hpp"
#include "shearfront/exact/sloped_route.hpp"
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

/// The state of a curved cell at one height, as the view sees it.
template <Real Scalar>
struct CurvedState {
  Scalar p, missing, q0;

  CurvedState(const SlopedView<Scalar>& view, std::size_t cell, const Scalar& y) {
    const Scalar phi = view.shape->state(view.piece[cell], view.is_mirror ? Scalar(-y) : y);
    p = view.is_mirror ? Scalar(Scalar(1) - phi) : phi;
    missing = view.is_mirror ? phi : Scalar(Scalar(1) - phi);
    q0 = p - missing;
  }
};

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

/// A path from a height of a curved cell along a route, at the H of its state there.
template <Real Scalar>
struct CurvedStart {
  Scalar y{0};
  SlopedSample<Scalar> s;
};

/// The path that leaves its cell at the top, or, having turned in it, at the bottom. Empty where the state moves the other way,
/// or its h does not fit: no more than the least rate of the route, no less than `h_low`.
template <Real Scalar>
[[nodiscard]] std::optional<CurvedStart<Scalar>> curved_start(const SlopedView<Scalar>& view,
                                                              const SlopedRoute<Scalar>& route, std::size_t k,
                                                              const Scalar& y, bool leaves_up,
                                                              const Scalar& h_low) {
  using std::sqrt;
  const CurvedState<Scalar> state(view, k, y);
  const Scalar r = view.rate(k, y), h = Scalar(4) * state.p * state.missing * r;
  if (state.q0 < 0 || h > route.least || h < h_low) return std::nullopt;
  CurvedStart<Scalar> start;
  start.y = y;
  SlopedSample<Scalar>& s = start.s;
  s.h = h;
  if (h == 0 && (!leaves_up || route.turn_bend > 0)) {  // a pure state does not turn
    s.T = infinity<Scalar>();
    return start;
  }
  s.qm2 = (route.least - h) / route.least;
  s.qm = sqrt(s.qm2);
  add_route(view, route, s);
  const Scalar& exit = leaves_up ? view.high[k] : view.low[k];
  const Scalar d = leaves_up ? view.x[k + 1] - y : y - view.x[k];
  const Scalar q = exit == route.least ? s.qm : q_at(exit, route.least, s.qm2);
  if (d > 0) {
    const Crossing<Scalar> c(view.form[k], d, r, state.q0, exit, q, h);
    s.T += c.T;
    s.X += c.X;
  }
  if (!leaves_up) {
    const Scalar bend = view.bend[k] < 0 ? Scalar(-view.bend[k]) : view.bend[k];
    const Turn<Scalar> turn(view.form[k], bend, r, state.q0, h);
    s.T += turn.T;
    s.X += turn.X;
  }
  return start;
}

}  // namespace shearfront::exact
