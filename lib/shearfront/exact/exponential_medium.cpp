// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/exponential_medium.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/exact/canonical_form.hpp"
#include "shearfront/exact/exponential_path.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

template <Real Scalar>
ExponentialMedium<Scalar>::ExponentialMedium(const CanonicalForm<Scalar>& form)
    : Medium<Scalar>({form.initial_breaks(), form.initial_values(), form.boundaries()}, form.mass()),
      scale_(form.scene().scale()),
      amplitude_(form.exponential()->amplitude),
      decay_(form.exponential()->decay),
      boundaries_(form.boundaries()) {
  for (const Scalar& x : cells_.x) rate_.push_back(rate_at(x));
}

template <Real Scalar>
Scalar ExponentialMedium<Scalar>::rate_at(const Scalar& z) const {
  using std::exp;
  return scale_ * (amplitude_ * exp(Scalar(-z / decay_)));  // s amplitude, the rate at z = 0, may overflow
}

template <Real Scalar>
Scalar ExponentialMedium<Scalar>::pure_travel_time(const Scalar& z1, const Scalar& z2) const {
  using std::expm1;
  const Scalar& lo = std::min(z1, z2);
  const Scalar& hi = std::max(z1, z2);
  return decay_ / rate_at(lo) * expm1(Scalar((hi - lo) / decay_));
}

template <Real Scalar>
bool ExponentialMedium<Scalar>::turns_outside(const Scalar& p0, const Scalar& p, const Scalar& H) const {
  const Scalar half(0.5);
  return p0 > half && p < half && Scalar(4) * H < rate_.back();
}

template <Real Scalar>
Path<Scalar> ExponentialMedium<Scalar>::best_free(const Scalar& z, const Scalar& t,
                                                  const Scalar& /*upper*/) const {
  return search(z, t, false);
}

template <Real Scalar>
Path<Scalar> ExponentialMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search(z, t, true);
}

template <Real Scalar>
Path<Scalar> ExponentialMedium<Scalar>::search(const Scalar& z, const Scalar& t, bool moving_only) const {
  using std::log1p;
  Path<Scalar> best;
  // Finite speed: with w = s a(z) t / decay, starts x above z need exp((x - z) / decay) <= 1 + w, starts
  // below z need exp(-(z - x) / decay) >= 1 - w, which holds for all of them when w >= 1.
  const Scalar w = rate_at(z) * t / decay_;
  const Scalar margin = Scalar(64) * unit_roundoff<Scalar>() * (cells_.x.back() - cells_.x.front());
  const Scalar highest = z + decay_ * log1p(w) + margin;
  const Scalar lowest = w < 1 ? Scalar(z + decay_ * log1p(Scalar(-w)) - margin) : cells_.x.front();
  const std::size_t last = cells_.cell_at(highest);
  for (std::size_t i = cells_.cell_at(lowest); i <= last; ++i) {
    const bool is_pure = cells_.phi[i] == 0 || cells_.phi[i] == 1;
    if (!(moving_only && is_pure)) try_cell(z, t, i, best);
    if (i > 0) try_source(z, t, i, best);
  }
  return best;
}

/// The fan of the jump at point i.
template <Real Scalar>
void ExponentialMedium<Scalar>::try_source(const Scalar& z, const Scalar& t, std::size_t i,
                                           Path<Scalar>& best) const {
  using std::expm1;
  using std::log1p;
  const Scalar& below = cells_.phi[i - 1];
  const Scalar& above = cells_.phi[i];
  const Scalar one(1), two(2);
  if (!(below < above)) return;  // no optimal path starts where M(., 0) is concave
  const Scalar B = rate_[i] * t / decay_;
  const Scalar log_E = (z - cells_.x[i]) / decay_;
  Scalar e = expm1(log_E);
  // At the edges of the fan rounding must not leave a height to neither the fan nor the state beside it.
  const auto size = [](const Scalar& v) { return v < 0 ? Scalar(-v) : v; };
  const Scalar of_height = (size(z) + size(cells_.x[i])) / decay_ * (one + e);
  const Scalar rounding = Scalar(16) * unit_roundoff<Scalar>() * (B + size(e) + of_height);
  if (e > B + rounding || B + e < -rounding || !(B > 0)) return;
  e = std::min(B, std::max(Scalar(-B), e));
  const FanMomenta<Scalar> fan(B, log_E, e);
  // Moving the start must not pay: below <= p0 <= above.
  const Scalar slack = one / Scalar(1 << 20);
  if (fan.p0 < below - slack || fan.p0 > above + slack) return;
  Path<Scalar> path;
  path.H = rate_[i] * fan.p0 * fan.one_minus_p0;
  if (turns_outside(fan.p0, fan.p, path.H)) return;
  const Scalar x = B * fan.p0;
  path.value = cells_.M[i] + decay_ * (log1p(x) - x * fan.one_minus_p0);
  path.p = fan.p;
  path.kind = PathKind::fan;
  path.upward = fan.p > one / two;
  path.source = i;
  path.foot = cells_.x[i];
  if (path.better_than(best)) best = path;
}

