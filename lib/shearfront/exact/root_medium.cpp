// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/root_medium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/exact/initial_amount.hpp"
#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::exact {
namespace {

/// Root of f between a, where it is negative, and b, where it is positive: Newton's steps, halves where they lead out or do not help. f gives
/// a pair of value and derivative.
template <Real Scalar, class Function>
Scalar root_between(const Function& f, Scalar a, Scalar b) {
  Scalar x = a + (b - a) / Scalar(2), before = infinity<Scalar>();
  constexpr int kMost = 400;
  for (int n = 0; n < kMost; ++n) {
    const auto [value, slope] = f(x);
    if (value == 0) return x;
    (value < 0 ? a : b) = x;
    Scalar next = x - value / slope;
    const Scalar size = value < 0 ? Scalar(-value) : value;
    const bool is_inside = next > std::min(a, b) && next < std::max(a, b);
    if (!is_inside || size > before / Scalar(2)) next = a + (b - a) / Scalar(2);
    before = size;
    const Scalar step = next > x ? Scalar(next - x) : Scalar(x - next), far = x < 0 ? Scalar(-x) : x;
    if (!(step > unit_roundoff<Scalar>() * std::max(far, Scalar(1)))) return next;
    x = next;
  }
  return x;
}

/// Beyond these odds a momentum is 0 or 1 but for a number that no longer counts.
template <Real Scalar>
Scalar most_log_odds() {
  return Scalar(std::numeric_limits<Scalar>::digits > 64 ? 2000 : 700);
}

}  // namespace

template <Real Scalar>
RootMedium<Scalar>::Momentum::Momentum(const Scalar& log_odds) : x(log_odds) {
  using std::exp;
  const Scalar e = exp(Scalar(x < 0 ? x : Scalar(-x))), small = e / (Scalar(1) + e),
               large = Scalar(1) / (Scalar(1) + e);
  p = x < 0 ? small : large;
  missing = x < 0 ? large : small;
  q = small * large;
}

template <Real Scalar>
RootMedium<Scalar>::Upper::Upper(const Scalar& q) {
  using std::log, std::sqrt;
  const Scalar one(1), s2 = one - Scalar(4) * q, s = s2 > 0 ? Scalar(sqrt(s2)) : Scalar(0);
  p = (one + s) / Scalar(2);
  missing = q / p;
  const Scalar x = missing > 0 ? Scalar(log(Scalar(p / missing))) : Scalar(0);
  phi = s + Scalar(2) * q * x;
  phi_q = Scalar(2) * x - Scalar(4) / s;
}

template <Real Scalar>
RootMedium<Scalar>::RootMedium(Scalar low, Scalar high, Cells<Scalar> cells, Scalar mass)
    : Medium<Scalar>(std::move(cells), std::move(mass)),
      boundaries_{cells_.x.front(), cells_.x.back()},
      low_(std::move(low)),
      high_(std::move(high)) {
  using std::sqrt;
  const Scalar width = boundaries_[1] - boundaries_[0];
  A2_ = (low_ - high_) * (low_ + high_) / width;
  A_ = sqrt(A2_);
  below_surface_ = high_ / A_ * (high_ / A_);
}

template <Real Scalar>
Scalar RootMedium<Scalar>::root(const Scalar& z) const {
  using std::sqrt;
  const Scalar depth = (boundaries_[1] - z) + below_surface_;
  return depth > 0 ? Scalar(sqrt(depth)) : Scalar(0);
}

template <Real Scalar>
Scalar RootMedium<Scalar>::rate_at(const Scalar& z) const {
  return A_ * root(z);
}

template <Real Scalar>
Scalar RootMedium<Scalar>::pure_travel_time(const Scalar& from, const Scalar& to) const {
  const Scalar d = from < to ? Scalar(to - from) : Scalar(from - to), sum = root(from) + root(to);
  return d > 0 ? Scalar(Scalar(2) * d / (A_ * sum)) : Scalar(0);
}

template <Real Scalar>
Path<Scalar> RootMedium<Scalar>::best_free(const Scalar& z, const Scalar& t, const Scalar& /*upper*/) const {
  return search(z, t, false);
}
template <Real Scalar>
Path<Scalar> RootMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search(z, t, true);
}

template <Real Scalar>
Path<Scalar> RootMedium<Scalar>::search(const Scalar& z, const Scalar& t, bool moving_only) const {
  Path<Scalar> best;
  for (std::size_t k = 0; k < cells_.n_cells(); ++k) {
    state(k, z, t, moving_only, best);
    if (k > 0) fan(k, z, t, best);
  }
  return best;
}

