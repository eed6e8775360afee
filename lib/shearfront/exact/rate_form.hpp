// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// How the rate r = s a runs between the ends of a piece: r(z) = r_1 + bend (z - z_1), or r_1 exp(bend (z - z_1)). A constant
/// one is linear. Or the root of a linear function, which falls: only in a bed that is one piece (exact/root_medium.hpp).
enum class RateForm : std::uint8_t { linear, exponential, root };

/// The bend of a piece: slope, or slope of log r.
template <Real Scalar>
[[nodiscard]] Scalar bend_between(RateForm form, const Scalar& low, const Scalar& high, const Scalar& width) {
  using std::log;
  using std::log1p;
  const Scalar rise = high - low;
  if (form == RateForm::linear) return rise / width;
  const bool is_near = rise < low && rise > low / Scalar(-2);  // else rise / low has lost what high is
  return (is_near ? Scalar(log1p(Scalar(rise / low))) : Scalar(log(Scalar(high / low)))) / width;
}

/// What r gains from where it is `rate` to a place `d` higher (lower where d < 0).
template <Real Scalar>
[[nodiscard]] Scalar rise_of(RateForm form, const Scalar& bend, const Scalar& rate, const Scalar& d) {
  using std::expm1;
  return form == RateForm::linear ? Scalar(bend * d) : Scalar(rate * expm1(Scalar(bend * d)));
}

/// r at a place `d` higher than where it is `rate`: to a few u of itself, however little is left of it there.
template <Real Scalar>
[[nodiscard]] Scalar rate_beyond(RateForm form, const Scalar& bend, const Scalar& rate, const Scalar& d) {
  using std::exp;
  const Scalar x = bend * d;
  // Where most of it is lost, rate + rise is all rounding.
  if (form == RateForm::exponential && x < Scalar(-0.5)) return rate * exp(x);
  return rate + rise_of(form, bend, rate, d);
}

/// Whether r is still more than h = 4 H at a place `d` higher than where it is `rate`, and 1 - q^2 = h / rate; it is `end` there. Then
/// a path that went there would not have turned. By q where the rates are nearly h, for they may differ by no more than rounding. Clearly
/// more: where a path turns right at the place, another kind of path begins, and rounding must not drop both.
template <Real Scalar>
[[nodiscard]] bool stays_above(RateForm form, const Scalar& bend, const Scalar& rate, const Scalar& q,
                               const Scalar& h, const Scalar& d, const Scalar& end) {
  const Scalar slack = Scalar(256) * unit_roundoff<Scalar>(), q2 = q * q;
  const Scalar size = q < 0 ? Scalar(-q) : q;
  return q2 + q2 < Scalar(1) ? rate * (q2 - slack * size) > -rise_of(form, bend, rate, d)
                             : h < end * (Scalar(1) - slack);
}

/// The distance over which r gains `rise` from where it is `rate`: the inverse.
template <Real Scalar>
[[nodiscard]] Scalar distance_of(RateForm form, const Scalar& bend, const Scalar& rate, const Scalar& rise) {
  using std::log1p;
  return form == RateForm::linear ? Scalar(rise / bend) : Scalar(log1p(Scalar(rise / rate)) / bend);
}

/// dr/dz where r is `rate`.
template <Real Scalar>
[[nodiscard]] Scalar slope_at(RateForm form, const Scalar& bend, const Scalar& rate) {
  return form == RateForm::linear ? bend : Scalar(bend * rate);
}

/// int dz / r over the distance d > 0 up from where an exponential rate is `rate`; down from there with -bend.
template <Real Scalar>
[[nodiscard]] Scalar exponential_time(const Scalar& bend, const Scalar& rate, const Scalar& d) {
  using std::expm1;
  return -expm1(Scalar(-bend * d)) / (bend * rate);
}

}  // namespace shearfront::exact