/// The characteristic of the constant state of cell i: with b = s a(z) t / decay and h = p0 (1 - p0),
/// b^2 h E^2 + c E - 1 = 0, c = 1 - b (2 p0 - 1).
template <Real Scalar>
void ExponentialMedium<Scalar>::try_cell(const Scalar& z, const Scalar& t, std::size_t i,
                                         Path<Scalar>& best) const {
  using std::log1p;
  const Scalar& p0 = cells_.phi[i];
  const Scalar b = rate_at(z) * t / decay_;
  const FootRoot<Scalar> root(b, p0);
  if (!root.exists) return;
  Path<Scalar> path;
  path.foot = z - decay_ * root.log_E();
  if (!(path.foot >= cells_.x[i] && path.foot <= cells_.x[i + 1])) return;
  const Scalar h = p0 * (Scalar(1) - p0);
  const Scalar B = b * root.E;
  path.H = rate_at(z) * root.E * h;
  path.p = std::max(Scalar(0), Scalar(p0 - B * h));
  if (turns_outside(p0, path.p, path.H)) return;
  const Scalar start = cells_.M[i] + p0 * (path.foot - cells_.x[i]);
  path.value = h == 0 ? Scalar(start + p0 * (z - path.foot))
                      : Scalar(start + decay_ * (log1p(Scalar(B * p0)) - B * h));
  path.kind = PathKind::constant;
  path.upward = path.p > Scalar(0.5);
  path.source = i;
  if (path.better_than(best)) best = path;
}

template <Real Scalar>
Scalar ExponentialMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& /*t*/,
                                            FinalAmount amount) const {
  const Scalar below = z - cells_.x.front();
  const Scalar& mass = cells_.M.back();
  const bool full = amount == FinalAmount::full_below || (amount == FinalAmount::both && path.upward);
  return (full ? below : mass) - path.value;
}

namespace {

/// (1 + x) log(1 + x) - x for x >= -1 without cancellation: sum (-1)^n x^n / (n (n - 1)), n >= 2.
template <Real Scalar>
Scalar entropy_excess(const Scalar& x) {
  using std::log1p;
  const Scalar size = x < 0 ? Scalar(-x) : x;
  if (size > Scalar(0.125)) {
    if (!(x > -1)) return Scalar(1);
    return (Scalar(1) + x) * log1p(x) - x;
  }
  Scalar power = x * x, sum(0);
  for (int n = 2; n < 400; ++n) {
    const Scalar term = power / Scalar(n * (n - 1));
    sum += term;
    const Scalar term_size = term < 0 ? Scalar(-term) : term;
    if (term_size <= unit_roundoff<Scalar>() * sum * Scalar(0.25)) break;
    power *= -x;
  }
  return sum;
}

}  // namespace

template <Real Scalar>
PathGradient<Scalar> ExponentialMedium<Scalar>::gradient(const Path<Scalar>& path, const Scalar& z,
                                                         const Scalar& t) const {
  using std::expm1;
  PathGradient<Scalar> out;
  if (path.kind != PathKind::fan && path.kind != PathKind::constant) return out;
  const Scalar one(1), two(2), four(4);
  Scalar phi_log_rate(0), phi_decay(0);
  const Scalar& lambda = decay_;
  const Scalar& x = path.foot;
  const Scalar B = rate_at(x) * t / lambda;
  Scalar p0, one_minus_p0;
  if (path.kind == PathKind::fan) {
    const Scalar log_E = (z - x) / lambda, e = expm1(log_E);
    const FanMomenta<Scalar> fan(B, log_E, e);
    const Scalar& E = fan.E;
    p0 = fan.p0;
    one_minus_p0 = fan.one_minus_p0;
    // p = 1/2 + (E - S) / B: with d p / d log B = E (1 - S) / (S B) the sum of both logarithmic derivatives
    // is E / (2 S B), which keeps them apart from their rounding.
    const Scalar by_B = -E * ((e / B + B / four) / fan.S / (one + fan.S));
    const Scalar by_both = E / (two * B) / fan.S;
    out.start = {p0, one_minus_p0};
    out.phi_start = -by_both / lambda;
    phi_log_rate = by_B;
    phi_decay = (by_B * (z - lambda) - by_both * (z - x)) / (lambda * lambda);
  } else {
    p0 = cells_.phi[path.source];
    one_minus_p0 = one - p0;
    const Scalar b = rate_at(z) * t / lambda, h = p0 * one_minus_p0, twist = p0 + (p0 - one);
    const FootRoot<Scalar> root(b, p0);
    const Scalar& E = root.E;
    const Scalar F_E = two * b * b * h * E + (one - b * twist);
    const Scalar F_b = two * b * h * E * E - twist * E;
    const Scalar F_p = -b * b * twist * E * E - two * b * E;
    const Scalar p_b = -h * (E - b * F_b / F_E);  // p = p0 - b E h
    phi_log_rate = p_b * b;
    phi_decay = p_b * b * (z - lambda) / (lambda * lambda);
    // 1 + b E twist, by the equation of E without cancellation, and the change of E.
    out.phi_state = E + h * (b * E) * (b * E) + h * b * F_p / F_E;
  }
  const Scalar Ht = path.H * t;
  // int z dt along the path, times H / lambda^2 = d(rate)/d(lambda) / rate integrated.
  const Scalar alpha = std::min(one, Scalar(B * one_minus_p0));
  const Scalar M_decay = Ht * x / (lambda * lambda) - (p0 * entropy_excess(Scalar(-alpha)) -
                                                       one_minus_p0 * entropy_excess(Scalar(B * p0)));
  out.pieces = {{Ht / amplitude_, phi_log_rate / amplitude_}, {M_decay, phi_decay}};
  out.boundaries.resize(1);
  out.phi_log_scale = phi_log_rate;
  return out;
}

template class ExponentialMedium<Instantiated>;

}  // namespace shearfront::exact