template <Real Scalar>
Scalar RootMedium<Scalar>::gain(const Scalar& p0, const Scalar& missing0, const Scalar& y0, const Scalar& p,
                                const Scalar& missing, const Scalar& y, const Scalar& H,
                                const Scalar& t) const {
  const Scalar work = H * t / Scalar(2);
  // Of a path nearly pure all the way the height it rises, less what it lacks.
  if (missing0 < p0 && missing < p)
    return ((y0 - y) * (y0 + y) - missing0 * y0 * y0 + missing * y * y) + work;
  return (p0 * y0 * y0 - p * y * y) + work;
}

template <Real Scalar>
void RootMedium<Scalar>::pure(std::size_t k, const Scalar& z, const Scalar& t, Path<Scalar>& best) const {
  const bool is_up = cells_.phi[k] == 1;
  const Scalar y = root(z), way = A_ * t / Scalar(2), y0 = is_up ? Scalar(y + way) : Scalar(y - way);
  if (y0 < 0) return;
  // z - foot = (y0 - y) (y0 + y).
  const Scalar rise = (is_up ? way : Scalar(-way)) * (y0 + y), foot = z - rise;
  const Scalar &lo = cells_.x[k], &hi = cells_.x[k + 1];
  const Scalar slack = Scalar(64) * unit_roundoff<Scalar>() * (boundaries_[1] - boundaries_[0]);
  if (foot < lo - slack || foot > hi + slack) return;
  Path<Scalar> path;
  path.foot = std::clamp(foot, lo, hi);
  path.value = cells_.M[k] + cells_.phi[k] * (path.foot - lo) + (is_up ? Scalar(z - path.foot) : Scalar(0));
  path.p = Scalar(is_up ? 1 : 0);
  path.kind = PathKind::constant;
  path.upward = is_up;
  path.source = k;
  path.r_reference = rate_at(z);
  if (path.better_than(best)) best = path;
}

template <Real Scalar>
void RootMedium<Scalar>::state(std::size_t k, const Scalar& z, const Scalar& t, bool moving_only,
                               Path<Scalar>& best) const {
  using std::log;
  const Scalar &p0 = cells_.phi[k], one(1), two(2), missing0 = one - p0;
  if (p0 == 0 || missing0 == 0) {
    if (!moving_only) pure(k, z, t, best);
    return;
  }
  const Scalar y = root(z);
  if (!(y > 0)) return;
  const Scalar q0 = p0 * missing0, x0 = log(Scalar(p0 / missing0)), tau = t * A_ / (two * y);
  const Scalar G0 = (p0 - missing0) / q0 + two * x0;
  // f(p) - tau over x = log odds of p, dp = q dx: its slope in p is (1 - 2 p) (G0 - 2 x) - 4.
  const auto late = [&](const Scalar& x) {
    const Momentum m(x);
    const Scalar f = m.q * G0 - m.psi(), slope = (m.missing - m.p) * (G0 - two * x) - Scalar(4);
    return std::pair(Scalar(f - tau), Scalar(slope * m.q));
  };
  // f rises from 0 at p0 to its largest value as p falls, and then comes down to 1 where p is 0.
  const auto slope_of = [&](const Scalar& x) {
    const Momentum m(x);
    return std::pair(Scalar((m.missing - m.p) * (G0 - two * x) - Scalar(4)),
                     Scalar(two * m.q * ((m.psi() - m.q * G0) / m.q)));
  };
  const Scalar far = -most_log_odds<Scalar>();
  if (!(slope_of(far).first > 0)) return;
  const Scalar top = root_between<Scalar>(
      [&](const Scalar& x) {
        const auto [value, by] = slope_of(x);
        return std::pair(Scalar(-value), Scalar(-by));
      },
      far, x0);
  const auto offer = [&](const Scalar& x) {
    const Momentum m(x);
    const Scalar y0 = y * (m.q / q0), &lo = cells_.x[k], &hi = cells_.x[k + 1];
    // z - foot = y0^2 - y^2.
    const Scalar foot = z - (y0 - y) * (y0 + y);
    const Scalar slack = Scalar(64) * unit_roundoff<Scalar>() * (boundaries_[1] - boundaries_[0]);
    if (foot < lo - slack || foot > hi + slack) return;
    Path<Scalar> path;
    path.foot = std::clamp(foot, lo, hi);
    path.H = A_ * y * m.q;
    path.p = m.p;
    path.value = cells_.M[k] + p0 * (path.foot - lo) + gain(p0, missing0, y0, m.p, m.missing, y, path.H, t);
    path.kind = PathKind::constant;
    path.upward = m.x > 0;
    path.turned = x0 > 0 && !path.upward;
    path.source = k;
    path.r_reference = A_ * y;
    path.x = m.p - m.missing;
    if (path.better_than(best)) best = path;
  };
  if (!(late(top).first >= 0)) return;
  offer(root_between<Scalar>(
      [&](const Scalar& x) {
        const auto [value, by] = late(x);
        return std::pair(value, by);
      },
      x0, top));
  if (late(far).first < 0) offer(root_between<Scalar>(late, far, top));
}

template <Real Scalar>
auto RootMedium<Scalar>::fan_time(const Scalar& least, const Scalar& most, const Momentum& u) const
    -> FanTime {
  const Scalar two(2), unit = two / A_;
  const Upper other(Scalar(u.q * (least / most)));
  const Scalar lean = u.missing - u.p;  // 1 - 2 u
  FanTime time{unit * (least * u.psi() + most * other.phi),
               unit * least * ((Scalar(4) + two * lean * u.x) + lean * other.phi_q)};
  if (least == most) {
    // Both ends are alike: psi(u) + psi(1 - u) below 1/2, twice psi above.
    time.t = u.x > 0 ? Scalar(two * unit * least * u.psi()) : Scalar(0);
    time.by_u = u.x > 0 ? Scalar(two * unit * least * (Scalar(4) + two * lean * u.x)) : Scalar(0);
  }
  return time;
}

template <Real Scalar>
void RootMedium<Scalar>::fan(std::size_t k, const Scalar& z, const Scalar& t, Path<Scalar>& best) const {
  if (!(cells_.phi[k - 1] < cells_.phi[k])) return;
  const Scalar y0 = root(cells_.x[k]), y = root(z), zero(0);
  const bool is_down = z < cells_.x[k];  // the start is nearer to the surface
  const Scalar &least = is_down ? y0 : std::min(y, y0), &most = is_down ? y : y0;
  if (!(least > 0)) return;
  const Scalar far = most_log_odds<Scalar>();
  const auto time = [&](const Scalar& x) { return fan_time(least, most, Momentum(x)); };
  // The time rises with u, from that of a pure state, to its largest value.
  const auto falls = [&](const Scalar& x) { return std::pair(Scalar(-time(x).by_u), Scalar(0)); };
  if (pure_travel_time(cells_.x[k], z) > t) return;
  Scalar lo(0), hi = far;
  for (int n = 0; n < std::numeric_limits<Scalar>::digits + 12; ++n) {
    const Scalar middle = lo + (hi - lo) / Scalar(2);
    (falls(middle).first < 0 ? lo : hi) = middle;
  }
  if (time(lo).t < t) return;
  const Scalar from = least == most ? zero : Scalar(-far);
  const Scalar x = root_between<Scalar>(
      [&](const Scalar& at) {
        const Momentum u(at);
        const FanTime f = fan_time(least, most, u);
        return std::pair(Scalar(f.t - t), Scalar(f.by_u * u.q));
      },
      from, lo);
  const Momentum u(x);
  const Upper other(Scalar(u.q * (least / most)));
  // u is p at the start, or 1 - p at the end; a path that comes to or from the far end goes up there, or comes down.
  const Scalar p0 = is_down ? u.p : other.p, missing0 = is_down ? u.missing : other.missing,
               p = is_down ? other.missing : u.missing, missing = is_down ? other.p : u.p;
  const Scalar slack = Scalar(1) / Scalar(1 << 20);
  if (p0 < cells_.phi[k - 1] - slack || p0 > cells_.phi[k] + slack) return;
  Path<Scalar> path;
  path.H = A_ * least * u.q;
  path.p = p;
  path.value = cells_.M[k] + gain(p0, missing0, y0, p, missing, y, path.H, t);
  path.kind = PathKind::fan;
  path.upward = p > missing;
  path.turned = p0 > missing0 && !path.upward;
  path.source = k;
  path.foot = cells_.x[k];
  path.r_reference = A_ * y;
  path.x = p - missing;
  if (path.better_than(best)) best = path;
}

template <Real Scalar>
Scalar RootMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                     FinalAmount amount) const {
  CompensatedSum<Scalar> sum;
  add_final_less_initial(cells_, path, z, amount, sum);
  const Scalar y0 = root(path.foot), y = root(z), p = path.p, missing = Scalar(1) - path.p;
  Scalar p0, missing0;
  if (path.kind == PathKind::constant) {
    p0 = cells_.phi[path.source];
    missing0 = Scalar(1) - p0;
  } else {
    const Upper start(Scalar(path.H / (A_ * y0)));
    const bool is_up = path.upward || path.turned;
    p0 = is_up ? start.p : start.missing;
    missing0 = is_up ? start.missing : start.p;
  }
  sum += -gain(p0, missing0, y0, p, missing, y, path.H, t);
  return sum.value();
}

template <Real Scalar>
PathGradient<Scalar> RootMedium<Scalar>::gradient(const Path<Scalar>& path, const Scalar& z,
                                                  const Scalar& t) const {
  PathGradient<Scalar> out;
  if (path.kind != PathKind::fan && path.kind != PathKind::constant) return out;
  out.pieces.resize(2);
  out.boundaries.resize(1);
  const Scalar one(1), two(2), y0 = root(path.foot), y = root(z), p = path.p, missing = one - p;
  if (path.H == 0) {
    if (path.kind == PathKind::constant) {
      out.phi_state = y > 0 ? Scalar(y0 / y) : Scalar(0);
    } else {
      out.start = path.upward ? StartMomentum<Scalar>{one, Scalar(0)} : StartMomentum<Scalar>{};
    }
    return out;
  }
  // d phi by log A and by the height of the surface, d M likewise.
  Scalar phi_A, phi_h, p0;
  const Scalar lean = missing - p, q = p * missing;
  using std::log;
  const Scalar x = log(Scalar(p / missing));
  if (path.kind == PathKind::constant) {
    p0 = cells_.phi[path.source];
    const Scalar q0 = p0 * (one - p0), G0 = (p0 - (one - p0)) / q0 + two * log(Scalar(p0 / (one - p0)));
    const Scalar tau = t * A_ / (two * y), slope = lean * (G0 - two * x) - Scalar(4);
    phi_A = tau / slope;
    phi_h = -phi_A / (two * y * y);
    out.phi_state = -(q / q0) / q0 / slope;
  } else {
    const bool is_down = z < path.foot;
    const Scalar &least = is_down ? y0 : std::min(y, y0), &most = is_down ? y : y0;
    const Upper start(Scalar(path.H / (A_ * y0)));
    const bool sets_out_up = path.upward || path.turned;
    p0 = sets_out_up ? start.p : start.missing;
    out.start = {p0, sets_out_up ? start.missing : start.p};
    const Scalar u = is_down ? p0 : missing, v = one - u, uq = path.H / (A_ * least), ux = log(Scalar(u / v)),
                 psi = (u - v) + two * uq * ux;
    const Upper other(Scalar(path.H / (A_ * most)));
    const Scalar unit = two / A_, qb = path.H / (A_ * most), u_lean = v - u;
    Scalar by_u = unit * least * ((Scalar(4) + two * u_lean * ux) + u_lean * other.phi_q),
           by_least = unit * (psi + uq * other.phi_q), by_most = unit * (other.phi - qb * other.phi_q);
    if (least == most) {
      by_u = two * unit * least * (Scalar(4) + two * u_lean * ux);
      by_least = by_most = unit * psi;
    }
    // t = time(u, least, most): du by each, and d phi by du and what q at the far end changes with.
    const Scalar s_far = other.p - other.missing;
    const auto phi_by = [&](const Scalar& log_A, const Scalar& d_least, const Scalar& d_most) {
      const Scalar du = (t * log_A - by_least * d_least - by_most * d_most) / by_u;
      if (!is_down) return Scalar(-du);
      const Scalar dq = u_lean * (least / most) * du + qb * (d_least / least - d_most / most);
      return least == most ? Scalar(-du) : Scalar(dq / s_far);
    };
    const Scalar dy0 = one / (two * y0), dy = one / (two * y);
    phi_A = phi_by(one, Scalar(0), Scalar(0));
    phi_h = is_down ? phi_by(Scalar(0), dy0, dy) : phi_by(Scalar(0), dy, dy0);
    out.phi_start =
        is_down ? phi_by(Scalar(0), Scalar(-dy0), Scalar(0)) : phi_by(Scalar(0), Scalar(0), Scalar(-dy0));
  }
  out.phi_log_scale = phi_A;
  const Scalar M_A = path.H * t, M_h = p0 - p;
  // A^2 = (low^2 - high^2) / width, surface = bottom + low^2 / A^2.
  const Scalar width = boundaries_[1] - boundaries_[0], unit = one / (A2_ * width);
  const Scalar h_low = -two * low_ * (high_ / A_) * (high_ / A_) * unit,
               h_high = two * high_ * (low_ / A_) * (low_ / A_) * unit;
  out.pieces[0] = {low_ * unit * M_A + h_low * M_h, low_ * unit * phi_A + h_low * phi_h};
  out.pieces[1] = {-high_ * unit * M_A + h_high * M_h, -high_ * unit * phi_A + h_high * phi_h};
  return out;
}

template class RootMedium<Instantiated>;

}  // namespace shearfront::exact
